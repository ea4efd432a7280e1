#pragma once
// A panel as SVG: error against time, both logarithmic, the Pareto front drawn and labelled, tooltips on every
// point. Colour stands for the method, marker for the space, dashes for the formulation. It follows the reader's
// light or dark theme and needs nothing outside itself.

#include <string>

#include "tools/chart/colours.h"

namespace argil::chart {

/// A whole SVG document of 1040 x 600 pixels at least (a long legend makes it higher).
[[nodiscard]] std::string picture(const Panel& panel, const Colours& colours);

}  // namespace argil::chart
