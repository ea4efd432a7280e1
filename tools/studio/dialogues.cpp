#include "tools/studio/dialogues.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "tools/studio/search.h"

namespace argil::studio {

namespace {

constexpr std::size_t k_shown = 9;

Rect open_sheet(Desk& desk, const char* name, const Rect& place, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  ui.come_to_front();
  // What lies behind is dimmed, and takes no clicks: one beside the sheet closes it.
  ui.begin_panel("behind", {0, 0, static_cast<float>(width), static_cast<float>(height)}, t.shade, 0);
  ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  ImGui::SetCursorScreenPos({0, 0});
  if (ImGui::InvisibleButton("##behind", {static_cast<float>(width), static_cast<float>(height)}) &&
      desk.dialogue == desk.shown_dialogue)
    desk.dialogue = Dialogue::none;
  ui.end_panel();
  ui.begin_panel(name, place, 0, 0);
  ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  ImDrawList& draw = ui.list();
  draw.PushClipRectFullScreen();
  ui.shadow(draw, place, 8);
  draw.PopClipRect();
  ui.box(draw, place, t.raised, 8);
  ui.frame(draw, place, t.outline, 8);
  return place;
}

void take(Desk& desk, const Found& found, const Perform& perform) {
  if (found.action != nullptr) {
    desk.dialogue = Dialogue::none;
    perform(found.action->action);
    return;
  }
  const std::string& name = found.command->name;
  const bool begun = desk.typed == name || desk.typed.starts_with(name + ' ');
  if (begun ? can_run(desk.typed) : runs_alone(*found.command) && found.command->parameters.empty()) {
    desk.run(begun ? desk.typed : name);
    desk.dialogue = Dialogue::none;
  } else if (!begun) {
    desk.typed = name + ' ';
    desk.retake_focus = true;
  }
}

void draw_search(Desk& desk, const Layout& layout, const Perform& perform, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const auto found = search(desk.typed);
  desk.chosen = std::min(desk.chosen, found.empty() ? 0 : found.size() - 1);
  const std::size_t rows = std::min(found.size(), k_shown);
  const float wide = ui.px(600), field = ui.px(48), row = ui.px(28), foot = ui.px(74);
  const Rect place{0.5F * (static_cast<float>(width) - wide), layout.menu.bottom() + ui.px(40), wide,
                   field + row * static_cast<float>(std::max<std::size_t>(rows, 1)) + foot};
  open_sheet(desk, "search", place, width, height);
  ImDrawList& draw = ui.list();
  ui.icon(draw, {place.x + ui.px(8), place.y, ui.px(36), field}, t.quiet, icons::search, true);
  bool entered = false;
  const bool focus = desk.dialogue != desk.shown_dialogue || std::exchange(desk.retake_focus, false);
  if (ui.text_field("Command", {place.x + ui.px(40), place.y, wide - ui.px(56), field}, desk.typed,
                    "Name or meaning of a command; with its arguments it runs", focus, entered,
                    "Type to search; Enter runs, Up and Down choose"))
    desk.chosen = 0;
  draw.AddRectFilled({place.x, place.y + field - ui.px(1)}, {place.right(), place.y + field}, t.outline);
  ui.set_cursor(place.x + ui.px(6), place.y + field + ui.px(4), wide - ui.px(12));
  const std::size_t first = desk.chosen >= k_shown ? desk.chosen - k_shown + 1 : 0;
  if (found.empty()) {
    ui.set_cursor(place.x + ui.px(34), place.y + field + ui.px(10), wide);
    ui.note("Nothing is called that, and nothing does it. Try a shorter word.");
  }
  for (std::size_t i = first; i < std::min(found.size(), first + k_shown); ++i) {
    const Found& one = found[i];
    const std::string name = one.action != nullptr ? one.action->label : one.command->name;
    const std::string right =
        one.action != nullptr ? desk.bindings.word_of(one.action->action) : one.command->group;
    if (ui.list_row(name, right, false, i == desk.chosen,
                    one.action != nullptr ? one.action->help : one.command->summary))
      take(desk, one, perform);
  }
  if (entered && !found.empty()) {
    take(desk, found[desk.chosen], perform);
    if (desk.dialogue == Dialogue::search) desk.retake_focus = true;
  }
  // What it does, how it is written, and what is wrong with the line so far.
  if (!found.empty()) {
    const Found& one = found[std::min(desk.chosen, found.size() - 1)];
    const float y = place.bottom() - foot + ui.px(8);
    draw.AddRectFilled({place.x, y - ui.px(1)}, {place.right(), y}, t.outline);
    const Rect line{place.x + ui.px(16), y + ui.px(8), wide - ui.px(32), ui.px(20)};
    draw.PushClipRect({line.x, y}, {line.right(), place.bottom()}, true);
    ui.text(draw, ui.fonts().small, line, t.text, one.action != nullptr ? one.action->help : one.command->summary);
    std::string below;
    Ink colour = t.quiet;
    if (one.command != nullptr) {
      below = sculpt::usage(*one.command);
      const bool begun =
          desk.typed.starts_with(one.command->name + ' ') && desk.typed.size() > one.command->name.size() + 1;
      if (const std::string fault = begun ? fault_of(desk.typed) : ""; !fault.empty()) {
        below = fault;
        colour = t.warning;
      } else if (begun) {
        below = "Enter runs:  " + desk.typed;
        colour = t.good;
      }
    }
    ui.text(draw, ui.fonts().small, {line.x, line.bottom() + ui.px(4), line.width, ui.px(20)}, colour, below);
    draw.PopClipRect();
  }
  ui.end_panel();
}

void draw_keys(Desk& desk, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  std::vector<std::array<std::string, 2>> lines;
  for (const Gesture& gesture : gestures()) lines.push_back({gesture.gesture, gesture.help});
  std::size_t tools = 0;
  for (const ActionInfo& action : action_table()) {
    if (desk.bindings.word_of(action.action).empty()) continue;
    if (action.action >= Action::tool_1 && action.action <= Action::tool_9) {
      if (tools < shelf_tools().size())
        lines.push_back({desk.bindings.word_of(action.action), shelf_tools()[tools].label});
      ++tools;
    } else {
      lines.push_back({desk.bindings.word_of(action.action), action.label});
    }
  }
  const std::size_t gesture_count = gestures().size(), keys = lines.size() - gesture_count;
  const float row = ui.px(22), head = ui.px(54);
  // As many columns as it takes to fit the window, as far as there is room for them.
  const float gestures_height = row * static_cast<float>(gesture_count) + ui.px(14);
  const float room = static_cast<float>(height) - ui.px(60) - head - gestures_height - ui.px(20);
  const auto rows = static_cast<std::size_t>(std::max(1.0F, room / row));
  const auto most = static_cast<std::size_t>(std::max(1.0F, (static_cast<float>(width) - ui.px(60)) / ui.px(200)));
  const std::size_t columns = std::clamp<std::size_t>((keys + rows - 1) / rows, 3, std::max<std::size_t>(3, most));
  const std::size_t per_column = (keys + columns - 1) / columns;
  const float column = std::min(ui.px(250), (static_cast<float>(width) - ui.px(60)) / static_cast<float>(columns));
  const float wide = column * static_cast<float>(columns) + ui.px(40);
  const float high = head + gestures_height + row * static_cast<float>(per_column) + ui.px(20);
  const Rect place{0.5F * (static_cast<float>(width) - wide),
                   std::max(ui.px(40), 0.5F * (static_cast<float>(height) - high)), wide, high};
  open_sheet(desk, "keys", place, width, height);
  ImDrawList& draw = ui.list();
  ui.text(draw, ui.fonts().strong, {place.x + ui.px(20), place.y + ui.px(10), wide, ui.px(34)}, t.text,
          "Keys and gestures");
  ui.text(draw, ui.fonts().small, {place.x, place.y + ui.px(10), wide - ui.px(20), ui.px(34)}, t.faint,
          "yours are read from argil/keys in the folder of settings", Side::right);
  const auto put = [&](const std::array<std::string, 2>& line, float x, float y, float key_width) {
    ui.text(draw, ui.fonts().small_strong, {x, y, key_width, row}, t.accent, line[0]);
    ui.text(draw, ui.fonts().small, {x + key_width, y, column, row}, t.text, line[1]);
  };
  for (std::size_t i = 0; i < gesture_count; ++i)
    put(lines[i], place.x + ui.px(20), place.y + head + row * static_cast<float>(i), ui.px(170));
  for (std::size_t i = 0; i < keys; ++i)
    put(lines[gesture_count + i], place.x + ui.px(20) + column * static_cast<float>(i / per_column),
        place.y + head + gestures_height + row * static_cast<float>(i % per_column), ui.px(96));
  ui.end_panel();
}

void draw_file(Desk& desk, bool saves, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  // Files that can be opened, beneath what is typed.
  const std::filesystem::path typed(desk.typed);
  const std::filesystem::path folder = desk.typed.empty()                     ? "."
                                       : std::filesystem::is_directory(typed) ? typed
                                       : typed.has_parent_path()              ? typed.parent_path()
                                                                              : ".";
  std::vector<std::string> names;
  if (!saves) {
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
      const std::string name = entry.path().filename().string();
      const std::string start = std::filesystem::is_directory(typed) ? "" : typed.filename().string();
      const auto ending = entry.path().extension();
      const bool fits = entry.is_directory(failure) || ending == ".argil" || ending == ".vtk" || ending == ".vtu" ||
                        ending == ".mesh" || ending == ".msh" || ending == ".inp" || ending == ".ovm";
      if (fits && !name.starts_with('.') && (start.empty() || name.starts_with(start)))
        names.push_back(entry.is_directory(failure) ? name + "/" : name);
    }
    std::sort(names.begin(), names.end());
    if (names.size() > 10) names.resize(10);
  }
  const float wide = ui.px(560), field = ui.px(48), row = ui.px(28);
  const float high = ui.px(44) + field + row * static_cast<float>(names.size()) + ui.px(62);
  const Rect place{0.5F * (static_cast<float>(width) - wide), ui.px(90), wide, high};
  open_sheet(desk, "file", place, width, height);
  ImDrawList& draw = ui.list();
  ui.text(draw, ui.fonts().strong, {place.x + ui.px(20), place.y + ui.px(10), wide, ui.px(28)}, t.text,
          saves ? "Save the session" : "Open a session or a mesh");
  const Rect box{place.x + ui.px(16), place.y + ui.px(46), wide - ui.px(32), ui.px(36)};
  ui.box(draw, box, t.well);
  ui.frame(draw, box, t.accent);
  bool entered = false;
  const bool focus = desk.dialogue != desk.shown_dialogue || std::exchange(desk.retake_focus, false);
  ui.text_field("File", {box.x + ui.px(4), box.y, box.width - ui.px(8), box.height}, desk.typed,
                saves ? "name.argil" : "a folder, .argil, or a volume mesh", focus, entered,
                saves ? "Where the session is written" : "What is opened");
  ui.set_cursor(place.x + ui.px(16), box.bottom() + ui.px(6), wide - ui.px(32));
  for (const std::string& name : names)
    if (ui.list_row(name, "", false, false, "Takes this file")) {
      desk.typed = (folder == "." ? std::filesystem::path(name) : folder / name).string();
      desk.retake_focus = true;
    }
  const float y = place.bottom() - ui.px(48);
  const bool done =
      ui.text_button(saves ? "Save now" : "Open now", {place.right() - ui.px(116), y, ui.px(100), ui.px(32)},
                     saves ? "Save" : "Open", true, saves ? "Writes the session" : "Opens the file");
  if (ui.text_button("Leave", {place.right() - ui.px(224), y, ui.px(100), ui.px(32)}, "Cancel", false,
                     "Leaves all as it is"))
    desk.dialogue = Dialogue::none;
  if ((done || entered) && !desk.typed.empty()) {
    std::filesystem::path file(desk.typed);
    if (saves && file.extension() != ".argil") file += ".argil";
    desk.dialogue = Dialogue::none;
    desk.folder = file.has_parent_path() ? file.parent_path() : ".";
    desk.workshop->post([file, saves](Bench& bench) { saves ? bench.save(file) : bench.open(file); });
  }
  ui.end_panel();
}

}  // namespace

bool search_key(Desk& desk, int pressed, const Perform&) {
  if (desk.dialogue != Dialogue::search) return false;
  if (pressed == key::down) ++desk.chosen;
  if (pressed == key::up && desk.chosen > 0) --desk.chosen;
  return pressed == key::down || pressed == key::up;
}

void draw_dialogues(Desk& desk, const Layout& layout, const Perform& perform, int width, int height) {
  const Dialogue which = desk.dialogue;
  switch (which) {
    case Dialogue::none:
      break;
    case Dialogue::search:
      draw_search(desk, layout, perform, width, height);
      break;
    case Dialogue::keys:
      draw_keys(desk, width, height);
      break;
    case Dialogue::open:
    case Dialogue::save:
      draw_file(desk, which == Dialogue::save, width, height);
      break;
  }
  desk.shown_dialogue = which;
}

}  // namespace argil::studio
