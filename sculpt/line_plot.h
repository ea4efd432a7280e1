#pragma once
// Curves over one quantity as an SVG picture: linear axes with round ticks, each curve labelled at its right end in
// its own colour. It follows the reader's light or dark theme and needs nothing outside itself.

#include <string>
#include <vector>

namespace argil::sculpt {

struct PlotCurve {
  std::string name;
  std::vector<double> x, y;  // the same number of points, all finite
};
struct LinePlot {
  std::string title;
  std::string x_title, x_unit, y_title, y_unit;  // units as of shown fields: "%" for shares
  std::vector<PlotCurve> curves;                 // at least one, of at least one point each
};

/// An SVG document of 900 x 480 pixels. Up to 60 points a curve are marked; colours come again, dashed, after six.
/// @throws Error (bad_geometry) for a value that is not finite, with its curve.
[[nodiscard]] std::string plot_svg(const LinePlot& plot);

}  // namespace argil::sculpt
