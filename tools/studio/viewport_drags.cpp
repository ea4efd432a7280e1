// Of viewport.h: what a press begins, a drag moves and letting go ends.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tools/studio/curve_mode.h"
#include "tools/studio/viewport.h"

namespace argil::studio {

namespace {

// A curve's handle holds on, and has no radius to scale; the probe only feels.
double acting_pressure(const Desk& desk, const Input& input, bool of_handle) {
  const PenScales scales = desk.settings.pen;
  const bool none = scales == PenScales::nothing || desk.tool().kind == ToolKind::probe ||
                    (of_handle && scales == PenScales::radius);
  return none ? 1 : input.pressure;
}

}  // namespace

void Viewport::take_hold(const Eigen::Vector3d& at) {
  grip_ = device_ = at;
  mouse_.grab(at, -camera_.towards_eye());
}

bool Viewport::press_on_plane(Desk& desk) {
  const Settings& settings = desk.settings;
  if (!settings.cut || !desk.now->scene) return false;
  const Eigen::Vector2d handle = camera_.pixel(settings.cut_point);
  if ((handle - Eigen::Vector2d(x_, y_)).norm() >= desk.ui->px(12)) return false;
  drag_ = Drag::plane;
  return true;
}

// What is pending takes the press: let go, it is done. Else it chooses.
bool Viewport::press_in_select_mode(Desk& desk, const Input& input) {
  (void)input;
  if (desk.pending.tool != nullptr) {
    drag_ = Drag::amount;
    return true;
  }
  if (!desk.settings.choosing) return false;
  select_.press(desk, x_, y_);
  drag_ = Drag::choose;
  return true;
}

bool Viewport::press_on_curve(Desk& desk, const Input& input) {
  if (desk.tool().kind != ToolKind::curve) return false;
  const auto handle = handle_at(desk, camera_, x_, y_);
  if (!desk.curve.finished) {
    if (!hover_) return false;
    if (!handle) add_curve_point(desk, camera_, hover_->at);
    drag_ = Drag::orbit;  // the point lies; going on turns the view
    return true;
  }
  if (!handle) {
    drag_ = Drag::orbit;
    return true;
  }
  drag_ = Drag::handle;
  handle_ = *handle;
  take_hold(desk.now->curve->handles[handle_]);
  desk.force_plot.clear();
  desk.workshop->begin_stroke(handle_stroke(desk, handle_, acting_pressure(desk, input, true)));
  return true;
}

void Viewport::press(Desk& desk, const Input& input, bool control, bool shift) {
  pressed_x_ = x_;
  pressed_y_ = y_;
  if (press_on_plane(desk) || press_in_select_mode(desk, input) || press_on_curve(desk, input)) return;
  if (!hover_) {
    drag_ = Drag::orbit;
    return;
  }
  take_hold(hover_->at);
  switch (desk.tool().kind) {
    case ToolKind::extrude:
      drag_ = select_.take_face(desk, camera_, x_, y_) ? Drag::amount : Drag::orbit;
      break;
    default: {
      drag_ = Drag::stroke;
      desk.force_plot.clear();
      StrokeStart start;
      start.pose.position = hover_->at;
      start.pose.pressure = acting_pressure(desk, input, false);
      start.tool = desk.brush;
      start.options.invert = control;
      start.options.smoothing = shift && desk.tool().kind == ToolKind::force;
      start.options.inside = hover_->cut;
      start.options.scales_radius = desk.settings.pen == PenScales::radius;
      desk.workshop->begin_stroke(start);
      break;
    }
  }
}

// A force tool goes with the pointer through space, by the plane through where it took hold; a brush that lays
// something on the clay goes over its surface.
void Viewport::move_device(Desk& desk, const Input& input) {
  const Ray ray = camera_.ray(x_, y_);
  mouse_.point({ray.origin, ray.direction});
  mouse_.set_pressure(acting_pressure(desk, input, drag_ == Drag::handle));
  const sculpt::DeviceSample sample = mouse_.exchange({}, 0);
  device_ = sample.pose.position;
  if (drag_ == Drag::stroke && desk.tool().kind != ToolKind::force && desk.now->scene)
    if (const auto hit = pick(desk.now->scene->surface, ray)) device_ = hit->at;
  sculpt::StrokePose pose;
  pose.position = device_;
  pose.pressure = sample.pressure;
  desk.workshop->move_device(pose);
}

void Viewport::move_plane(Desk& desk, double distance) {
  Settings& settings = desk.settings;
  const Box box = box_of(*desk.now);
  const double low = std::min(settings.cut_normal.dot(box.low), settings.cut_normal.dot(box.high));
  const double high = std::max(settings.cut_normal.dot(box.low), settings.cut_normal.dot(box.high));
  const double at = settings.cut_normal.dot(settings.cut_point);
  settings.cut_point += settings.cut_normal * (std::clamp(at + distance, low, high) - at);
  desk.show();
}

void Viewport::drag(Desk& desk, const Input& input, bool shift) {
  const double right = x_ - last_x_, up = last_y_ - y_;
  switch (drag_) {
    case Drag::orbit:
      camera_.orbit(right, up);
      break;
    case Drag::pan:
      camera_.pan(right, up);
      break;
    case Drag::stroke:
    case Drag::handle:
      move_device(desk, input);
      break;
    case Drag::choose:
      break;
    case Drag::amount:
      select_.follow(desk, camera_, x_, y_, shift);
      break;
    case Drag::plane: {
      const Eigen::Vector3d& normal = desk.settings.cut_normal;
      const Eigen::Vector2d from = camera_.pixel(desk.settings.cut_point),
                            to = camera_.pixel(desk.settings.cut_point +
                                               100 * camera_.pixel_size(desk.settings.cut_point) * normal);
      const Eigen::Vector2d along = (to - from) / 100;  // pixels a pixel's length of the normal
      const double length = std::max(along.squaredNorm(), 0.02);
      const double way = along.dot(Eigen::Vector2d(right, -up)) / length;
      move_plane(desk, way * camera_.pixel_size(desk.settings.cut_point));
      break;
    }
    case Drag::radius: {
      const double size = hover_ ? camera_.pixel_size(hover_->at) : camera_.pixel_size(camera_.pivot());
      brush_now_ = std::max(2 * size, brush_start_ + (x_ - pressed_x_) * size * (shift ? 0.2 : 1));
      break;
    }
    case Drag::strength:
      brush_now_ = brush_start_ * std::exp((x_ - pressed_x_) / desk.ui->px(shift ? 600 : 150));
      break;
    case Drag::none:
      break;
  }
}

void Viewport::release(Desk& desk) {
  const Drag was = std::exchange(drag_, Drag::none);
  switch (was) {
    case Drag::stroke:
      desk.workshop->end_stroke(desk.settings.keep_shape && desk.tool().kind == ToolKind::force);
      break;
    case Drag::handle:
      desk.workshop->end_stroke(desk.settings.keep_shape);
      if (handle_ < desk.curve.points.size()) {
        desk.curve.points = desk.now->curve ? desk.now->curve->handles : desk.curve.points;
        desk.curve.points[handle_] = device_;
        desk.show();
      }
      break;
    case Drag::amount:
      select_.commit(desk);
      break;
    case Drag::radius:
    case Drag::strength: {
      const double digits = std::pow(10.0, std::floor(std::log10(brush_now_)) - 2);
      const double value = std::round(brush_now_ / digits) * digits;
      (was == Drag::radius ? desk.brush.radius : desk.brush.strength) = value;
      break;
    }
    default:
      break;
  }
}

void Viewport::cancel(Desk& desk) {
  if (drag_ == Drag::amount) (void)select_.cancel(desk);
  if (drag_ == Drag::stroke || drag_ == Drag::handle) desk.workshop->cancel_stroke();
  select_.drop_box();
  drag_ = Drag::none;
}

}  // namespace argil::studio
