#include "tools/studio/curve_mode.h"

namespace argil::studio {

namespace {

constexpr double k_reach = 12;  // pixels of the layout about a handle

}  // namespace

std::optional<std::size_t> handle_at(const Desk& desk, const OrbitCamera& camera, double x, double y) {
  std::optional<std::size_t> best;
  if (!desk.now->curve) return best;
  double nearest = desk.ui->px(static_cast<float>(k_reach));
  for (std::size_t i = 0; i < desk.now->curve->handles.size(); ++i) {
    const double distance = (camera.pixel(desk.now->curve->handles[i]) - Eigen::Vector2d(x, y)).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    best = i;
  }
  return best;
}

void add_curve_point(Desk& desk, const OrbitCamera& camera, const Eigen::Vector3d& at) {
  for (const Eigen::Vector3d& point : desk.curve.points)
    if ((camera.pixel(point) - camera.pixel(at)).norm() < desk.ui->px(4)) return;
  desk.curve.points.push_back(at);
  desk.show();
}

StrokeStart handle_stroke(const Desk& desk, std::size_t handle, double pressure) {
  StrokeStart start;
  start.pose.position = desk.now->curve->handles[handle];
  start.pose.pressure = pressure;
  start.tool = desk.brush;
  start.options.curve = desk.now->curve->handles;
  start.options.handle = handle;
  return start;
}

bool perform_curve(Desk& desk, Action action) {
  if (desk.tool().kind != ToolKind::curve || desk.settings.choosing || desk.curve.points.empty()) return false;
  switch (action) {
    case Action::confirm:
      if (desk.curve.points.size() > 1) desk.curve.finished = true;
      return true;
    case Action::erase:
      desk.curve.points.pop_back();
      desk.curve.finished = false;
      desk.show();
      return true;
    case Action::cancel:
      desk.curve = {};
      desk.show();
      return true;
    default:
      return false;
  }
}

}  // namespace argil::studio
