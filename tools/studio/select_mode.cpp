#include "tools/studio/select_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace argil::studio {

namespace {

using sculpt::ElementType;

constexpr double k_double_click = 0.35;  // [s]
constexpr double k_box = 5;              // pixels of the layout from which a press is a box

// So many digits that a step is a thousandth of the solid, or of the range.
double rounded(double value, double size) {
  const double step = std::pow(10.0, std::floor(std::log10(std::max(size, 1e-300))) - 3);
  return std::round(value / step) * step;
}

double size_of(const Desk& desk) {
  return std::max(1e-12, 0.5 * (desk.now->high - desk.now->low).norm());
}

const sculpt::Selection& selection_of(const Desk& desk) {
  static const sculpt::Selection k_nothing;
  return desk.now->state.selection ? *desk.now->state.selection : k_nothing;
}

/// The axis that is nearest to a direction.
Eigen::Vector3d axis_along(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return Eigen::Vector3d::Unit(axis);
}

void choose(Desk& desk, std::optional<ElementType> type) {
  desk.settings.choosing = type;
  desk.pointed.reset();
  desk.settings.panel = Panel::tool;
  desk.show();
}

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

// Where one pixel along the screen goes on an axis [m].
double along_axis(const OrbitCamera& camera, const Eigen::Vector3d& at, const Eigen::Vector3d& axis,
                  const Eigen::Vector2d& pixels) {
  const double pixel = camera.pixel_size(at);
  const Eigen::Vector2d along = (camera.pixel(at + 100 * pixel * axis) - camera.pixel(at)) / 100;
  // Looked at along the axis, upwards is outwards.
  if (along.squaredNorm() < 0.02) return -pixels.y() * pixel;
  return along.dot(pixels) / along.squaredNorm() * pixel;
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
  const sculpt::Selection& selection = selection_of(desk);
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
    desk.pending = {};
    desk.workshop->preview({});
    return true;
  }
  if (!desk.settings.choosing) return false;
  if (const sculpt::Selection& selection = selection_of(desk); !selection.ids.empty())
    desk.run(fmt::format("select {} none", sculpt::word(selection.type)));
  else
    choose(desk, std::nullopt);
  return true;
}

void SelectMode::show_pending(const Desk& desk) const {
  desk.workshop->preview(desk.pending.lines());
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

void SelectMode::aim(const Desk& desk, const OrbitCamera& camera, const sculpt::Selection& acted,
                     PendingEdit& pending) {
  pending.journal_lines = desk.now->journal_lines;
  pending.aim.type = acted.type;
  const Patch patch = patch_of(*desk.now->selectable, desk.now->scene->surface, acted);
  pending.aim.middle = patch.empty ? Box{desk.now->low, desk.now->high}.middle() : patch.middle;
  pending.aim.normal = pending.tool->amount == Amount::share ? axis_along(patch.normal) : patch.normal;
  const Eigen::Vector3d eye = camera.towards_eye();
  pending.aim.across = axis_along(Eigen::Vector3d(-eye.y(), eye.x(), 0));
  for (double& value : pending.aim.middle) value = rounded(value, size_of(desk));
}

bool SelectMode::take_face(Desk& desk, const OrbitCamera& camera, double x, double y) {
  if (!desk.pointed || !desk.now->selectable || desk.pointing() != ElementType::faces) return false;
  const sculpt::Selection face{ElementType::faces, {*desk.pointed}};
  PendingEdit pending;
  pending.tool = edit_tool(Action::edit_extrude);
  pending.choice = select_line(face.type, face.ids);
  pending.follows = true;
  pending.from_x = x;
  pending.from_y = y;
  aim(desk, camera, face, pending);
  desk.pending = pending;
  return true;
}

void SelectMode::begin(Desk& desk, const OrbitCamera& camera, const EditTool& tool, double x, double y) {
  if (!desk.now->scene) return;
  const sculpt::Selection& selection = selection_of(desk);
  PendingEdit pending;
  pending.tool = &tool;
  sculpt::Selection acted = selection;
  if (acted.ids.empty() && desk.settings.choosing && desk.pointed) {
    acted = {*desk.settings.choosing, {*desk.pointed}};
    pending.choice = select_line(acted.type, acted.ids);
  }
  if (tool.at_once) {
    desk.workshop->run_together(pending.lines());
    return;
  }
  // With nothing to act on, one selects first: the tool says what.
  if (!desk.settings.choosing) choose(desk, acted.ids.empty() ? tool.types.front() : acted.type);
  if (!desk.now->selectable) {
    waiting_ = &tool;
    return;
  }
  aim(desk, camera, acted, pending);
  pending.amount = tool.initial;
  if (tool.action == Action::edit_extrude || tool.action == Action::edit_peak)
    pending.amount = rounded(0.2 * size_of(desk), size_of(desk));
  pending.follows = tool.amount != Amount::none;
  pending.from_x = x;
  pending.from_y = y;
  pending.from_amount =
      tool.amount == Amount::distance && tool.action != Action::edit_weld && tool.action != Action::edit_cut_plane
          ? 0
          : pending.amount;
  if (tool.amount == Amount::way) pending.aim.way = {0, 0, rounded(0.2 * size_of(desk), size_of(desk))};
  desk.pending = pending;
  show_pending(desk);
}

void SelectMode::follow(Desk& desk, const OrbitCamera& camera, double x, double y, bool fine) const {
  PendingEdit& pending = desk.pending;
  if (pending.tool == nullptr || !pending.follows) return;
  const EditTool& tool = *pending.tool;
  const Eigen::Vector2d went = (fine ? 0.2 : 1.0) * Eigen::Vector2d(x - pending.from_x, y - pending.from_y);
  const double size = size_of(desk);
  switch (tool.amount) {
    case Amount::distance: {
      const Eigen::Vector3d& axis = tool.action == Action::edit_cut_plane ? pending.aim.across : pending.aim.normal;
      const double way = along_axis(camera, pending.aim.middle, axis, went);
      pending.amount = std::clamp(rounded(pending.from_amount + way, size), tool.low, tool.high);
      break;
    }
    case Amount::share:
      pending.amount = std::clamp(
          rounded(pending.from_amount + went.x() / desk.ui->px(300) * (tool.high - tool.low), tool.high - tool.low),
          tool.low, tool.high);
      break;
    case Amount::count:
      pending.amount =
          std::clamp(std::round(pending.from_amount + went.x() / desk.ui->px(60)), tool.low, tool.high);
      break;
    case Amount::way: {
      const Ray from = camera.ray(pending.from_x, pending.from_y),
                to = camera.ray(pending.from_x + went.x(), pending.from_y + went.y());
      const Eigen::Vector3d eye = camera.towards_eye();
      const double depth = eye.dot(pending.aim.middle);
      const auto met = [&](const Ray& ray) -> Eigen::Vector3d {
        return ray.origin + (depth - eye.dot(ray.origin)) / eye.dot(ray.direction) * ray.direction;
      };
      const Eigen::Vector3d way = met(to) - met(from);
      if (way.allFinite())
        for (int axis = 0; axis < 3; ++axis) pending.aim.way[axis] = rounded(way[axis], size);
      break;
    }
    case Amount::none:
      break;
  }
  show_pending(desk);
}

bool SelectMode::wheel(Desk& desk, double notches) const {
  PendingEdit& pending = desk.pending;
  if (pending.tool == nullptr || pending.tool->amount != Amount::count) return false;
  const double now = std::clamp(pending.amount + (notches > 0 ? 1 : -1), pending.tool->low, pending.tool->high);
  pending.from_amount += now - pending.amount;
  pending.amount = now;
  show_pending(desk);
  return true;
}

void SelectMode::commit(Desk& desk) const {
  if (desk.pending.tool == nullptr) return;
  // What cannot be done stays as it is, and goes on to say why.
  const auto lines = desk.pending.lines();
  const bool is_nothing = desk.pending.tool->action == Action::edit_extrude && desk.pending.amount == 0;
  if (is_nothing && !desk.settings.choosing) {  // pressed and let go
    desk.pending = {};
    desk.workshop->preview({});
    return;
  }
  if (desk.now->ghost && desk.now->ghost->lines == lines && !desk.now->ghost->fault.empty()) return;
  desk.workshop->run_together(lines);
  desk.pending = {};
}

bool SelectMode::perform(Desk& desk, const OrbitCamera& camera, Action action, double x, double y) {
  using enum Action;
  const ElementType type = desk.settings.choosing.value_or(
      selection_of(desk).ids.empty() ? ElementType::faces : selection_of(desk).type);
  const auto select = [&](const char* what) { desk.run(fmt::format("select {} {}", sculpt::word(type), what)); };
  const auto drop = [&] {
    if (desk.pending.tool == nullptr) return;
    desk.pending = {};
    desk.workshop->preview({});
  };
  if (const EditTool* tool = edit_tool(action)) {
    drop();
    begin(desk, camera, *tool, x, y);
    return true;
  }
  switch (action) {
    case confirm:
      if (desk.pending.tool == nullptr) return false;
      commit(desk);
      return true;
    case select_next_type:
      drop();
      choose(desk, next_type(desk.settings.choosing));
      return true;
    case select_all:
      drop();
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
      drop();
      return false;
    default:
      return false;
  }
}

}  // namespace argil::studio
