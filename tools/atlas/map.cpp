#include "tools/atlas/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/xml_text.h"

namespace argil::atlas {

namespace {

constexpr double k_panel_width = 210, k_panel_height = 140;             // the map itself
constexpr double k_left = 62, k_right = 18, k_top = 46, k_bottom = 44;  // of a panel, for its labels
constexpr double k_head = 118;
constexpr int k_fewest_columns = 3, k_most_columns = 10;

struct Look {
  const char* fill;
  const char* words;
};
/// After Okabe and Ito; light to dark.
Look look(Outcome outcome) {
  switch (outcome) {
    case Outcome::stable:
      return {"#9fd0ee", "stable"};
    case Outcome::inaccurate:
      return {"url(#inaccurate)", "inaccurate"};
    case Outcome::diverged:
      return {"url(#diverged)", "diverged"};
    case Outcome::refused:
      return {"#e4e4e4", "cannot be run"};
  }
  return {"none", ""};
}

std::string power_of_ten(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent == 0) return "1";
  if (exponent == 1) return "10";
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

struct Tick {
  double share;
  std::string text;
};
std::vector<Tick> ticks(const Axis& axis) {
  std::vector<Tick> result;
  const auto [low, high] = std::minmax(axis.first, axis.last);
  if (axis.is_logarithmic) {
    const int begin = static_cast<int>(std::ceil(std::log10(low) - 1e-6));
    const int end = static_cast<int>(std::floor(std::log10(high) + 1e-6));
    const int stride = (end - begin) / 5 + 1;
    for (int e = begin; e <= end; e += stride)
      result.push_back({axis.share_of(std::pow(10.0, e)), power_of_ten(e)});
  } else {
    for (int i = 0; i <= 4; ++i) {
      const double value = low + (high - low) * i / 4;
      result.push_back({axis.share_of(value), fmt::format("{:g}", value)});
    }
  }
  return result;
}

std::string value_text(const Axis& axis, double share) {
  const ParameterInfo& info = parameter(axis.value);
  return fmt::format("{:.3g}{}{}", axis.at(share), info.unit.empty() ? "" : " ", info.unit);
}

/// Gives both lines the same outcomes in the same order, by empty stretches at a rim; false if that is not enough.
bool align(std::vector<Stretch>& a, std::vector<Stretch>& b, double last) {
  std::vector<Stretch>&shorter = a.size() < b.size() ? a : b, &longer = a.size() < b.size() ? b : a;
  const std::size_t missing = longer.size() - shorter.size();
  const auto fits = [&](std::size_t offset) {
    for (std::size_t i = 0; i < shorter.size(); ++i)
      if (shorter[i].outcome != longer[i + offset].outcome) return false;
    return true;
  };
  if (fits(0)) {
    for (std::size_t i = shorter.size(); i < longer.size(); ++i) shorter.push_back({last, last, longer[i].outcome});
    return true;
  }
  if (!fits(missing)) return false;
  for (std::size_t i = missing; i-- > 0;) shorter.insert(shorter.begin(), Stretch{0, 0, longer[i].outcome});
  return true;
}

class Picture {
 public:
  Picture(const Sweep& sweep, const AtlasOptions& options, const std::vector<Panel>& panels)
      : sweep_(sweep),
        options_(options),
        panels_(panels),
        horizontal_(sweep.searched_is_horizontal ? sweep.searched : sweep.swept),
        vertical_(sweep.searched_is_horizontal ? sweep.swept : sweep.searched) {}

  std::string draw() {
    // As many columns as there are integrators where every model has them all, so that rows are models.
    std::size_t same = 0;
    while (same < panels_.size() && panels_[same].model == panels_.front().model) ++same;
    bool is_table = same > 1 && panels_.size() % std::max<std::size_t>(same, 1) == 0;
    for (std::size_t i = 0; i < panels_.size() && is_table; ++i)
      is_table = panels_[i].integrator == panels_[i % same].integrator;
    const int few = static_cast<int>(std::ceil(std::sqrt(1.5 * static_cast<double>(panels_.size()))));
    const int columns =
        std::clamp(is_table ? static_cast<int>(same) : few,
                   is_table ? 1 : std::min(k_fewest_columns, static_cast<int>(panels_.size())), k_most_columns);
    const int rows = (static_cast<int>(panels_.size()) + columns - 1) / columns;
    const double width = std::max(840.0, columns * (k_left + k_panel_width + k_right) + 20);
    const double height = k_head + rows * (k_top + k_panel_height + k_bottom) + 10;
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"0 0 {:.0f} "
        "{:.0f}\" "
        "font-family=\"Inter, 'DejaVu Sans', sans-serif\" font-size=\"12\" fill=\"#222\">\n",
        width, height, width, height);
    add("<title>{}</title>\n", io::xml_text(sweep_.title));
    add("{}", k_patterns);
    add("<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n");
    head();
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      const auto n = static_cast<int>(i);
      panel(panels_[i], 10 + (n % columns) * (k_left + k_panel_width + k_right),
            k_head + (n / columns) * (k_top + k_panel_height + k_bottom));
    }
    add("</svg>\n");
    return fmt::to_string(out_);
  }

 private:
  static constexpr const char* k_patterns =
      "<defs>\n"
      "<pattern id=\"inaccurate\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><rect width=\"7\" height=\"7\" fill=\"#f3cf5b\"/><rect width=\"1.6\" "
      "height=\"7\" fill=\"#b98a00\"/></pattern>\n"
      "<pattern id=\"diverged\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\"><rect width=\"7\" "
      "height=\"7\" fill=\"#b8420f\"/><path d=\"M1.5 1.5 L5.5 5.5 M5.5 1.5 L1.5 5.5\" stroke=\"#f7c9a8\" "
      "stroke-width=\"1\"/></pattern>\n</defs>\n";

  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
  }

  void head() {
    add("<text x=\"14\" y=\"28\" font-size=\"20\" font-weight=\"600\">{}</text>\n", io::xml_text(sweep_.title));
    add("<text x=\"14\" y=\"49\">{}</text>\n", io::xml_text("Scene: " + sweep_.scene_words + "."));
    const bool inverted = sweep_.scene.motion == Motion::invert;
    const std::string near =
        inverted ? std::string("some point still inside out at the end")
                 : fmt::format("more than {:g} % of the largest displacement away from fine implicit steps",
                               100 * options_.criteria.error);
    add("<text x=\"14\" y=\"67\" fill=\"#555\">{}</text>\n", io::xml_text(fmt::format("Inaccurate: {}.", near)));
    add("<text x=\"14\" y=\"83\" fill=\"#555\">{}</text>\n",
        io::xml_text(
            fmt::format("Diverged: not finite, or more than {:g} times the energy that was put in, within at "
                        "least {} steps.",
                        options_.criteria.energy_factor, options_.criteria.least_steps)));
    double x = 14;
    for (const Outcome outcome : {Outcome::stable, Outcome::inaccurate, Outcome::diverged, Outcome::refused}) {
      const Look what = look(outcome);
      add("<rect x=\"{}\" y=\"94\" width=\"26\" height=\"14\" fill=\"{}\" stroke=\"#666\" stroke-width=\".5\"/>"
          "<text x=\"{}\" y=\"105\">{}</text>\n",
          x, what.fill, x + 32, what.words);
      x += 50 + 7.2 * static_cast<double>(std::string_view(what.words).size());
    }
    add("<path d=\"M{} 101 h30\" {}/><path d=\"M{} 101 h30\" {}/><text x=\"{}\" y=\"105\">Δt = 2/ω_max, the limit "
        "of "
        "explicit methods</text>\n",
        x, k_halo, x, k_limit, x + 38);
  }

  static constexpr const char* k_halo = "stroke=\"white\" stroke-width=\"4.5\" fill=\"none\"";
  static constexpr const char* k_limit =
      "stroke=\"black\" stroke-width=\"1.8\" stroke-dasharray=\"6 3\" fill=\"none\"";

  /// From shares of the two axes to the picture.
  double x_of(double horizontal) const { return left_ + horizontal * k_panel_width; }
  double y_of(double vertical) const { return top_ + (1 - vertical) * k_panel_height; }

  void panel(const Panel& panel, double x, double y) {
    left_ = x + k_left;
    top_ = y + k_top;
    add("<g>\n<text x=\"{:.1f}\" y=\"{:.1f}\" font-weight=\"600\">{}</text>\n"
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{}{}</text>\n",
        left_, top_ - 22, io::xml_text(panel.integrator), left_, top_ - 7, io::xml_text(panel.model),
        panel.is_implicit ? "" : " (explicit)");
    add("<g shape-rendering=\"crispEdges\">\n");
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
      const MapLine& line = panel.lines[i];
      // From halfway to the line before to halfway to the line after.
      if (i > 0) half_band(panel, line, panel.lines[i - 1]);
      if (i + 1 < panel.lines.size()) half_band(panel, line, panel.lines[i + 1]);
      if (panel.lines.size() == 1) {
        for (const Stretch& stretch : line.stretches) quad(panel, line, stretch, stretch, 0, 1);
      }
    }
    add("</g>\n");
    limit(panel);
    add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#333\"/>\n", left_, top_,
        k_panel_width, k_panel_height);
    axes();
    add("</g>\n");
  }

  /// What is nearer to `line` than to its neighbour; where both have the same outcomes in the same order, but for
  /// some that begin or end at the rim, boundaries run straight from one to the other.
  void half_band(const Panel& panel, const MapLine& line, const MapLine& neighbour) {
    const double middle = 0.5 * (line.swept + neighbour.swept);
    std::vector<Stretch> here = line.stretches, there = neighbour.stretches;
    const bool alike = align(here, there, options_.grid.last());
    for (std::size_t i = 0; i < here.size(); ++i) {
      Stretch half = here[i];
      if (alike) {
        half.begin = 0.5 * (half.begin + there[i].begin);
        half.end = 0.5 * (half.end + there[i].end);
      }
      quad(panel, line, here[i], half, line.swept, middle);
    }
  }

  /// A stretch of a line at `swept`, and what it becomes at `other`.
  void quad(const Panel& panel, const MapLine& line, const Stretch& stretch, const Stretch& there, double swept,
            double other) {
    const double last = options_.grid.last();
    const auto corner = [&](double searched, double across) {
      const bool flat = sweep_.searched_is_horizontal;
      return fmt::format("{:.2f},{:.2f}", x_of(flat ? searched / last : across),
                         y_of(flat ? across : searched / last));
    };
    add("<polygon points=\"{} {} {} {}\" fill=\"{}\"><title>{}</title></polygon>\n", corner(stretch.begin, swept),
        corner(stretch.end, swept), corner(there.end, other), corner(there.begin, other),
        look(stretch.outcome).fill, io::xml_text(tooltip(panel, line, stretch)));
  }

  std::string tooltip(const Panel& panel, const MapLine& line, const Stretch& stretch) const {
    const double last = options_.grid.last();
    std::string text = fmt::format("{}, {}: {}\n{} = {}\n{} from {} to {}", panel.model, panel.integrator,
                                   look(stretch.outcome).words, parameter(sweep_.swept.value).name,
                                   value_text(sweep_.swept, line.swept), parameter(sweep_.searched.value).name,
                                   value_text(sweep_.searched, stretch.begin / last),
                                   value_text(sweep_.searched, stretch.end / last));
    for (const ProbeRow& row : line.probes) {
      const double share = sweep_.searched.share_of(row.searched);
      if (share * last < stretch.begin || share * last > stretch.end) continue;
      text += fmt::format("\n{:.3g}: {}", row.searched,
                          row.result.note.empty()
                              ? std::isnan(row.result.error)
                                    ? std::string("good")
                                    : fmt::format("{:.2g} of the displacement off", row.result.error)
                              : row.result.note);
    }
    return text;
  }

  void limit(const Panel& panel) {
    std::string path;
    for (const MapLine& line : panel.lines) {
      const double share = limit_share(sweep_, line);
      if (share < 0) continue;
      const bool flat = sweep_.searched_is_horizontal;
      path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : " L", x_of(flat ? share : line.swept),
                          y_of(flat ? line.swept : share));
    }
    if (path.empty()) return;
    add("<path d=\"{}\" {}/><path d=\"{}\" {}/>\n", path, k_halo, path, k_limit);
  }

  void axes() {
    const double bottom = top_ + k_panel_height;
    for (const Tick& tick : ticks(horizontal_))
      add("<path d=\"M{:.1f} {:.1f} v4\" stroke=\"#333\"/><text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" "
          "font-size=\"10.5\">{}</text>\n",
          x_of(tick.share), bottom, x_of(tick.share), bottom + 16, tick.text);
    for (const Tick& tick : ticks(vertical_))
      add("<path d=\"M{:.1f} {:.1f} h-4\" stroke=\"#333\"/><text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\" "
          "font-size=\"10.5\">{}</text>\n",
          left_, y_of(tick.share), left_ - 7, y_of(tick.share) + 3.8, tick.text);
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-size=\"11\">{}</text>\n",
        left_ + k_panel_width / 2, bottom + 32, io::xml_text(parameter(horizontal_.value).title));
    add("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\" "
        "font-size=\"11\">{}</text>\n",
        left_ - 44, top_ + k_panel_height / 2, io::xml_text(parameter(vertical_.value).title));
  }

  const Sweep& sweep_;
  const AtlasOptions& options_;
  const std::vector<Panel>& panels_;
  Axis horizontal_, vertical_;
  double left_ = 0, top_ = 0;
  fmt::memory_buffer out_;
};

}  // namespace

double limit_share(const Sweep& sweep, const MapLine& line) {
  const auto excess = [](const ProbeRow& row) { return std::log(row.time_step / row.result.largest_stable_step); };
  for (std::size_t i = 0; i < line.probes.size(); ++i) {
    if (!(line.probes[i].result.largest_stable_step > 0)) return -1;
    if (i == 0) continue;
    const double a = excess(line.probes[i - 1]), b = excess(line.probes[i]);
    if ((a < 0) == (b < 0)) continue;
    const double from = sweep.searched.share_of(line.probes[i - 1].searched);
    const double to = sweep.searched.share_of(line.probes[i].searched);
    return from + (to - from) * a / (a - b);
  }
  return -1;
}

std::string map_svg(const Sweep& sweep, const AtlasOptions& options, const std::vector<Panel>& panels) {
  return Picture(sweep, options, panels).draw();
}

}  // namespace argil::atlas
