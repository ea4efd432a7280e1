#include "tools/studio/device_dialogue.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "tools/studio/sheet.h"

namespace argil::studio {

void draw_devices(Desk& desk, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  if (desk.dialogue != desk.shown_dialogue) desk.workshop->list_devices();
  static const std::vector<DeviceChoice> k_none;
  const auto listed = desk.workshop->devices();
  const std::vector<DeviceChoice>& choices = listed ? *listed : k_none;
  const auto now = desk.workshop->device();
  const std::string used = now ? now->name : "mouse";
  const float wide = ui.px(640), row = ui.px(46), field = ui.px(52);
  const Rect place{
      0.5F * (static_cast<float>(width) - wide), ui.px(90), wide,
      ui.px(52) + row * static_cast<float>(std::max<std::size_t>(1, choices.size())) + field + ui.px(10)};
  open_sheet(desk, "devices", place, width, height);
  ImDrawList& draw = ui.list();
  ui.text(draw, ui.fonts().strong, {place.x + ui.px(20), place.y + ui.px(10), wide, ui.px(28)}, t.text, "Devices");
  ui.text(draw, ui.fonts().small, {place.x, place.y + ui.px(10), wide - ui.px(20), ui.px(28)}, t.faint,
          "its first button sculpts; the mouse stays beside it", Side::right);
  float y = place.y + ui.px(50);
  for (const DeviceChoice& choice : choices) {
    const bool is_used = choice.name == used || used.starts_with(choice.name + ' ');
    const float left = place.x + ui.px(20), room = wide - ui.px(40) - ui.px(104);
    ui.text(draw, ui.fonts().small_strong, {left, y, ui.px(120), ui.px(22)}, is_used ? t.accent : t.text,
            choice.name);
    const Rect told{left + ui.px(120), y, room - ui.px(120), ui.px(22)};
    ui.text(draw, ui.fonts().small, told, t.text, ui.fitted(ui.fonts().small, choice.summary, told.width));
    ui.text(draw, ui.fonts().small, {told.x, y + ui.px(18), told.width, told.height},
            choice.present ? t.quiet : t.faint, ui.fitted(ui.fonts().small, choice.state, told.width));
    ui.note_control(ControlKind::reading, "About " + choice.name, choice.summary + ": " + choice.state, "",
                    {left, y, room, row});
    if (choice.present && !is_used && choice.opens &&
        ui.text_button(("Use " + choice.name).c_str(),
                       {place.right() - ui.px(112), y + ui.px(6), ui.px(92), ui.px(30)}, "Use", false,
                       "Sculpts with it: " + choice.summary)) {
      desk.workshop->use_device(choice.name);
      desk.dialogue = Dialogue::none;
    }
    y += row;
  }
  // A device by UDP is named by its address.
  const Rect box{place.x + ui.px(16), y + ui.px(8), wide - ui.px(150), ui.px(34)};
  ui.box(draw, box, t.well);
  bool entered = false;
  ui.text_field("Address", {box.x + ui.px(4), box.y, box.width - ui.px(8), box.height}, desk.typed,
                "127.0.0.1:PORT, as `argil devices --serve` says it", false, entered,
                "Address and port of a device by UDP");
  const bool pressed =
      ui.text_button("Use address", {place.right() - ui.px(112), box.y + ui.px(2), ui.px(92), ui.px(30)}, "Connect",
                     true, "Sculpts with the device at this address");
  if ((pressed || entered) && !desk.typed.empty()) {
    desk.workshop->use_device("network " + desk.typed);
    desk.dialogue = Dialogue::none;
  }
  ui.end_panel();
}

void draw_device_mark(Desk& desk, const OrbitCamera& camera) {
  const auto now = desk.workshop->device();
  if (!now) return;
  const Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Eigen::Vector3d& at = now->sample.pose.position;
  const Eigen::Vector2d pixel = camera.pixel(at);
  if (!pixel.allFinite()) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ImVec2 middle{static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
  const bool works = (now->sample.buttons & 1U) != 0;
  const auto radius = static_cast<float>(desk.brush.radius / std::max(1e-12, camera.pixel_size(at)));
  draw.AddCircle(middle, std::clamp(radius, ui.px(6), ui.px(600)), works ? t.accent : t.mark, 64, ui.px(1.5F));
  draw.AddCircleFilled(middle, ui.px(4), works ? t.accent : t.mark, 20);
  const double felt = now->sample.force.norm();
  if (felt > 0.005)
    ui.text(draw, ui.fonts().small, {middle.x + ui.px(10), middle.y - ui.px(22), ui.px(120), ui.px(20)}, t.text,
            fmt::format("{:.2f} N in the hand", felt));
}

void lay_brush_ready(Desk& desk, const OrbitCamera& camera) {
  if (!desk.workshop->device() || !desk.now->scene) return;
  ReadyBrush brush;
  brush.tool = desk.brush;
  brush.keep = desk.settings.keep_shape && desk.tool().kind == ToolKind::force;
  brush.pressed = desk.settings.pen != PenScales::nothing;
  brush.scales_radius = desk.settings.pen == PenScales::radius;
  brush.middle = 0.5 * (desk.now->low + desk.now->high);
  brush.radius = 0.75 * (desk.now->high - desk.now->low).norm();
  brush.view = -camera.towards_eye();
  // The solid moves in every step; the workspace follows where it matters.
  const ReadyBrush& last = desk.ready;
  const bool same = tool_line(last.tool, brush.tool).empty() && last.keep == brush.keep &&
                    last.pressed == brush.pressed && last.scales_radius == brush.scales_radius &&
                    (last.view - brush.view).norm() < 1e-3 &&
                    (last.middle - brush.middle).norm() < 0.05 * brush.radius &&
                    std::abs(last.radius - brush.radius) < 0.1 * brush.radius;
  if (same && desk.brush_is_ready) return;
  desk.ready = brush;
  desk.brush_is_ready = true;
  desk.workshop->lay_ready(brush);
}

}  // namespace argil::studio
