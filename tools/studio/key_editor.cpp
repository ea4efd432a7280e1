#include "tools/studio/key_editor.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "tools/studio/sheet.h"

namespace argil::studio {

namespace {

bool is_modifier(int pressed) {
  return pressed >= key::left_shift && pressed <= key::right_alt;
}

void keep(const Desk& desk) {
  desk.workshop->post([lines = desk.bindings.changes()](Bench& bench) { bench.write_keys(lines); });
}

std::string label_of(const ActionInfo& action) {
  const std::size_t tool = static_cast<std::size_t>(action.action) - static_cast<std::size_t>(Action::tool_1);
  const bool is_tool = action.action >= Action::tool_1 && action.action <= Action::tool_9;
  return is_tool && tool < shelf_tools().size() ? shelf_tools()[tool].label : action.label;
}

}  // namespace

bool edit_key(Desk& desk, const Chord& chord) {
  if (desk.dialogue != Dialogue::keys || !desk.rebinds) return false;
  if (is_modifier(chord.key)) return true;
  const Action action = *desk.rebinds;
  desk.rebinds.reset();
  desk.key_note.clear();
  if (chord == Chord{key::escape}) return true;
  const Chord wanted = chord == Chord{key::del} ? Chord{} : chord;
  if (const auto loser = desk.bindings.bind(action, wanted))
    desk.key_note = fmt::format("{} has no key now", label_of(info(*loser)));
  keep(desk);
  return true;
}

void draw_key_editor(Desk& desk, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  if (desk.dialogue != desk.shown_dialogue) {
    desk.rebinds.reset();
    desk.key_note.clear();
  }
  const float column = ui.px(276), margin = ui.px(20);
  const auto columns = static_cast<std::size_t>(
      std::clamp((static_cast<float>(width) - 2 * margin - ui.px(24)) / column, 1.0F, 4.0F));
  const std::size_t gesture_rows = (gestures().size() + 1) / 2;
  const std::size_t rows = (k_action_count + columns - 1) / columns;
  const float head = ui.px(48), foot = ui.px(52), row = ui.px(20);
  const float wide = column * static_cast<float>(columns) + 2 * margin;
  const float gestures_height = row * static_cast<float>(gesture_rows) + ui.px(14);
  const float list = gestures_height + row * static_cast<float>(rows);
  const float high = std::min(head + list + foot, static_cast<float>(height) - ui.px(40));
  const Rect place{0.5F * (static_cast<float>(width) - wide), 0.5F * (static_cast<float>(height) - high), wide,
                   high};
  open_sheet(desk, "keys", place, width, height);
  const Rect title{place.x + margin, place.y + ui.px(8), wide - 2 * margin, ui.px(34)};
  ui.text(ui.list(), ui.fonts().strong, title, t.text, "Keys and gestures");
  const std::string note = desk.rebinds ? fmt::format("Press a key for {}; Del takes it away, Esc leaves it",
                                                      label_of(info(*desk.rebinds)))
                           : desk.key_note.empty() ? "Click a line, then press its new key"
                                                   : desk.key_note;
  ui.text(ui.list(), ui.fonts().small, title, desk.rebinds ? t.accent : t.faint, note, Side::right);
  // What has no room is scrolled to.
  const Rect body{place.x, place.y + head, wide, high - head - foot};
  ImGui::SetCursorScreenPos({body.x, body.y});
  ImGui::BeginChild("list", {body.width, body.height}, false, ImGuiWindowFlags_NoBackground);
  ImDrawList& draw = ui.list();
  const float top = body.y - ImGui::GetScrollY();
  const auto shows = [&](const Rect& line) { return line.bottom() > body.y && line.y < body.bottom(); };
  for (std::size_t i = 0; i < gestures().size(); ++i) {
    const float x = place.x + margin + 0.5F * (wide - 2 * margin) * static_cast<float>(i / gesture_rows),
                y = top + row * static_cast<float>(i % gesture_rows), room = 0.5F * (wide - 2 * margin) - ui.px(8);
    const float named = std::min(ui.px(170), 0.5F * room);
    ui.text(draw, ui.fonts().small_strong, {x, y, named, row}, t.accent,
            ui.fitted(ui.fonts().small_strong, gestures()[i].gesture, named - ui.px(8)));
    const Rect said{x + named, y, room - named, row};
    ui.text(draw, ui.fonts().small, said, t.text, ui.fitted(ui.fonts().small, gestures()[i].help, said.width));
    if (shows(said))
      ui.note_control(ControlKind::reading, gestures()[i].gesture,
                      std::string(gestures()[i].gesture) + ": " + gestures()[i].help, "", {x, y, room, row});
  }
  for (std::size_t i = 0; i < k_action_count; ++i) {
    const ActionInfo& action = action_table()[i];
    const Rect line{place.x + margin + column * static_cast<float>(i / rows),
                    top + gestures_height + row * static_cast<float>(i % rows), column - ui.px(8), row};
    ImGui::SetCursorScreenPos({line.x, line.y});
    ImGui::PushID(static_cast<int>(i));
    const bool pressed = ImGui::InvisibleButton("##key", {line.width, line.height});
    const bool hovered = ImGui::IsItemHovered();
    ImGui::PopID();
    const bool waits = desk.rebinds == action.action;
    if (hovered || waits)
      ui.box(draw, {line.x - ui.px(6), line.y, line.width, line.height}, waits ? faded(t.accent, 0.25F) : t.well,
             4);
    const std::string keys = waits ? std::string("…") : desk.bindings.word_of(action.action);
    ui.text(draw, ui.fonts().small_strong, {line.x, line.y, ui.px(112), row}, keys.empty() ? t.faint : t.accent,
            keys.empty() ? "–" : keys);
    ui.text(draw, ui.fonts().small, {line.x + ui.px(112), line.y, line.width, row}, t.text, label_of(action));
    if (shows(line))
      ui.note_control(ControlKind::button, fmt::format("Key of {}", action.word), action.help, "", line);
    if (pressed) {
      desk.rebinds = action.action;
      desk.key_note.clear();
    }
  }
  ImGui::SetCursorScreenPos({body.x, top + list});
  ImGui::Dummy({1, 1});
  ImGui::EndChild();
  float x = place.x + margin;
  for (const KeyPreset& preset : key_presets()) {
    const float button = ui.px(150);
    if (ui.text_button(preset.name, {x, place.bottom() - ui.px(42), button, ui.px(30)}, preset.name, false,
                       preset.help)) {
      desk.bindings = Bindings();
      desk.bindings.read(preset.lines, preset.name);
      desk.rebinds.reset();
      desk.key_note = fmt::format("These are {} now", preset.name);
      keep(desk);
    }
    x += button + ui.px(8);
  }
  ui.end_panel();
}

}  // namespace argil::studio
