// Of select_mode.h: what it shows beside the view.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "tools/studio/quantity.h"
#include "tools/studio/select_mode.h"

namespace argil::studio {

namespace {

using sculpt::ElementType;

const std::vector<std::string>& type_labels() {
  static const std::vector<std::string> labels{"faces", "edges", "vertices", "cells"};
  return labels;
}

ElementType type_of(const std::string& label) {
  if (label == "edges") return ElementType::edges;
  if (label == "vertices") return ElementType::vertices;
  return label == "cells" ? ElementType::cells : ElementType::faces;
}

/// Buttons of actions, two in a row.
void draw_buttons(Desk& desk, float x, float width, const std::vector<Action>& actions,
                  const std::function<void(Action)>& perform) {
  Ui& ui = *desk.ui;
  const float gap = ui.px(8), half = 0.5F * (width - gap);
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const float left = x + (i % 2 == 0 ? 0 : half + gap);
    if (ui.text_button(info(actions[i]).label, {left, ui.cursor_y(), half, ui.px(28)}, info(actions[i]).label,
                       false, desk.tooltip(actions[i])))
      perform(actions[i]);
    if (i % 2 == 1 || i + 1 == actions.size()) ui.skip(34);
  }
}

void draw_sets(Desk& desk) {
  const auto& sets = desk.now->state.sets;
  if (!sets || sets->empty()) return;
  Ui& ui = *desk.ui;
  ui.section("Named sets");
  for (const auto& [name, set] : *sets) {
    if (set.type == ElementType::nodes) continue;
    if (ui.list_row(name, fmt::format("{} {}", set.ids.size(), sculpt::word(set.type)), false, false,
                    "Selects what was kept under this name")) {
      desk.choose(set.type);
      desk.run(fmt::format("select {} set {}", sculpt::word(set.type), io::quote(name)));
    }
  }
}

}  // namespace

void draw_select_panel(Desk& desk, float x, float width, const std::function<void(Action)>& perform) {
  Ui& ui = *desk.ui;
  const Snapshot& now = *desk.now;
  ui.section("Select");
  if (!now.scene) {
    ui.note("There is nothing to select yet. Begin with a block, or open a file.");
    return;
  }
  const auto& labels = type_labels();
  std::size_t type = static_cast<std::size_t>(
      std::find(labels.begin(), labels.end(), sculpt::word(*desk.settings.choosing)) - labels.begin());
  type = std::min(type, labels.size() - 1);
  if (ui.choice_row("Elements", labels, type, desk.tooltip(Action::select_next_type))) {
    desk.choose(type_of(labels[type]));
  }
  const sculpt::Selection& selection = *now.state.selection;
  const std::string many = sculpt::word(selection.ids.empty() ? *desk.settings.choosing : selection.type);
  const std::string one = many == "vertices" ? "vertex" : many.substr(0, many.size() - 1);
  ui.reading_row("Selected", fmt::format("{}", selection.ids.size()), selection.ids.size() == 1 ? one : many,
                 "What tools and commands act on");
  std::vector<Action> ways{Action::select_all,  Action::select_none,   Action::select_inverse,
                           Action::select_grow, Action::select_shrink, Action::select_component};
  if (*desk.settings.choosing == ElementType::edges)
    ways.insert(ways.end(), {Action::select_loop, Action::select_ring});
  draw_buttons(desk, x, width, ways, perform);
  ui.section("Edit");
  std::vector<Action> tools;
  for (const EditTool& tool : edit_tools())
    if (acts_on(tool, *desk.settings.choosing)) tools.push_back(tool.action);
  draw_buttons(desk, x, width, tools, perform);
  ui.section("Mask and sets");
  draw_buttons(desk, x, width, {Action::mask_selected, Action::mask_unselected, Action::select_name}, perform);
  draw_sets(desk);
}

void draw_pending(Desk& desk, const Rect& free, const SelectMode& mode) {
  PendingEdit& pending = desk.pending;
  if (pending.tool == nullptr) return;
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const EditTool& tool = *pending.tool;
  const bool has_amount = tool.amount != Amount::none;
  const float width = ui.px(300), row = ui.px(28 + 8), margin = ui.px(14);
  const float height = ui.px(46) + (has_amount ? row * (tool.amount == Amount::way ? 2 : 1) : 0) + ui.px(40);
  const Rect place{free.x + ui.px(4), free.bottom() - height - ui.px(4), width, height};
  ui.begin_panel("pending", place, t.panel, k_corner);
  ImDrawList& draw = ui.list();
  ui.text(draw, ui.fonts().strong, {place.x + margin, place.y + ui.px(8), width, ui.px(26)}, t.text,
          info(tool.action).label);
  const auto& ghost = desk.now->ghost;
  const bool is_of_this = ghost && ghost->lines == pending.lines();
  std::string counts = "…";
  if (is_of_this) counts = ghost->fault.empty() ? counts_of(*ghost) : "cannot be done so";
  ui.text(draw, ui.fonts().small, {place.x, place.y + ui.px(8), width - margin, ui.px(26)},
          is_of_this && !ghost->fault.empty() ? t.warning : t.quiet, counts, Side::right);
  ui.note_control(
      ControlKind::reading, "What it makes",
      is_of_this && !ghost->fault.empty() ? ghost->fault : "Cells, and faces of the boundary, made and removed", "",
      {place.x + 0.4F * width, place.y + ui.px(8), 0.6F * width - margin, ui.px(26)});
  ui.set_cursor(place.x + margin, place.y + ui.px(40), width - 2 * margin);
  const auto changed = [&] {
    pending.follows = false;
    mode.show_pending(desk);
  };
  if (tool.amount == Amount::way) {
    double way[3] = {pending.aim.way.x(), pending.aim.way.y(), pending.aim.way.z()};
    if (ui.vector_row("Way", way, {.unit = "m", .tooltip = "How far it goes", .low = -1e9, .high = 1e9})) {
      pending.aim.way = Eigen::Vector3d(way[0], way[1], way[2]);
      changed();
    }
  } else if (has_amount) {
    double amount = pending.amount;
    const double size = 0.5 * (desk.now->high - desk.now->low).norm();
    const bool is_length = tool.amount == Amount::distance;
    if (ui.number_row(tool.amount_name, amount,
                      {.unit = tool.unit,
                       .tooltip = info(tool.action).help,
                       .low = is_length ? std::max(tool.low, std::min(-2 * size, amount)) : tool.low,
                       .high = is_length ? std::min(tool.high, std::max(2 * size, amount)) : tool.high,
                       .reset = tool.initial},
                      [&](double value) {
                        pending.amount = tool.amount == Amount::count ? std::round(value) : value;
                        changed();
                      })) {
      pending.amount = tool.amount == Amount::count ? std::round(amount) : amount;
      changed();
    }
  }
  const float half = 0.5F * (width - 2 * margin - ui.px(8)), y = place.bottom() - ui.px(40);
  if (ui.text_button("Do it", {place.x + margin, y, half, ui.px(30)}, "Do it", true, desk.tooltip(Action::confirm)))
    mode.commit(desk);
  if (ui.text_button("Drop it", {place.x + margin + half + ui.px(8), y, half, ui.px(30)}, "Drop it", false,
                     desk.tooltip(Action::cancel))) {
    desk.drop_pending();
  }
  ui.set_cursor(place.x, place.y, width);
  ui.end_panel();
}

void draw_context_menu(Desk& desk, const std::function<void(Action)>& perform) {
  Ui& ui = *desk.ui;
  constexpr const char* k_name = "what can be done";
  if (!desk.wants_context_menu && desk.context_menu_at[0] < 0) return;
  const bool opens = desk.wants_context_menu;
  desk.wants_context_menu = false;
  const ImGuiIO& io = ImGui::GetIO();
  if (opens) desk.context_menu_at = {io.MousePos.x, io.MousePos.y};
  std::vector<Action> rows;
  if (desk.settings.choosing) {
    for (const EditTool& tool : edit_tools())
      if (acts_on(tool, *desk.settings.choosing)) rows.push_back(tool.action);
    rows.insert(rows.end(), {Action::select_grow, Action::select_inverse, Action::select_component});
    if (*desk.settings.choosing == ElementType::edges)
      rows.insert(rows.end(), {Action::select_loop, Action::select_ring});
    rows.push_back(Action::mask_selected);
  } else {
    rows = {Action::select_next_type, Action::mask_clear, Action::mask_invert,
            Action::cut_away,         Action::peel,       Action::undo};
  }
  const float row = ui.px(28), pad = ui.px(6), width = ui.px(230);
  const float height = row * static_cast<float>(rows.size()) + 2 * pad;
  const float x = std::clamp(desk.context_menu_at[0], 0.0F, std::max(0.0F, io.DisplaySize.x - width - pad));
  const float y = std::clamp(desk.context_menu_at[1], 0.0F, std::max(0.0F, io.DisplaySize.y - height - pad));
  ui.begin_panel("context", {x, y, 1, 1}, 0, 0);
  if (opens) ImGui::OpenPopup(k_name);
  if (ui.begin_popup(k_name, {x, y, width, height})) {
    ui.set_cursor(x, y + pad, width);
    for (const Action action : rows)
      if (ui.list_row(info(action).label, desk.bindings.word_of(action), false, false, info(action).help)) {
        ImGui::CloseCurrentPopup();
        perform(action);
      }
    ui.end_popup();
  } else {
    desk.context_menu_at = {-1, -1};
  }
  ui.set_cursor(x, y, 1);
  ui.end_panel();
}

}  // namespace argil::studio
