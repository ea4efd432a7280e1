#pragma once
// The atlas as one page: every map with what its data say in words.

#include "tools/atlas/atlas.h"

namespace argil::atlas {

struct SweepResult {
  Sweep sweep;
  std::vector<Panel> panels;
};

/// What a panel's lines say: where it diverges, over the theoretical limit where one is known, and how far it is
/// accurate. One sentence or two, in plain text.
[[nodiscard]] std::string statement(const Sweep& sweep, const LineGrid& grid, const Panel& panel);

/// The whole page, maps within.
[[nodiscard]] std::string page_html(const std::vector<SweepResult>& results, const AtlasOptions& options);

}  // namespace argil::atlas
