// Of chrome.h: the menus, made from the tables of actions and commands.

#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "sculpt/command.h"
#include "tools/studio/chrome.h"
#include "tools/studio/search.h"

namespace argil::studio {

namespace {

/// A line of a menu: an action, a command, or the head of a group of commands.
struct MenuLine {
  const ActionInfo* action = nullptr;
  const sculpt::Command* command = nullptr;
  const char* head = nullptr;
  std::size_t part = 0;  // the actions, then each group
};

std::optional<std::size_t> tool_of(Action action) {
  if (action < Action::tool_1 || action > Action::tool_9) return std::nullopt;
  return static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::tool_1);
}

std::vector<MenuLine> lines_of(const Menu& menu) {
  std::vector<MenuLine> lines;
  for (const ActionInfo& action : action_table())
    if (std::strcmp(action.menu, menu.name) == 0 && tool_of(action.action).value_or(0) < shelf_tools().size())
      lines.push_back({.action = &action});
  std::size_t part = 0;
  for (const char* group : menu.groups) {
    lines.push_back({.head = group, .part = ++part});
    for (const sculpt::Command& command : sculpt::command_table())
      if (command.group == group) lines.push_back({.command = &command, .part = part});
  }
  return lines;
}

/// The column of each line. Parts stay whole in columns of about the same height, but for one that is higher than
/// the window.
std::vector<std::size_t> columns_of(const std::vector<MenuLine>& lines, std::size_t usual, std::size_t most) {
  std::vector<std::size_t> columns;
  std::size_t column = 0, filled = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool begins = i == 0 || lines[i].part != lines[i - 1].part;
    std::size_t size = 0;
    while (begins && i + size < lines.size() && lines[i + size].part == lines[i].part) ++size;
    if (filled > 0 && ((begins && filled + size > std::min(usual, most)) || filled == most)) {
      ++column;
      filled = 0;
    }
    columns.push_back(column);
    ++filled;
  }
  return columns;
}

bool is_marked(const Desk& desk, Action action) {
  const Settings& s = desk.settings;
  switch (action) {
    case Action::symmetry:
      return desk.brush.symmetry != 0;
    case Action::keep_shape:
      return s.keep_shape;
    case Action::wireframe:
      return s.wireframe;
    case Action::cage:
      return s.cage;
    case Action::cut_away:
      return s.cut;
    case Action::theme:
      return s.light;
    case Action::panels:
      return s.panels;
    case Action::peel:
      return s.peel > 0;
    case Action::select_next_type:
      return s.choosing.has_value();
    default:
      return tool_of(action) == s.tool;
  }
}

void draw_action(Desk& desk, const ActionInfo& action, const Perform& perform) {
  const bool enabled = action.action == Action::undo   ? desk.now->undo_depth > 0
                       : action.action == Action::redo ? desk.now->redo_depth > 0
                                                       : true;
  const auto tool = tool_of(action.action);
  if (desk.ui->list_row(tool ? shelf_tools()[*tool].label : action.label, desk.bindings.word_of(action.action),
                        is_marked(desk, action.action), false, tool ? shelf_tools()[*tool].help : action.help,
                        enabled)) {
    perform(action.action);
    ImGui::CloseCurrentPopup();
  }
}

void draw_command(Desk& desk, const sculpt::Command& command) {
  const bool alone = runs_alone(command) && command.parameters.empty();
  if (!desk.ui->list_row(command.name, alone ? "" : "…", false, false, command.summary)) return;
  if (alone)
    desk.run(command.name);
  else
    desk.open_dialogue(Dialogue::search, command.name + ' ');
  ImGui::CloseCurrentPopup();
}

void draw_menu_popup(Desk& desk, const Menu& menu, float x, float y, const Perform& perform) {
  if (!ImGui::IsPopupOpen(menu.name)) return;
  Ui& ui = *desk.ui;
  const float row = ui.px(28), pad = ui.px(6);
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const auto lines = lines_of(menu);
  const auto most = static_cast<std::size_t>(std::max(1.0F, (window.y - y - 2 * pad - ui.px(4)) / row));
  const auto columns = columns_of(lines, 15, most);
  std::size_t tallest = 0;
  for (std::size_t column = 0; column <= columns.back(); ++column)
    tallest = std::max(tallest, static_cast<std::size_t>(std::count(columns.begin(), columns.end(), column)));
  const auto count = static_cast<float>(columns.back() + 1);
  const float column = std::min(ui.px(226), (window.x - 2 * pad - ui.px(8)) / count);
  const float width = column * count + 2 * pad, height = row * static_cast<float>(tallest) + 2 * pad;
  x = std::clamp(x, ui.px(4), std::max(ui.px(4), window.x - width - ui.px(4)));
  if (!ui.begin_popup(menu.name, {x, y, width, height})) return;
  std::size_t filled = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0 && columns[i] != columns[i - 1]) filled = 0;
    const float left = x + pad + column * static_cast<float>(columns[i]),
                at = y + pad + row * static_cast<float>(filled++);
    ui.set_cursor(left, at, column);
    if (lines[i].head != nullptr)
      ui.text(ui.list(), ui.fonts().small_strong, {left + ui.px(12), at, column, row}, ui.tokens().faint,
              lines[i].head);
    else if (lines[i].command != nullptr)
      draw_command(desk, *lines[i].command);
    else
      draw_action(desk, *lines[i].action, perform);
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
  const std::string title = ui.fitted(ui.fonts().small, name, std::max(ui.px(60), right - x - ui.px(180)));
  const float name_width = ui.width_of(ui.fonts().small, title);
  const Rect named{right - name_width, 0, name_width, layout.menu.height};
  ui.text(draw, ui.fonts().small, named, t.quiet, title);
  const float dot = named.x - ui.px(14);
  draw.AddCircleFilled({dot, 0.5F * layout.menu.height}, ui.px(4), desk.now->saved ? t.good : t.accent, 20);
  ui.note_control(ControlKind::reading, "Session",
                  (desk.now->file.empty() ? "" : desk.now->file + ". ") +
                      (desk.now->saved ? "All is saved" : "Not saved yet; the journal holds it"),
                  "", {dot - ui.px(8), 0, right - dot + ui.px(8), layout.menu.height});
  const float search_width = std::clamp(dot - ui.px(36) - x, ui.px(60), ui.px(250));
  const Rect box{dot - ui.px(24) - search_width, ui.px(5), search_width, layout.menu.height - ui.px(10)};
  ImGui::SetCursorScreenPos({box.x, box.y});
  const bool searched = ImGui::InvisibleButton("##search", {box.width, box.height});
  ui.box(draw, box, ImGui::IsItemHovered() ? t.well_hovered : t.well);
  ui.text(draw, ui.fonts().small, {box.x + ui.px(12), box.y, box.width, box.height}, t.faint,
          ui.fitted(ui.fonts().small, "Search commands  ·  " + desk.bindings.word_of(Action::search),
                    box.width - ui.px(20)));
  ui.note_control(ControlKind::button, "Search", desk.tooltip(Action::search), "", box);
  if (searched) perform(Action::search);
  ui.end_panel();
}

}  // namespace argil::studio
