#pragma once
// The results of a chart beside its table: an SVG a panel and one page, chart.html, that holds them all.

#include <filesystem>

#include "tools/chart/picture.h"

namespace argil::chart {

/// One HTML document with the pictures in it, a paragraph each on what to choose, the front as a table, and what
/// failed. Needs nothing outside itself.
[[nodiscard]] std::string page(const std::vector<Panel>& panels, const Colours& colours);

/// Writes <name>.svg of every panel and chart.html into `folder`. @throws Error (bad_input) if it cannot.
void write_results(const std::filesystem::path& folder, const std::vector<Panel>& panels);

}  // namespace argil::chart
