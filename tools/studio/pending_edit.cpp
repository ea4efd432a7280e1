// Of select_mode.h: the tool that has been taken, from what it acts on by the amount that the pointer gives to the
// lines that it is.

#include <algorithm>
#include <cmath>

#include "tools/studio/select_mode.h"

namespace argil::studio {

namespace {

using sculpt::ElementType;

// So many digits that a step is a thousandth of the solid, or of the range.
double rounded(double value, double size) {
  const double step = std::pow(10.0, std::floor(std::log10(std::max(size, 1e-300))) - 3);
  return std::round(value / step) * step;
}

double size_of(const Desk& desk) {
  return std::max(1e-12, 0.5 * (desk.now->high - desk.now->low).norm());
}

/// The axis that is nearest to a direction.
Eigen::Vector3d axis_along(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return Eigen::Vector3d::Unit(axis);
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

void SelectMode::show_pending(const Desk& desk) const {
  desk.workshop->preview(desk.pending.lines());
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
  const sculpt::Selection& selection = desk.selection();
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
  if (!desk.settings.choosing) desk.choose(acted.ids.empty() ? tool.types.front() : acted.type);
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
    desk.drop_pending();
    return;
  }
  if (desk.now->ghost && desk.now->ghost->lines == lines && !desk.now->ghost->fault.empty()) return;
  desk.workshop->run_together(lines);
  desk.pending = {};
}

}  // namespace argil::studio
