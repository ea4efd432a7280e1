#include "tools/chart/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/xml_text.h"

namespace argil::chart {

namespace {

// A marker a space, in the order of the legend; unknown ones share the last.
std::size_t marker_number(const std::string& space) {
  constexpr std::array k_spaces{"default", "cubic", "nodes", "published"};
  const auto found = std::find(k_spaces.begin(), k_spaces.end(), space);
  return static_cast<std::size_t>(found - k_spaces.begin());
}

}  // namespace

std::string text(double x, double y, const std::string& what, const char* look, Align align) {
  const char* anchor = align == Align::middle ? " text-anchor=\"middle\""
                       : align == Align::end  ? " text-anchor=\"end\""
                                              : "";
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\"{}>{}</text>\n", x, y, look, anchor,
                     io::xml_text(what));
}

std::string line(double x0, double y0, double x1, double y1, const char* look) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x0, y0, x1,
                     y1, look);
}

std::string marker(double x, double y, const std::string& space, double r) {
  switch (marker_number(space)) {
    case 0:
      return fmt::format("M{:.1f} {:.1f}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z", x - r, y, fmt::arg("r", r),
                         fmt::arg("d", 2 * r));
    case 1:
      return fmt::format("M{:.1f} {:.1f}h{d}v{d}h-{d}z", x - 0.9 * r, y - 0.9 * r, fmt::arg("d", 1.8 * r));
    case 2:
      return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}H{:.1f}z", x, y - 1.2 * r, x + 1.15 * r, y + 0.8 * r,
                         x - 1.15 * r);
    case 3:
      return fmt::format("M{:.1f} {:.1f}l{a} {a}l-{a} {a}l-{a} -{a}z", x, y - 1.25 * r, fmt::arg("a", 1.25 * r));
    default:
      return fmt::format("M{:.1f} {:.1f}h{d}L{:.1f} {:.1f}z", x - 1.15 * r, y - 0.8 * r, x, y + 1.2 * r,
                         fmt::arg("d", 2.3 * r));
  }
}

std::string dot(double x, double y, const char* colour) {
  const std::string fill = colour ? fmt::format("style=\"fill:{}\" ", colour) : std::string{};
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.7\" {}class=\"dot\"/>\n", x, y, fill);
}

const char* dashes(const std::string& formulation) {
  if (formulation == "b_bar") return " stroke-dasharray=\"7 3\"";
  if (formulation == "incompatible_modes") return " stroke-dasharray=\"2 3\"";
  return "";
}

}  // namespace argil::chart
