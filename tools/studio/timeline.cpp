#include "tools/studio/timeline.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "tools/studio/keyed.h"

namespace argil::studio {

namespace {

constexpr const char* k_set_menu = "set a key";
constexpr const char* k_mark_menu = "what a key can";
constexpr float k_mark = 6;  // half of a mark's height

/// The stretch of the timeline that stands for time, from 0 to `last`.
struct Stretch {
  float left = 0, right = 1;
  double last = 1;  // [s]
  [[nodiscard]] float at(double time) const {
    return left + (right - left) * static_cast<float>(std::clamp(time / last, 0.0, 1.0));
  }
  /// Rounded to what a pixel can tell.
  [[nodiscard]] double time_at(float x) const {
    const double time = last * std::clamp(static_cast<double>((x - left) / (right - left)), 0.0, 1.0);
    const double step = std::pow(10.0, std::floor(std::log10(last / static_cast<double>(right - left))));
    return std::round(time / step) * step;
  }
};

double end_of_time(const Snapshot& now, double time, const std::vector<double>& keys) {
  double last = std::max(1.0, time);
  for (const HistoryEntry& entry : *now.history) last = std::max(last, entry.stroke_end);
  if (!keys.empty()) last = std::max(last, keys.back());
  return std::ceil(last * 1.25);
}

std::string seconds(double time) {
  return fmt::format("{:.4g} s", time);
}

bool has_solid(const Desk& desk) {
  return desk.now->scene && desk.now->state.loads && desk.now->state.motion;
}

void draw_mark(const Ui& ui, ImDrawList& draw, float x, float y, Ink colour, Ink rim) {
  const float size = ui.px(k_mark), outer = size + ui.px(2);
  draw.AddQuadFilled({x, y - outer}, {x + outer, y}, {x, y + outer}, {x - outer, y}, rim);
  draw.AddQuadFilled({x, y - size}, {x + size, y}, {x, y + size}, {x - size, y}, colour);
}

void draw_marks(Desk& desk, const Stretch& stretch, const std::vector<double>& keys, float y) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  KeyMark& mark = desk.key_mark;
  mark.pointed.reset();
  const ImGuiIO& io = ImGui::GetIO();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double time = keys[i];
    const float half = ui.px(8);
    const Rect place{stretch.at(time) - half, y - half, 2 * half, 2 * half};
    ImGui::SetCursorScreenPos({place.x, place.y});
    ImGui::PushID(static_cast<int>(i));
    ImGui::InvisibleButton("##mark", {place.width, place.height});
    ImGui::PopID();
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    if (hovered) mark.pointed = time;
    if (hovered || active) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActivated()) mark.dropped = false;
    if (active && !mark.dropped && ImGui::IsMouseDragging(0, ui.px(3))) {
      mark.held = time;
      mark.to = stretch.time_at(io.MousePos.x);
    }
    const bool is_held = mark.held == time;
    if (is_held && ImGui::IsItemDeactivated()) {
      mark.held.reset();
      if (std::abs(mark.to - time) > sculpt::k_same_time)
        desk.workshop->run_together(lines_to_move_keys(desk.now->state, time, mark.to));
    }
    if (hovered && ImGui::IsMouseClicked(1)) {
      mark.menu = time;
      ImGui::OpenPopup(k_mark_menu);
    }
    const float x = is_held ? stretch.at(mark.to) : stretch.at(time);
    draw_mark(ui, ui.list(), x, y, hovered || is_held ? t.text : t.accent, t.bar);
    if (is_held) {
      const std::string words = seconds(mark.to);
      const float width = ui.width_of(ui.fonts().small_strong, words) + ui.px(14);
      const Rect label{x - 0.5F * width, y - ui.px(42), width, ui.px(22)};
      ImDrawList& above = *ImGui::GetForegroundDrawList();
      ui.box(above, label, t.raised, 4);
      ui.text(above, ui.fonts().small_strong, label, t.accent, words, Side::centre);
    }
    ui.note_control(ControlKind::button, "Key at " + seconds(time),
                    words_at(desk.now->state, time) + ". Drag moves it, right click or Del removes it", "", place);
  }
}

/// A menu that opens upwards from the timeline.
Rect above_timeline(const Ui& ui, const Layout& layout, float x, std::size_t rows, float head) {
  const float width = ui.px(300), height = ui.px(28) * static_cast<float>(rows) + head + ui.px(12);
  return {std::clamp(x, ui.px(4), std::max(ui.px(4), layout.timeline.width - width - ui.px(4))),
          std::max(ui.px(4), layout.timeline.y - height - ui.px(2)), width, height};
}

void draw_mark_menu(Desk& desk, const Layout& layout, const Stretch& stretch) {
  KeyMark& mark = desk.key_mark;
  if (!mark.menu) return;
  Ui& ui = *desk.ui;
  const sculpt::State& state = desk.now->state;
  std::vector<Keyed> there;
  for (Keyed& one : keyed(state))
    if (one.track.has_key(*mark.menu)) there.push_back(std::move(one));
  const std::size_t rows = there.size() * 5 + (there.size() > 1 ? 1 : 0);
  const Rect place = above_timeline(ui, layout, stretch.at(*mark.menu), rows, 0);
  if (!ui.begin_popup(k_mark_menu, place)) {
    mark.menu.reset();
    return;
  }
  const double time = *mark.menu;
  ui.set_cursor(place.x, place.y + ui.px(6), place.width);
  const auto row = [&](const std::string& label, const std::string& right, bool marked, const std::string& help,
                       const std::vector<std::string>& lines) {
    if (!ui.list_row(label, right, marked, false, help)) return;
    desk.workshop->run_together(lines);
    ImGui::CloseCurrentPopup();
  };
  for (const Keyed& one : there) {
    if (ui.list_row("Value of " + one.name + "…", "", false, false,
                    "Shows the line that set this key, to be given other numbers")) {
      desk.open_dialogue(Dialogue::search, line_to_set_key(one, time));
      ImGui::CloseCurrentPopup();
    }
    row("Remove key of " + one.name, seconds(time), false, "Takes this key away",
        {fmt::format("key {} remove at {}", one.name, io::format_number(time))});
    for (const auto way :
         {sculpt::Interpolation::smooth, sculpt::Interpolation::linear, sculpt::Interpolation::step})
      row(std::string("    ") + sculpt::word(way), "between its keys", one.track.interpolation == way,
          "How it goes from key to key", {fmt::format("key {} interpolation {}", one.name, sculpt::word(way))});
  }
  if (there.size() > 1)
    row("Remove all keys here", seconds(time), false, "Takes the keys of this time away",
        lines_to_remove_keys(state, time));
  ui.end_popup();
}

void draw_set_menu(Desk& desk, const Layout& layout, float x) {
  Ui& ui = *desk.ui;
  if (std::exchange(desk.key_mark.wants_key_menu, false)) ImGui::OpenPopup(k_set_menu);
  if (!ImGui::IsPopupOpen(k_set_menu) || !has_solid(desk)) return;
  const auto choices = keyable(desk.now->state);
  const float head = ui.px(26);
  const Rect place = above_timeline(ui, layout, x, choices.size(), head);
  if (!ui.begin_popup(k_set_menu, place)) return;
  ui.text(ui.list(), ui.fonts().small_strong, {place.x + ui.px(28), place.y + ui.px(4), place.width, head},
          ui.tokens().faint, "Set a key at " + seconds(desk.now->state.motion->time) + " of");
  ui.set_cursor(place.x, place.y + head + ui.px(6), place.width);
  for (const Keyable& one : choices)
    if (ui.list_row(one.label, "", false, false, one.help)) {
      desk.workshop->run_together(one.lines);
      ImGui::CloseCurrentPopup();
    }
  ui.end_popup();
}

}  // namespace

bool perform_on_timeline(Desk& desk, Action action) {
  KeyMark& mark = desk.key_mark;
  switch (action) {
    case Action::cancel:
      if (!mark.held) return false;
      mark.held.reset();
      mark.dropped = true;
      return true;
    case Action::edit_remove:
      if (!mark.pointed || mark.held) return false;
      desk.workshop->run_together(lines_to_remove_keys(desk.now->state, *mark.pointed));
      return true;
    case Action::set_key:
      if (has_solid(desk))
        mark.wants_key_menu = true;
      else
        desk.workshop->post(
            [](Bench& bench) { bench.say(MessageKind::note, "a key needs a solid; begin with a block"); });
      return true;
    default:
      return false;
  }
}

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
  x += size + ui.px(2);
  if (ui.icon_button("Set a key", {x, y, size, size}, icons::key, false, desk.tooltip(Action::set_key)))
    perform(Action::set_key);
  draw_set_menu(desk, layout, x);
  x += size + ui.px(10);
  const double time = now.state.motion ? now.state.motion->time : 0;
  ui.text(draw, ui.fonts().small, {x, place.y, ui.px(64), place.height}, t.quiet, fmt::format("{:.3f} s", time));
  ui.note_control(ControlKind::reading, "Time", "Time of the simulation", "s", {x, y, ui.px(64), size});

  const std::vector<double> keys = has_solid(desk) ? key_times(now.state) : std::vector<double>{};
  Stretch stretch;
  stretch.last = end_of_time(now, time, keys);
  const std::string end = fmt::format("{:.0f} s", stretch.last);
  const float end_width = ui.width_of(ui.fonts().small, end), middle = place.y + 0.5F * place.height;
  stretch.left = x + ui.px(70);
  stretch.right = place.width - ui.px(34) - end_width;
  ui.text(draw, ui.fonts().small, {place.width - ui.px(18) - end_width, place.y, end_width, place.height}, t.quiet,
          end);
  ui.note_control(ControlKind::reading, "Timeline",
                  "How far time has gone; bars stand where strokes ended, diamonds at keys", "s",
                  {stretch.left, y, stretch.right - stretch.left, size});
  const auto bar = [&](double to, Ink colour) {
    ui.box(draw, {stretch.left, middle - ui.px(2.5F), std::max(ui.px(5), stretch.at(to) - stretch.left), ui.px(5)},
           colour, 2.5F);
  };
  bar(stretch.last, t.outline);
  if (time > 0) bar(time, t.accent);
  for (const HistoryEntry& entry : *now.history)
    if (entry.stroke_end >= 0)
      ui.box(draw, {stretch.at(entry.stroke_end) - ui.px(1.5F), middle - ui.px(8), ui.px(3), ui.px(16)},
             entry.undone ? t.faint : t.mark, 1.5F);
  draw.AddCircleFilled({stretch.at(time), middle}, ui.px(6), t.accent, 24);
  draw_marks(desk, stretch, keys, middle - ui.px(15));
  draw_mark_menu(desk, layout, stretch);
  ui.set_cursor(place.x, place.y, place.width);
  ui.end_panel();
}

}  // namespace argil::studio
