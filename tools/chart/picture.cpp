#include "tools/chart/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/xml_text.h"
#include "tools/chart/label_layout.h"
#include "tools/chart/log_axis.h"
#include "tools/chart/marks.h"

namespace argil::chart {

namespace {

constexpr double k_left = 92, k_top = 92, k_plot_width = 660, k_plot_height = 420, k_legend = 780;
constexpr double k_width = 1040;
constexpr double k_least_error = 1e-6, k_largest_error = 10;
constexpr double k_font = 12;

const char* const k_style = R"(<style>
.argil{font-family:Inter,"DejaVu Sans",system-ui,sans-serif;font-size:12px;fill:#2b2f36}
.argil .ground{fill:#fbfaf8}.argil .plot{fill:#ffffff;stroke:#b9bdc4}
.argil .major{stroke:#d5d8dd}.argil .minor{stroke:#eceef1}
.argil .title{font-size:17px;font-weight:600}.argil .quiet{fill:#686e78}
.argil .front{stroke:#e8a33d;stroke-width:7;stroke-opacity:.5;fill:none;stroke-linejoin:round;stroke-linecap:round}
.argil .line{fill:none;stroke-width:1.3;stroke-opacity:.55}
.argil .hollow{fill:#ffffff}.argil .best{stroke-width:2.2}
.argil .leader{stroke:#686e78;stroke-width:.8}.argil .noise{fill:#686e78;fill-opacity:.1}
.argil .real{stroke:#e4572e;stroke-dasharray:5 4}.argil .failed{stroke:#e4572e;stroke-width:1.6}
.argil .dot{fill:#ffffff;pointer-events:none}.argil .warning{fill:#c8431c}.argil .ink{fill:none;stroke:#686e78;stroke-width:1.6}
.argil .halo{paint-order:stroke;stroke:#ffffff;stroke-width:3;stroke-linejoin:round}
@media (prefers-color-scheme:dark){
.argil{fill:#e3e5e8}.argil .ground{fill:#1e2126}.argil .plot{fill:#22262c;stroke:#4a505a}
.argil .major{stroke:#3a4049}.argil .minor{stroke:#2b3037}.argil .quiet{fill:#9aa0aa}
.argil .hollow{fill:#22262c}.argil .leader{stroke:#9aa0aa}.argil .noise{fill:#9aa0aa;fill-opacity:.12}
.argil .warning{fill:#f08a6b}.argil .ink{stroke:#9aa0aa}.argil .halo{stroke:#22262c}}
</style>)";

struct Plot {
  LogAxis time, error;
  double bottom;
};

Plot plot_of(const Panel& panel) {
  double fast = 1e300, slow = 0, small = 1e300, large = 0;
  for (const Row& row : panel.rows) {
    const double time = panel.time(row);
    if (!std::isfinite(time)) continue;
    fast = std::min(fast, std::max(time, 1e-4));
    slow = std::max(slow, std::max(time, 1e-4));
    small = std::min(small, row.error);
    large = std::max(large, row.error);
  }
  if (slow == 0)
    return {LogAxis(1, 100, k_left, k_left + k_plot_width), LogAxis(1e-3, 1, k_top + k_plot_height, k_top),
            k_top + k_plot_height};
  // An accidental zero, or an exact method, must not stretch the scale.
  const double floor = std::max(k_least_error, panel.uncertainty / 4);
  small = std::clamp(small, floor, k_largest_error);
  large = std::clamp(large, small, k_largest_error);
  return {LogAxis(fast, slow, k_left, k_left + k_plot_width), LogAxis(small, large, k_top + k_plot_height, k_top),
          k_top + k_plot_height};
}

std::string tick_percent(double ratio) {
  return 100 * ratio < 9e-5 ? fmt::format("{:.0e} %", 100 * ratio) : fmt::format("{:.6g} %", 100 * ratio);
}
std::string tick_time(double milliseconds) {
  if (milliseconds >= 999.9) return fmt::format("{:g} s", milliseconds / 1e3);
  if (milliseconds > 0.9999) return fmt::format("{:g} ms", milliseconds);
  return fmt::format("{:g} µs", milliseconds * 1e3);
}

std::string grid(const Panel& panel, const Plot& plot) {
  const double right = k_left + k_plot_width;
  std::string svg = fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"plot\"/>\n", k_left,
                                k_top, k_plot_width, k_plot_height);
  for (const double v : plot.time.minor())
    svg += line(plot.time.place(v), k_top, plot.time.place(v), plot.bottom, "minor");
  for (const double v : plot.error.minor())
    svg += line(k_left, plot.error.place(v), right, plot.error.place(v), "minor");
  for (const double v : plot.time.ticks()) {
    svg += line(plot.time.place(v), k_top, plot.time.place(v), plot.bottom + 5, "major");
    svg += text(plot.time.place(v), plot.bottom + 20, tick_time(v), "", Align::middle);
  }
  for (const double v : plot.error.ticks()) {
    svg += line(k_left - 5, plot.error.place(v), right, plot.error.place(v), "major");
    svg += text(k_left - 9, plot.error.place(v) + 4, tick_percent(v), "", Align::end);
  }
  svg += text(k_left + k_plot_width / 2, plot.bottom + 42,
              panel.in_motion ? "computing time for one simulated second" : "computing time for one solve", "quiet",
              Align::middle);
  svg += fmt::format(
      "<text transform=\"translate(24 {}) rotate(-90)\" text-anchor=\"middle\" class=\"quiet\">relative "
      "error</text>\n",
      k_top + k_plot_height / 2);
  return svg;
}

std::string tooltip(const Panel& panel, const Row& row) {
  std::string what = fmt::format("{}\nerror {} ({}{})\n{} {}\n{} unknowns, {} elements", name_of(row),
                                 percent_text(row.error), row.signed_error < 0 ? "−" : "+",
                                 percent_text(std::abs(row.signed_error)), time_text(panel.time(row)),
                                 panel.in_motion ? "a simulated second" : "a solve", row.unknowns, row.elements);
  if (!row.same_law) what += "\nanother law than the reference's: the error includes their difference";
  return what;
}

struct Placed {
  double x, y;
};
Placed placed(const Panel& panel, const Plot& plot, const Row& row) {
  const double time = std::max(panel.time(row), plot.time.low());
  return {plot.time.place(time), plot.error.place(std::clamp(row.error, plot.error.low(), plot.error.high()))};
}

class Painter {
 public:
  Painter(const Panel& panel, const Colours& colours)
      : panel_(panel),
        colours_(colours),
        plot_(plot_of(panel)),
        series_(series(panel)),
        front_(pareto_front(panel)),
        layout_({k_left + 4, k_top + 4, k_plot_width - 8, k_plot_height - 8}) {}

  std::string draw() {
    std::string body = text(k_left, 34, panel_.title, "title");
    body += text(k_left, 54, panel_.quantity, "quiet") + text(k_left, 71, "Reference: " + panel_.source, "quiet");
    body += grid(panel_, plot_);
    body += noise();
    body += real_time();
    body += front_line();
    body += lines();
    body += markers();
    body += labels();  // last, where the others have left room
    body += failures();
    const Legend legend = draw_legend();
    const double height = std::max(580.0, legend.bottom + 24);
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h:.0f}\" width=\"{w}\" "
               "height=\"{h:.0f}\" class=\"argil\" role=\"img\" aria-label=\"{}\">\n{}\n<rect width=\"{w}\" "
               "height=\"{h:.0f}\" rx=\"6\" class=\"ground\"/>\n",
               io::xml_text(panel_.title), k_style, fmt::arg("w", k_width), fmt::arg("h", height)) +
           body + legend.svg + "</svg>\n";
  }

 private:
  std::string noise() {
    if (!plot_.error.holds(panel_.uncertainty)) return {};
    const double y = plot_.error.place(panel_.uncertainty);
    const std::string what = "within the uncertainty of the reference";
    if (plot_.bottom - y > 18) layout_.keep_free({k_left, plot_.bottom - 18, text_width(what, k_font) + 14, 18});
    std::string svg = fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" class=\"noise\"/>\n",
                                  k_left, y, k_plot_width, plot_.bottom - y);
    if (plot_.bottom - y > 18) svg += text(k_left + 8, plot_.bottom - 6, what, "quiet");
    return svg;
  }
  std::string real_time() {
    if (!panel_.in_motion || !plot_.time.holds(1000)) return {};
    const double x = plot_.time.place(1000);
    layout_.keep_free({x + 2, k_top + 2, text_width("real time", k_font) + 10, 18});
    return line(x, k_top, x, plot_.bottom, "real") + text(x + 6, k_top + 16, "real time", "warning");
  }
  std::string front_line() const {
    std::string path;
    for (const std::size_t i : front_) {
      const Placed at = placed(panel_, plot_, panel_.rows[i]);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", at.x, at.y);
    }
    if (front_.size() == 1) path += "h.1";
    return path.empty() ? std::string{}
                        : fmt::format(
                              "<path d=\"{}\" class=\"front\"><title>Pareto front: no other run is both faster "
                              "and more accurate</title></path>\n",
                              path);
  }
  std::string lines() const {
    std::string svg;
    for (const Series& s : series_) {
      if (s.rows.size() < 2) continue;
      std::string path;
      for (const std::size_t i : s.rows) {
        const Placed at = placed(panel_, plot_, panel_.rows[i]);
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", at.x, at.y);
      }
      svg += fmt::format("<path d=\"{}\" class=\"line\" stroke=\"{}\"{}/>\n", path,
                         colours_.of(s.colour_name).colour, dashes(s.formulation));
    }
    return svg;
  }
  std::string markers() {
    std::string svg;
    for (const bool best : {false, true})  // the front lies on top
      for (const Series& s : series_)
        for (const std::size_t i : s.rows) {
          const Row& row = panel_.rows[i];
          if (best != (std::find(front_.begin(), front_.end(), i) != front_.end())) continue;
          const Placed at = placed(panel_, plot_, row);
          const double r = best ? 5.5 : 4;
          layout_.keep_free({at.x - r - 1, at.y - r - 1, 2 * r + 2, 2 * r + 2});
          const auto [colour, dotted] = colours_.of(s.colour_name);
          const std::string fill = row.same_law ? fmt::format(" fill=\"{}\"", colour) : std::string{};
          svg += fmt::format("<path d=\"{}\" class=\"{}{}\"{} stroke=\"{}\"><title>{}</title></path>\n",
                             marker(at.x, at.y, row.space, r), row.same_law ? "" : "hollow", best ? " best" : "",
                             fill, colour, io::xml_text(tooltip(panel_, row)));
          if (dotted) svg += dot(at.x, at.y, row.same_law ? nullptr : colour);
          if (!plot_.error.holds(row.error)) {  // beyond the frame: an arrow says where to
            const double up = row.error > plot_.error.high() ? -1 : 1;
            svg += fmt::format("<path d=\"M{:.1f} {:.1f}l-3 {:.1f}h6z\" fill=\"{}\"/>\n", at.x, at.y + up * (r + 7),
                               -4 * up, colour);
          }
        }
    return svg;
  }
  std::string labels() {
    std::string svg;
    std::string before;
    for (const std::size_t i : front_) {
      const Row& row = panel_.rows[i];
      const std::string what = row.method() + ", " + row.space;
      if (what == before) continue;
      const Placed at = placed(panel_, plot_, row);
      const auto found = layout_.place(at.x, at.y, text_width(what, k_font), 15);
      if (!found) continue;
      before = what;
      const double y = found->box.y + 11.5;
      if (found->leader) {
        const Box& box = found->box;
        svg += line(at.x, at.y, std::clamp(at.x, box.x, box.x + box.width),
                    std::clamp(at.y, box.y + 2, box.y + box.height - 2), "leader");
      }
      svg += text(found->box.x, y, what, "halo");
    }
    return svg;
  }
  // Runs without an error, as crosses in a lane above the frame, where their time puts them.
  std::string failures() const {
    std::string svg;
    std::size_t unplaced = 0, count = 0;
    for (const Row& row : panel_.rows) {
      if (row.status == Status::ok) continue;
      ++count;
      const double time = panel_.in_motion && row.status == Status::diverged && std::isfinite(row.time_step)
                              ? row.ms_per_step / row.time_step
                              : row.ms;
      if (!std::isfinite(time) || !plot_.time.holds(time)) {
        ++unplaced;
        continue;
      }
      const double x = plot_.time.place(time), y = k_top - 9;
      svg += fmt::format("<path d=\"M{:.1f} {:.1f}l7 7m0 -7l-7 7\" class=\"failed\"><title>{}</title></path>\n",
                         x - 3.5, y - 3.5,
                         io::xml_text(fmt::format("{}\n{}: {}", name_of(row), word(row.status), row.message)));
    }
    if (count == 0) return {};
    const std::string what = count > unplaced ? fmt::format("× {} diverged or stopped, {} refused or not started",
                                                            count - unplaced, unplaced)
                                              : fmt::format("{} refused or not finished", count);
    return svg + text(k_width - 24, 34, what, "warning", Align::end);
  }

  struct Legend {
    std::string svg;
    double bottom = 0;
  };
  Legend draw_legend() const {
    Legend legend;
    double y = k_top + 10;
    const auto heading = [&](const char* what) {
      legend.svg += text(k_legend, y, what, "quiet");
      y += 19;
    };
    std::vector<std::string> names, spaces, formulations;
    bool hollow = false;
    const auto note = [](std::vector<std::string>& list, const std::string& name) {
      if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
    };
    for (const Series& s : series_) {
      note(names, s.colour_name);
      note(spaces, s.space);
      note(formulations, s.formulation);
      hollow = hollow || !s.same_law;
    }
    heading(panel_.in_motion ? "Model, integrator" : "Model");
    for (const std::string& name : names) {
      legend.svg +=
          fmt::format("<path d=\"M{} {:.1f}h20\" stroke=\"{}\" stroke-width=\"4\" stroke-linecap=\"round\"/>\n",
                      k_legend + 2, y - 4, colours_.of(name).colour);
      if (colours_.of(name).dotted) legend.svg += dot(k_legend + 12, y - 4);
      legend.svg += text(k_legend + 32, y, name);
      y += 18;
    }
    y += 8;
    heading("Space");
    for (const std::string& space : spaces) {
      legend.svg += fmt::format("<path d=\"{}\" class=\"ink\"/>\n", marker(k_legend + 12, y - 4, space, 4.5));
      legend.svg += text(k_legend + 32, y, space);
      y += 18;
    }
    if (formulations.size() > 1) {
      y += 8;
      heading("Hexahedra");
      for (const std::string& formulation : formulations) {
        legend.svg +=
            fmt::format("<path d=\"M{} {:.1f}h24\" class=\"ink\"{}/>\n", k_legend, y - 4, dashes(formulation));
        legend.svg += text(k_legend + 32, y, formulation);
        y += 18;
      }
    }
    y += 8;
    legend.svg += fmt::format("<path d=\"M{} {:.1f}h18\" class=\"front\"/>\n", k_legend + 3, y - 4);
    legend.svg += text(k_legend + 32, y, "Pareto front");
    y += 18;
    if (hollow) {
      legend.svg += fmt::format("<path d=\"{}\" class=\"ink\"/>\n", marker(k_legend + 12, y - 4, "default", 4.5));
      legend.svg += text(k_legend + 32, y, "hollow: another law than");
      legend.svg += text(k_legend + 32, y + 15, "the reference's");
      y += 33;
    }
    legend.bottom = y;
    return legend;
  }

  const Panel& panel_;
  const Colours& colours_;
  Plot plot_;
  std::vector<Series> series_;
  std::vector<std::size_t> front_;
  LabelLayout layout_;
};

}  // namespace

std::string picture(const Panel& panel, const Colours& colours) {
  return Painter(panel, colours).draw();
}

}  // namespace argil::chart
