// Of chrome.h: the menus, made from the tables of actions and commands.

#include <imgui.h>

#include <algorithm>
#include <cstring>

#include "sculpt/command.h"
#include "tools/studio/chrome.h"
#include "tools/studio/search.h"

namespace argil::studio {

namespace {

void draw_actions(Desk& desk, const Menu& menu, const Perform& perform) {
  const Settings& s = desk.settings;
  for (const ActionInfo& action : action_table()) {
    if (std::strcmp(action.menu, menu.name) != 0) continue;
    const std::size_t number = static_cast<std::size_t>(action.action) - static_cast<std::size_t>(Action::tool_1);
    const bool is_tool = action.action >= Action::tool_1 && action.action <= Action::tool_9;
    if (is_tool && number >= shelf_tools().size()) continue;
    using enum Action;
    const bool marked = (action.action == symmetry && desk.brush.symmetry != 0) ||
                        (action.action == keep_shape && s.keep_shape) ||
                        (action.action == wireframe && s.wireframe) || (action.action == cage && s.cage) ||
                        (action.action == cut_away && s.cut) || (action.action == theme && s.light) ||
                        (action.action == panels && s.panels) || (action.action == peel && s.peel > 0) ||
                        (action.action == select_next_type && s.choosing) || (is_tool && number == s.tool);
    const bool enabled = action.action == undo   ? desk.now->undo_depth > 0
                         : action.action == redo ? desk.now->redo_depth > 0
                                                 : true;
    const std::string label = is_tool ? shelf_tools()[number].label : action.label;
    if (desk.ui->list_row(label, desk.bindings.word_of(action.action), marked, false,
                          is_tool ? shelf_tools()[number].help : action.help, enabled)) {
      perform(action.action);
      ImGui::CloseCurrentPopup();
    }
  }
}

void draw_commands(Desk& desk, const char* group) {
  for (const sculpt::Command& command : sculpt::command_table()) {
    if (command.group != group) continue;
    const bool alone = runs_alone(command) && command.parameters.empty();
    if (desk.ui->list_row(command.name, alone ? "" : "…", false, false, command.summary)) {
      if (alone)
        desk.run(command.name);
      else
        desk.open_dialogue(Dialogue::search, command.name + ' ');
      ImGui::CloseCurrentPopup();
    }
  }
}

void draw_menu_popup(Desk& desk, const Menu& menu, float x, float y, const Perform& perform) {
  Ui& ui = *desk.ui;
  const float row = ui.px(28), head = ui.px(28), column = ui.px(226), pad = ui.px(6);
  // Actions and groups are spread over columns of about the same height.
  std::size_t actions = 0;
  for (const ActionInfo& action : action_table()) {
    const std::size_t number = static_cast<std::size_t>(action.action) - static_cast<std::size_t>(Action::tool_1);
    const bool beyond =
        action.action >= Action::tool_1 && action.action <= Action::tool_9 && number >= shelf_tools().size();
    if (std::strcmp(action.menu, menu.name) == 0 && !beyond) ++actions;
  }
  struct Part {
    const char* group;  // null: the actions
    float height;
    std::size_t column = 0;
  };
  std::vector<Part> parts;
  if (actions > 0) parts.push_back({nullptr, row * static_cast<float>(actions)});
  for (const char* group : menu.groups) {
    const auto count = std::count_if(sculpt::command_table().begin(), sculpt::command_table().end(),
                                     [&](const sculpt::Command& command) { return command.group == group; });
    parts.push_back({group, head + row * static_cast<float>(count)});
  }
  std::size_t columns = 0;
  float filled = 0, tallest = 0;
  const float most = ui.px(430);
  for (Part& part : parts) {
    if (filled > 0 && filled + part.height > most) {
      ++columns;
      filled = 0;
    }
    part.column = columns;
    filled += part.height;
    tallest = std::max(tallest, filled);
  }
  const float width = column * static_cast<float>(columns + 1) + 2 * pad, height = tallest + 2 * pad;
  if (!ui.begin_popup(menu.name, {x, y, width, height})) return;
  float at = y + pad;
  std::size_t now = 0;
  for (const Part& part : parts) {
    if (part.column != now) at = y + pad;
    now = part.column;
    const float left = x + pad + column * static_cast<float>(part.column);
    ui.set_cursor(left, at, column);
    if (part.group != nullptr) {
      ui.text(ui.list(), ui.fonts().small_strong, {left + ui.px(12), at, column, head}, ui.tokens().faint,
              part.group);
      ui.set_cursor(left, at + head, column);
      draw_commands(desk, part.group);
    } else {
      draw_actions(desk, menu, perform);
    }
    at += part.height;
  }
  ui.end_popup();
}

}  // namespace

void draw_menu(Desk& desk, const Layout& layout, const Perform& perform) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  ui.begin_panel("menu", layout.menu, t.bar, 0);
  ImDrawList& draw = ui.list();
  float x = ui.px(16);
  ui.text(draw, ui.fonts().strong, {x, 0, ui.px(60), layout.menu.height}, t.text, "Argil");
  x += ui.width_of(ui.fonts().strong, "Argil") + ui.px(12);
  for (const Menu& menu : menus()) {
    const float width = ui.width_of(ui.fonts().text, menu.name) + ui.px(18);
    const Rect place{x, ui.px(4), width, layout.menu.height - ui.px(8)};
    const bool is_open = ImGui::IsPopupOpen(menu.name);
    ImGui::SetCursorScreenPos({place.x, place.y});
    ImGui::PushID(menu.name);
    const bool pressed = ImGui::InvisibleButton("##menu", {place.width, place.height});
    const bool hovered = ImGui::IsMouseHoveringRect({place.x, place.y}, {place.right(), place.bottom()}, false);
    ImGui::PopID();
    ui.note_control(ControlKind::button, menu.name, menu.help, "", place);
    bool another = false;
    for (const Menu& other : menus()) another = another || (&other != &menu && ImGui::IsPopupOpen(other.name));
    // With one menu open the pointer goes from one to the next.
    if (pressed || (another && hovered)) ImGui::OpenPopup(menu.name);
    if (hovered || is_open) ui.box(draw, place, faded(t.outline, 0.7F), 4);
    ui.text(draw, ui.fonts().text, place, hovered || is_open ? t.text : t.quiet, menu.name, Side::centre);
    draw_menu_popup(desk, menu, place.x, layout.menu.bottom() + ui.px(2), perform);
    x += width;
  }

  // At the right: search, and whether what was done is saved.
  const std::string name =
      desk.now->file.empty() ? "untitled" : std::filesystem::path(desk.now->file).filename().string();
  float right = layout.menu.width - ui.px(16);
  const float name_width = ui.width_of(ui.fonts().small, name);
  const Rect named{right - name_width, 0, name_width, layout.menu.height};
  ui.text(draw, ui.fonts().small, named, t.quiet, name);
  const float dot = named.x - ui.px(14);
  draw.AddCircleFilled({dot, 0.5F * layout.menu.height}, ui.px(4), desk.now->saved ? t.good : t.accent, 20);
  ui.note_control(ControlKind::reading, "Session",
                  desk.now->saved ? "All is saved" : "Not saved yet; the journal holds it", "",
                  {dot - ui.px(8), 0, right - dot + ui.px(8), layout.menu.height});
  const Rect box{dot - ui.px(24) - ui.px(250), ui.px(5), ui.px(250), layout.menu.height - ui.px(10)};
  ImGui::SetCursorScreenPos({box.x, box.y});
  const bool searched = ImGui::InvisibleButton("##search", {box.width, box.height});
  ui.box(draw, box, ImGui::IsItemHovered() ? t.well_hovered : t.well);
  ui.text(draw, ui.fonts().small, {box.x + ui.px(12), box.y, box.width, box.height}, t.faint,
          "Search commands  ·  " + desk.bindings.word_of(Action::search));
  ui.note_control(ControlKind::button, "Search", desk.tooltip(Action::search), "", box);
  if (searched) perform(Action::search);
  ui.end_panel();
}

}  // namespace argil::studio
