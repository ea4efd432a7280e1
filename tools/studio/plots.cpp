#include "tools/studio/plots.h"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "tools/studio/quantity.h"

namespace argil::studio {

namespace {

constexpr std::size_t k_points = 400;

void append(std::vector<float>& values, double value) {
  values.push_back(static_cast<float>(value));
  if (values.size() > k_points) values.erase(values.begin());
}

/// "0.12 J to friction, 3 mJ to flow", of what has left the body for good; empty if nothing has.
std::string lost_words(const sculpt::LostEnergy& lost) {
  std::string words;
  for (const auto& [value, to] : {std::pair{lost.friction, "friction"}, std::pair{lost.flow, "flow"}}) {
    if (!(value > 0)) continue;
    const Quantity quantity = shown(value, "J");
    words += (words.empty() ? "" : ", ") + quantity.number + ' ' + quantity.unit + " to " + to;
  }
  return words;
}

}  // namespace

void draw_plot(Desk& desk, const Plot& plot, const std::vector<float>& values, float x, float width) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  ImDrawList& draw = ui.list();
  const Rect place{x, ui.cursor_y() + ui.px(14), width, ui.px(64)};
  draw.AddLine({place.x, place.bottom()}, {place.right(), place.bottom()}, t.outline, ui.px(1));
  float most = 0;
  for (const float value : values) most = std::max(most, value);
  if (values.size() > 1 && most > 0) {
    std::vector<ImVec2> points;
    for (std::size_t i = 0; i < values.size(); ++i)
      points.emplace_back(place.x + place.width * static_cast<float>(i) / static_cast<float>(values.size() - 1),
                          place.bottom() - ui.px(2) - (place.height - ui.px(8)) * values[i] / most);
    draw.AddPolyline(points.data(), static_cast<int>(points.size()), t.accent, 0, ui.px(1.6F));
    const Quantity words = shown(most, plot.unit);
    ui.text(draw, ui.fonts().small, {place.x, place.y - ui.px(18), place.width, ui.px(16)}, t.faint,
            words.number + ' ' + words.unit, Side::right);
  } else {
    ui.text(draw, ui.fonts().small, {place.x, place.y, place.width, place.height}, t.faint, plot.empty,
            Side::centre);
  }
  if (std::string_view(plot.unit) == "J")
    ui.text(draw, ui.fonts().small, {place.x, place.y - ui.px(18), place.width, ui.px(16)}, t.faint,
            lost_words(desk.now->state.lost));
  ui.note_control(ControlKind::reading, plot.name, plot.tooltip, plot.unit, place);
  ui.skip(88);
}

void follow_plots(Desk& desk) {
  const bool wants = desk.settings.panels && desk.settings.panel == Panel::physics;
  if (wants != desk.wants_energy) {
    desk.wants_energy = wants;
    desk.show();
  }
  const Snapshot& now = *desk.now;
  if (now.stroke) {
    append(desk.force_plot, now.stroke->force.norm());
    if (now.stroke->felt > 0) desk.reading.felt = now.stroke->felt;
  }
  if (now.solid_number != desk.plotted_solid) desk.energy_plot.clear();
  desk.plotted_solid = now.solid_number;
  if (now.energy >= 0 && now.version != desk.plotted_version) append(desk.energy_plot, now.energy);
  desk.plotted_version = now.version;
}

}  // namespace argil::studio
