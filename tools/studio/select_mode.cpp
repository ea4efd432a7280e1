#include "tools/studio/select_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace argil::studio {

namespace {

using sculpt::ElementType;

constexpr double k_double_click = 0.35;  // [s]
constexpr double k_box = 5;              // pixels of the layout from which a press is a box

std::optional<ElementType> next_type(std::optional<ElementType> type) {
  if (!type) return ElementType::faces;
  switch (*type) {
    case ElementType::faces:
      return ElementType::edges;
    case ElementType::edges:
      return ElementType::vertices;
    case ElementType::vertices:
      return ElementType::cells;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::string select_line(ElementType type, const std::vector<std::uint32_t>& ids, const char* how) {
  std::string line = fmt::format("select {} ids", sculpt::word(type));
  for (const std::uint32_t id : ids) line += fmt::format(" {}", id);
  return *how == '\0' ? line : line + ' ' + how;
}

void SelectMode::hover(Desk& desk, const std::optional<Hit>& hit) const {
  desk.pointed.reset();
  const auto type = desk.pointing();
  if (!type || !hit || !desk.now->selectable || !desk.now->scene) return;
  desk.pointed = element_at(*desk.now->selectable, desk.now->scene->surface, *type, *hit);
}

void SelectMode::press(const Desk& desk, double x, double y) {
  if (!desk.settings.choosing) return;
  pressed_ = Eigen::Vector2d(x, y);
  pressed_on_ = desk.pointed;
}

std::optional<ScreenBox> SelectMode::box(const Desk& desk, double x, double y) const {
  if (!pressed_) return std::nullopt;
  const Eigen::Vector2d from = *pressed_, to(x, y);
  if ((to - from).norm() < desk.ui->px(k_box)) return std::nullopt;
  return ScreenBox{std::min(from.x(), to.x()), std::min(from.y(), to.y()), std::max(from.x(), to.x()),
                   std::max(from.y(), to.y())};
}

void SelectMode::release(Desk& desk, const OrbitCamera& camera, double x, double y, bool control, bool shift) {
  const auto area = box(desk, x, y);
  pressed_.reset();
  if (!desk.settings.choosing || !desk.now->scene || !desk.now->selectable) return;
  if (!area) {
    click(desk, control, shift);
    return;
  }
  // What can be seen is looked for where there is time: not in a frame.
  const ElementType type = *desk.settings.choosing;
  const auto on = desk.now->selectable;
  const auto scene = desk.now->scene;
  desk.workshop->post([=, box = *area](Bench& bench) {
    const auto ids = elements_in(*on, scene->surface, type, camera, box, shift);
    if (!ids.empty())
      bench.run(select_line(type, ids, control ? "add" : ""));
    else if (!control)
      bench.run(fmt::format("select {} none", sculpt::word(type)));
  });
}

void SelectMode::click(Desk& desk, bool control, bool shift) {
  const ElementType type = *desk.settings.choosing;
  const sculpt::Selection& selection = desk.selection();
  const std::string word = sculpt::word(type);
  const bool twice = pressed_on_ && clicked_ == pressed_on_ && desk.time - clicked_at_ < k_double_click;
  clicked_ = pressed_on_;
  clicked_at_ = desk.time;
  if (!pressed_on_) {
    if (!control && !selection.ids.empty()) desk.run(fmt::format("select {} none", word));
    return;
  }
  const bool joins = control && (selection.type == type || selection.ids.empty());
  if (twice) {
    const char* way = type != ElementType::edges ? "component" : shift ? "ring" : "loop";
    desk.run(select_line(type, {*pressed_on_}, way) + (joins ? " add" : ""));
    clicked_.reset();
    return;
  }
  const bool is_selected =
      selection.type == type && std::binary_search(selection.ids.begin(), selection.ids.end(), *pressed_on_);
  if (!joins && is_selected && selection.ids.size() == 1) return;
  desk.run(select_line(type, {*pressed_on_}, !joins ? "" : is_selected ? "remove" : "add"));
}

bool SelectMode::cancel(Desk& desk) {
  waiting_ = nullptr;
  if (pressed_) {
    pressed_.reset();
    return true;
  }
  if (desk.pending.tool != nullptr) {
    desk.drop_pending();
    return true;
  }
  if (!desk.settings.choosing) return false;
  if (const sculpt::Selection& selection = desk.selection(); !selection.ids.empty())
    desk.run(fmt::format("select {} none", sculpt::word(selection.type)));
  else
    desk.choose(std::nullopt);
  return true;
}

void SelectMode::advance(Desk& desk, const OrbitCamera& camera, double x, double y) {
  if (!desk.now->scene) {
    waiting_ = nullptr;
    desk.pending = {};
    return;
  }
  if (waiting_ != nullptr && desk.now->selectable) begin(desk, camera, *std::exchange(waiting_, nullptr), x, y);
  PendingEdit& pending = desk.pending;
  if (pending.tool == nullptr || pending.journal_lines == desk.now->journal_lines) return;
  pending.journal_lines = desk.now->journal_lines;
  show_pending(desk);
}

bool SelectMode::perform(Desk& desk, const OrbitCamera& camera, Action action, double x, double y) {
  using enum Action;
  const ElementType type =
      desk.settings.choosing.value_or(desk.selection().ids.empty() ? ElementType::faces : desk.selection().type);
  const auto select = [&](const char* what) { desk.run(fmt::format("select {} {}", sculpt::word(type), what)); };
  if (const EditTool* tool = edit_tool(action)) {
    desk.drop_pending();
    begin(desk, camera, *tool, x, y);
    return true;
  }
  switch (action) {
    case confirm:
      if (desk.pending.tool == nullptr) return false;
      commit(desk);
      return true;
    case select_next_type:
      desk.drop_pending();
      desk.choose(next_type(desk.settings.choosing));
      return true;
    case select_all:
      desk.drop_pending();
      desk.run(fmt::format("select {}", sculpt::word(type)));
      return true;
    case select_none:
      select("none");
      return true;
    case select_inverse:
      select("invert");
      return true;
    case select_grow:
      select("grow");
      return true;
    case select_shrink:
      select("shrink");
      return true;
    case select_component:
      select("component");
      return true;
    case select_loop:
      select("loop");
      return true;
    case select_ring:
      select("ring");
      return true;
    case select_name:
      desk.open_dialogue(Dialogue::search, fmt::format("select {} selected as ", sculpt::word(type)));
      return true;
    case mask_clear:
      desk.run("mask clear");
      return true;
    case mask_invert:
      desk.run("mask invert");
      return true;
    case mask_selected:
      desk.run("mask selected");
      return true;
    case mask_unselected:
      desk.run("mask unselected");
      return true;
    case undo:
    case redo:
      desk.drop_pending();
      return false;
    default:
      return false;
  }
}

}  // namespace argil::studio
