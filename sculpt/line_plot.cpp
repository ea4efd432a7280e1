#include "sculpt/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "io/xml_text.h"
#include "sculpt/scene.h"
#include "sculpt/shown_unit.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

constexpr double k_width = 900, k_height = 480;
constexpr double k_left = 84, k_right = 700, k_top = 58, k_bottom = 420;  // of the frame
constexpr double k_line = 17;                                             // from label to label
constexpr std::size_t k_most_marked = 60;
// After Okabe and Ito, with lightness that shows on light and dark alike.
constexpr std::array k_colours{"#3b82c4", "#d55e00", "#009e73", "#b55fb0", "#c99a00", "#8a8f98"};

const char* const k_style = R"(<style>
.plot{font-family:Inter,"DejaVu Sans",system-ui,sans-serif;font-size:12.5px;fill:#2b2f36}
.plot .ground{fill:#fbfaf8}.plot .frame{fill:#ffffff;stroke:#b9bdc4}.plot .grid{stroke:#e2e4e8}
.plot .title{font-size:17px;font-weight:600}.plot .quiet{fill:#686e78}
.plot .curve{fill:none;stroke-width:2;stroke-linejoin:round}.plot .leader{stroke-width:.8;stroke-opacity:.6;fill:none}
@media (prefers-color-scheme:dark){.plot{fill:#e3e5e8}.plot .ground{fill:#1e2126}
.plot .frame{fill:#22262c;stroke:#4a505a}.plot .grid{stroke:#343a42}.plot .quiet{fill:#9aa0aa}}
</style>)";

class Axis {
 public:
  Axis(double low, double high, const std::string& unit, double begin, double end) : begin_(begin), end_(end) {
    if (!(high - low > 1e-12 * std::max(std::abs(low), std::abs(high)))) {  // one value: about it
      const double half = low == 0 ? 1 : 0.5 * std::abs(low);
      low -= half;
      high += half;
    }
    shown_ = shown_unit(unit, std::max(std::abs(low), std::abs(high)));
    step_ = round_step((high - low) * shown_.per_value, k_legend_parts);
    low_ = step_ * std::floor(low * shown_.per_value / step_ + 1e-9);
    high_ = step_ * std::ceil(high * shown_.per_value / step_ - 1e-9);
  }
  double place(double value) const { return at(value * shown_.per_value); }
  /// body(place, text) for every tick.
  template <class Body>
  void ticks(const Body& body) const {
    const auto count = std::lround((high_ - low_) / step_);
    for (long i = 0; i <= count; ++i) {
      const double tick = low_ + static_cast<double>(i) * step_;
      body(at(tick), tick_text(tick, step_));
    }
  }
  std::string unit() const { return shown_.unit.empty() ? "" : " [" + shown_.unit + "]"; }

 private:
  double at(double shown) const { return begin_ + (shown - low_) / (high_ - low_) * (end_ - begin_); }
  double begin_, end_, low_ = 0, high_ = 1, step_ = 1;
  ShownUnit shown_;
};

Axis axis_of(const std::vector<PlotCurve>& curves, std::vector<double> PlotCurve::*values, const std::string& unit,
             double begin, double end) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const PlotCurve& curve : curves)
    for (const double value : curve.*values) {
      if (!std::isfinite(value))
        throw Error(ErrorCode::bad_geometry, "expected finite values to plot, found one that is not",
                    "curve " + curve.name);
      low = std::min(low, value);
      high = std::max(high, value);
    }
  return {low, high, unit, begin, end};
}

// Heights of the labels: at the ends of their curves, moved apart where they would touch.
std::vector<double> label_heights(const std::vector<double>& wanted) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return wanted[a] != wanted[b] ? wanted[a] < wanted[b] : a < b; });
  std::vector<double> heights = wanted;
  double highest = k_top + 6;
  for (const std::size_t i : order) {
    heights[i] = std::max(heights[i], highest);
    highest = heights[i] + k_line;
  }
  double lowest = k_bottom + 6;
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    heights[*i] = std::min(heights[*i], lowest);
    lowest = heights[*i] - k_line;
  }
  return heights;
}

std::string grid(const LinePlot& plot, const Axis& x, const Axis& y) {
  std::string svg = fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"frame\"/>\n", k_left,
                                k_top, k_right - k_left, k_bottom - k_top);
  x.ticks([&](double at, const std::string& text) {
    svg += fmt::format(
        "<path d=\"M{:.1f} {}V{}\" class=\"grid\"/><text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
        at, k_top, k_bottom + 5, at, k_bottom + 21, text);
  });
  y.ticks([&](double at, const std::string& text) {
    svg += fmt::format(
        "<path d=\"M{} {:.1f}H{}\" class=\"grid\"/><text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
        k_left - 5, at, k_right, k_left - 10, at + 4, text);
  });
  svg += fmt::format("<text x=\"{}\" y=\"32\" class=\"title\">{}</text>\n", k_left, io::xml_text(plot.title));
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" class=\"quiet\">{}</text>\n",
                     0.5 * (k_left + k_right), k_bottom + 44, io::xml_text(plot.x_title + x.unit()));
  svg += fmt::format(
      "<text transform=\"translate(26 {}) rotate(-90)\" text-anchor=\"middle\" class=\"quiet\">{}</text>\n",
      0.5 * (k_top + k_bottom), io::xml_text(plot.y_title + y.unit()));
  return svg;
}

}  // namespace

std::string plot_svg(const LinePlot& plot) {
  const Axis x = axis_of(plot.curves, &PlotCurve::x, plot.x_unit, k_left, k_right);
  const Axis y = axis_of(plot.curves, &PlotCurve::y, plot.y_unit, k_bottom, k_top);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "class=\"plot\" "
      "role=\"img\" aria-label=\"{2}\">\n{3}\n<rect width=\"{0}\" height=\"{1}\" rx=\"6\" class=\"ground\"/>\n",
      k_width, k_height, io::xml_text(plot.title), k_style);
  svg += grid(plot, x, y);
  std::vector<double> ends;
  for (const PlotCurve& curve : plot.curves) ends.push_back(y.place(curve.y.back()));
  const std::vector<double> heights = label_heights(ends);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const PlotCurve& curve = plot.curves[i];
    const char* colour = k_colours[i % k_colours.size()];
    std::string path, marks;
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      const double px = x.place(curve.x[k]), py = y.place(curve.y[k]);
      path += fmt::format("{}{:.1f} {:.1f}", k == 0 ? 'M' : 'L', px, py);
      if (curve.x.size() <= k_most_marked)
        marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\"/>", px, py);
    }
    svg += fmt::format(
        "<g fill=\"{0}\"><path d=\"{1}\" class=\"curve\" stroke=\"{0}\"{2}/>{3}<title>{4}</title></g>\n", colour,
        path, i < k_colours.size() ? "" : " stroke-dasharray=\"6 4\"", marks, io::xml_text(curve.name));
    svg += fmt::format(
        "<path d=\"M{:.1f} {:.1f}L{} {:.1f}\" class=\"leader\" stroke=\"{}\"/><text x=\"{}\" y=\"{:.1f}\" "
        "style=\"fill:{}\">{}</text>\n",
        x.place(curve.x.back()), ends[i], k_right + 14, heights[i], colour, k_right + 18, heights[i] + 4, colour,
        io::xml_text(curve.name));
  }
  return svg + "</svg>\n";
}

}  // namespace argil::sculpt
