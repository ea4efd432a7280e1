#include "tools/chart/colours.h"

#include <array>

namespace argil::chart {

namespace {

// After Okabe and Ito, and Tol, with lightness that shows on light and dark alike.
constexpr std::array k_colours{"#3b82c4", "#d55e00", "#009e73", "#b55fb0", "#c99a00", "#44aac8",
                               "#d6556b", "#7a6fd0", "#7f9a2d", "#2aa198", "#a9744f", "#8a8f98"};

}  // namespace

Colours::Colours(const std::vector<Panel>& panels) {
  for (const Panel& panel : panels)
    if (panel.in_motion && usual_.empty() && !panel.rows.empty() && !panel.rows.front().integrator.empty())
      usual_ = ", " + panel.rows.front().integrator;
  for (const Panel& panel : panels)
    for (const Series& s : series(panel)) number_.emplace(key(s.colour_name), number_.size());
}

std::string Colours::key(const std::string& colour_name) const {
  const bool ends = !usual_.empty() && colour_name.ends_with(usual_);
  return ends ? colour_name.substr(0, colour_name.size() - usual_.size()) : colour_name;
}

Colours::Look Colours::of(const std::string& colour_name) const {
  const auto found = number_.find(key(colour_name));
  const std::size_t number = found == number_.end() ? k_colours.size() - 1 : found->second;
  return {k_colours[number % k_colours.size()], number >= k_colours.size()};
}

}  // namespace argil::chart
