#include "tools/atlas/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/xml_text.h"
#include "tools/atlas/map.h"

namespace argil::atlas {

namespace {

/// Least and greatest of what was added.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  int count = 0;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
    ++count;
  }
  std::string words(std::string_view unit) const {
    const std::string after = unit.empty() ? "" : " " + std::string(unit);
    const std::string a = fmt::format("{:.3g}", low), b = fmt::format("{:.3g}", high);
    return (a == b ? a : a + " to " + b) + after;
  }
};

double share_at(const LineGrid& grid, double point) {
  return point / grid.last();
}

}  // namespace

std::string statement(const Sweep& sweep, const LineGrid& grid, const Panel& panel) {
  Range diverges, relative, accurate;
  int refused = 0, never_accurate = 0, all_accurate = 0, never_diverged = 0;
  std::string reason;
  for (const MapLine& line : panel.lines) {
    if (line.stretches.empty()) continue;
    if (line.stretches.front().outcome == Outcome::refused) {
      ++refused;
      if (reason.empty() && !line.probes.empty()) reason = line.probes.front().result.note;
      continue;
    }
    const auto first = [&](auto fits) { return std::find_if(line.stretches.begin(), line.stretches.end(), fits); };
    const auto diverged = first([](const Stretch& s) { return s.outcome == Outcome::diverged; });
    if (diverged == line.stretches.end()) {
      ++never_diverged;
    } else {
      diverges.add(searched_value(sweep, grid, diverged->begin));
      const double limit = limit_share(sweep, line);
      if (limit > 0 && diverged->begin > 0 && sweep.searched.value == &Scene::time_step)
        relative.add(sweep.searched.at(share_at(grid, diverged->begin)) / sweep.searched.at(limit));
    }
    if (line.stretches.front().outcome != Outcome::stable)
      ++never_accurate;
    else if (line.stretches.size() == 1)
      ++all_accurate;
    else
      accurate.add(searched_value(sweep, grid, line.stretches.front().end));
  }
  const ParameterInfo& info = parameter(sweep.searched.value);
  const std::string name = info.name == "time_step" ? "Δt" : "a " + std::string(info.name) + " of";
  const std::string lines = std::to_string(panel.lines.size());
  std::string text;
  const auto say = [&](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
  if (refused == static_cast<int>(panel.lines.size())) return "Cannot be run here: " + reason + ".";
  if (refused > 0) say(fmt::format("Cannot be run on {} of {} lines: {}.", refused, lines, reason));
  if (diverges.count == 0)
    say("Nowhere diverged.");
  else
    say(fmt::format(
        "Diverges from {} {} upwards{}{}.", name, diverges.words(info.unit),
        never_diverged > 0 ? fmt::format(" on {} of {} lines", diverges.count, lines) : std::string(),
        relative.count > 0 ? fmt::format(", which is {} of 2/ω_max", relative.words("")) : std::string()));
  if (accurate.count > 0) say(fmt::format("Accurate up to {} {}.", name, accurate.words(info.unit)));
  if (all_accurate > 0) say(fmt::format("Accurate everywhere on {} of {} lines.", all_accurate, lines));
  if (never_accurate > 0)
    say(fmt::format("Not accurate even at the smallest {} on {} of {} lines.",
                    info.name == "time_step" ? "Δt" : std::string(info.name), never_accurate, lines));
  return text;
}

std::string page_html(const std::vector<SweepResult>& results, const AtlasOptions& options) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>Argil: stability atlas</title>\n<style>\n"
      "body{font:16px/1.5 Inter,'DejaVu Sans',sans-serif;margin:2rem auto;max-width:72rem;padding:0 "
      "1rem;color:#222}\n"
      "figure{margin:1rem 0;overflow-x:auto}\nh2{margin-top:3rem}\n"
      "table{border-collapse:collapse;font-size:14px}\ntd,th{border-bottom:1px solid #ddd;padding:.25rem .6rem;"
      "text-align:left;vertical-align:top}\n</style>\n</head>\n<body>\n<h1>Stability atlas</h1>\n";
  html += fmt::format(
      "<p>Where each force model with each integrator is stable, inaccurate, or diverges. Along each line of a map "
      "the "
      "boundaries were found by bisection, to {:.2g} of the axis. A run is called <b>diverged</b> if a value is "
      "not "
      "finite or kinetic and potential energy exceed {:g} times what the start held and the loads have done; "
      "<b>inaccurate</b> if it strays from {} fine implicit steps of the same model by more than {:g} % of the "
      "largest "
      "displacement. Runs take at least {} steps. The guard that a session has is off. Every probe is a row of "
      "<a href=\"probes.csv\">probes.csv</a>.</p>\n",
      1.0 / options.grid.last(), options.criteria.energy_factor, 2 * options.criteria.reference_steps,
      100 * options.criteria.error, options.criteria.least_steps);
  html += "<ul>\n";
  for (const SweepResult& result : results)
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", result.sweep.name, io::xml_text(result.sweep.title));
  html += "</ul>\n";
  for (const SweepResult& result : results) {
    html += fmt::format("<h2 id=\"{}\">{}</h2>\n<figure>\n{}</figure>\n", result.sweep.name,
                        io::xml_text(result.sweep.title), map_svg(result.sweep, options, result.panels));
    html += "<table>\n<tr><th>Model</th><th>Integrator</th><th>What the map shows</th></tr>\n";
    for (const Panel& panel : result.panels)
      html +=
          fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", io::xml_text(panel.model),
                      io::xml_text(panel.integrator), io::xml_text(statement(result.sweep, options.grid, panel)));
    html += "</table>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace argil::atlas
