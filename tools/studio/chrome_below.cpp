// Of chrome.h: the timeline and the line of numbers below it.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "sculpt/obstacles.h"
#include "tools/studio/chrome.h"

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

// Of all that is keyed: gravity, forces, pins and obstacles.
std::vector<double> key_times(const sculpt::State& state) {
  std::vector<double> times;
  const auto add = [&](const sculpt::Track& track) {
    times.insert(times.end(), track.times.begin(), track.times.end());
  };
  add(state.loads->gravity_track);
  for (const sculpt::AppliedForce& force : state.loads->forces) add(force.track);
  for (const sculpt::AppliedPressure& pressure : state.loads->pressures) add(pressure.track);
  add(state.loads->prestress_track);
  for (const sculpt::PinMotion& motion : state.pins->motions) add(motion.track);
  if (state.obstacles)
    for (const sculpt::NamedObstacle& obstacle : *state.obstacles) add(obstacle.track);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

void draw_timeline(Desk& desk, const Layout& layout, const Perform& perform) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Snapshot& now = *desk.now;
  const Rect& place = layout.timeline;
  ui.begin_panel("timeline", place, t.bar, 0);
  ImDrawList& draw = ui.list();
  const float size = ui.px(30), y = place.y + 0.5F * (place.height - size);
  float x = ui.px(10);
  if (ui.icon_button(
          "Play", {x, y, size, size}, now.playing ? icons::pause : icons::play, false,
          (now.playing ? "Stops time" : "Lets time run") + ("  ·  " + desk.bindings.word_of(Action::play))))
    perform(Action::play);
  x += size + ui.px(2);
  if (ui.icon_button("One step", {x, y, size, size}, icons::step, false, desk.tooltip(Action::one_step)))
    perform(Action::one_step);
  x += size + ui.px(10);
  const double time = now.state.motion ? now.state.motion->time : 0;
  const std::string here = fmt::format("{:.3f} s", time);
  ui.text(draw, ui.fonts().small, {x, place.y, ui.px(64), place.height}, t.quiet, here);
  ui.note_control(ControlKind::reading, "Time", "Time of the simulation", "s", {x, y, ui.px(64), size});
  double last = std::max(1.0, time);
  for (const HistoryEntry& entry : *now.history) last = std::max(last, entry.stroke_end);
  for (const double when : key_times(now.state)) last = std::max(last, when);
  last = std::ceil(last * 1.25);
  const std::string end = fmt::format("{:.0f} s", last);
  const float end_width = ui.width_of(ui.fonts().small, end);
  ui.text(draw, ui.fonts().small, {place.width - ui.px(18) - end_width, place.y, end_width, place.height}, t.quiet,
          end);
  const float left = x + ui.px(70), right = place.width - ui.px(34) - end_width,
              middle = place.y + 0.5F * place.height;
  const auto at = [&](double when) {
    return left + (right - left) * static_cast<float>(std::clamp(when / last, 0.0, 1.0));
  };
  ui.box(draw, {left, middle - ui.px(2.5F), right - left, ui.px(5)}, t.outline, 2.5F);
  if (time > 0)
    ui.box(draw, {left, middle - ui.px(2.5F), std::max(ui.px(5), at(time) - left), ui.px(5)}, t.accent, 2.5F);
  for (const HistoryEntry& entry : *now.history)
    if (entry.stroke_end >= 0)
      ui.box(draw, {at(entry.stroke_end) - ui.px(1.5F), middle - ui.px(8), ui.px(3), ui.px(16)},
             entry.undone ? t.faint : t.mark, 1.5F);
  for (const double when : key_times(now.state)) {
    const ImVec2 mark{at(when), middle - ui.px(14)};
    draw.AddQuadFilled({mark.x, mark.y - ui.px(4)}, {mark.x + ui.px(4), mark.y}, {mark.x, mark.y + ui.px(4)},
                       {mark.x - ui.px(4), mark.y}, t.accent);
  }
  draw.AddCircleFilled({at(time), middle}, ui.px(6), t.accent, 24);
  ui.note_control(ControlKind::reading, "Timeline",
                  "How far time has gone; bars stand where strokes ended, diamonds at keys", "s",
                  {left, y, right - left, size});
  ui.end_panel();
}

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
  const auto end = [&](float from, const char* name, const char* tooltip, const char* unit) {
    ui.note_control(ControlKind::reading, name, tooltip, unit, {from, place.y, x - from, place.height});
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
  word(fmt::format("{:.1f} N", force), true);
  x += ui.px(8);
  const float bar = ui.px(70), height = ui.px(8), top = place.y + 0.5F * (place.height - height);
  ui.box(draw, {x, top, bar, height}, t.outline, 2);
  const double share = std::clamp(force / std::max(1e-9, std::min(desk.brush.largest_force, 1e3)), 0.0, 1.0);
  if (share > 0.02)
    ui.box(draw, {x, top, bar * static_cast<float>(share), height}, now.stroke->at_limit ? t.warning : t.accent, 2);
  x += bar;
  end(from, "Force", "What the tool applies, against its limit", "N");

  // The latest message, else what the physics is.
  const bool fresh = !now.messages.empty() && desk.time - desk.message_since < 6;
  const float room = place.width - ui.px(18) - x;
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
  while (line.size() > 3 && ui.width_of(ui.fonts().small, line) > room) {
    line.resize(line.size() - 2);
    while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0xC0U) == 0x80U) line.pop_back();
    if (!line.empty() && static_cast<unsigned char>(line.back()) >= 0x80U) line.pop_back();
    if (ui.width_of(ui.fonts().small, line + "…") <= room) {
      line += "…";
      break;
    }
  }
  const float width = ui.width_of(ui.fonts().small, line);
  const Rect said{place.width - ui.px(18) - width, place.y, width, place.height};
  ui.text(draw, ui.fonts().small, said, colour, line);
  if (!whole.empty())
    ui.note_control(ControlKind::reading, "Message",
                    line == whole ? "The latest message, or how the solid is simulated" : whole, "", said);
  ui.end_panel();
}

}  // namespace argil::studio
