#pragma once
// The pieces that a panel is drawn of, as SVG elements in the classes of the picture's style.

#include <string>

namespace argil::chart {

enum class Align { start, middle, end };

[[nodiscard]] std::string text(double x, double y, const std::string& what, const char* look = "",
                               Align align = Align::start);
[[nodiscard]] std::string line(double x0, double y0, double x1, double y1, const char* look);
/// The path of the marker of a space about (x, y), `r` its radius.
[[nodiscard]] std::string marker(double x, double y, const std::string& space, double r);
/// That tells colours apart which had to be used again; `colour` where it lies on a hollow marker.
[[nodiscard]] std::string dot(double x, double y, const char* colour = nullptr);
/// The attribute of a line for a formulation, or nothing.
[[nodiscard]] const char* dashes(const std::string& formulation);

}  // namespace argil::chart
