// Of chrome.h: the line of numbers at the bottom.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "tools/studio/chrome.h"
#include "tools/studio/quantity.h"

namespace argil::studio {

namespace {

std::string grouped(std::size_t number) {
  const std::string digits = fmt::format("{}", number);
  std::string result;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) result += ',';
    result += digits[i];
  }
  return result;
}

}  // namespace

void draw_status(Desk& desk, const Layout& layout) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Snapshot& now = *desk.now;
  const Rect& place = layout.status;
  ui.begin_panel("status", place, t.status, 0);
  ImDrawList& draw = ui.list();
  float x = ui.px(18);
  const auto word = [&](const std::string& line, bool strong) {
    ImFont* font = strong ? ui.fonts().small_strong : ui.fonts().small;
    ui.text(draw, font, {x, place.y, 0, place.height}, strong ? t.text : t.quiet, line);
    x += ui.width_of(font, line);
  };
  const auto begin = [&] { return x; };
  std::vector<float> ends;  // of the readings
  const auto end = [&](float from, const char* name, const char* tooltip, const char* unit) {
    ui.note_control(ControlKind::reading, name, tooltip, unit, {from, place.y, x - from, place.height});
    ends.push_back(x);
    x += ui.px(26);
  };
  float from = begin();
  word(desk.virtual_clock ? "60" : fmt::format("{:.0f}", desk.frames_a_second), true);
  word(" fps", false);
  end(from, "Frames", "Pictures a second", "1/s");
  from = begin();
  word("step ", false);
  word(desk.virtual_clock || now.steps == 0 ? "— ms" : fmt::format("{:.1f} ms", now.step_ms), true);
  end(from, "Step", "What a step of the simulation costs, mean of the last thirty", "ms");
  from = begin();
  word(grouped(now.elements), true);
  word(" elements  ·  ", false);
  word(grouped(now.unknowns), true);
  word(" unknowns", false);
  end(from, "Size", "Finite elements, and numbers that a step solves for", "1");
  from = begin();
  const auto device = desk.workshop->device();
  word(device ? device->name.substr(0, device->name.find(' ')) + ' ' : "mouse ", false);
  word("1000 Hz", true);
  word(fmt::format(", {} missed", device && !desk.virtual_clock ? device->missed : now.missed_ticks), false);
  end(from, "Device", "Ticks of the device a second, and those that were missed", "Hz");
  from = begin();
  const double force = now.stroke ? now.stroke->force.norm() : 0;
  word("force ", false);
  const Quantity words = shown(force, "N");
  word(words.number + ' ' + words.unit, true);
  x += ui.px(8);
  const float bar = ui.px(70), height = ui.px(8), top = place.y + 0.5F * (place.height - height);
  ui.box(draw, {x, top, bar, height}, t.outline, 2);
  // A tool without a limit fills it where it has gone by its radius.
  const double limit = std::min(desk.brush.largest_force, 2 * desk.brush.strength * desk.brush.radius);
  const double share = std::clamp(force / std::max(1e-9, limit), 0.0, 1.0);
  if (share > 0.02)
    ui.box(draw, {x, top, bar * static_cast<float>(share), height}, now.stroke->at_limit ? t.warning : t.accent, 2);
  x += bar;
  end(from, "Force", "What the tool applies, against its limit", "N");

  // The latest message, else what the physics is.
  const bool fresh = !now.messages.empty() && desk.time - desk.message_since < 6;
  std::string line;
  Ink colour = t.quiet;
  if (fresh) {
    const Message& message = now.messages.back();
    line = message.text;
    colour = message.kind == MessageKind::error     ? t.warning
             : message.kind == MessageKind::warning ? t.accent
                                                    : t.text;
  } else if (now.scene) {
    line = fmt::format("{} space  ·  {}  ·  {}", fem::word(now.state.space), now.state.model.name,
                       fem::method_kind(now.state.method).name);
  }
  const std::string whole = line;
  // What was just said goes before the numbers; what is always so does not.
  const float least = fresh ? ui.px(170) : x, right = place.width - ui.px(18);
  line = ui.fitted(ui.fonts().small, line, right - least);
  const float width = ui.width_of(ui.fonts().small, line);
  const Rect said{right - width, place.y, width, place.height};
  if (said.x < x) {
    float whole_until = 0;
    for (const float reading : ends)
      if (reading < said.x - ui.px(10)) whole_until = reading;
    ui.box(draw, {whole_until, place.y, place.width - whole_until, place.height}, t.status, 0);
  }
  ui.text(draw, ui.fonts().small, said, colour, line);
  if (!whole.empty())
    ui.note_control(ControlKind::reading, "Message",
                    line == whole ? "The latest message, or how the solid is simulated" : whole, "", said);
  ui.end_panel();
}

}  // namespace argil::studio
