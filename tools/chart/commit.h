#pragma once
// Which source this program was built from, for the rows of a chart.

#include <string_view>

namespace argil::chart {

/// Twelve digits of the commit, with -dirty behind them where files differed from it; "unknown" without git.
[[nodiscard]] std::string_view commit();

}  // namespace argil::chart
