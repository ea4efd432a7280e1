#include "tools/studio/viewport.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tools/studio/curve_mode.h"

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

Viewport::Viewport(const view::Gl& gl) : gl_(&gl), painter_(gl), overlay_(gl) {}

Box Viewport::box_of(const Snapshot& now) const {
  return {now.low, now.high};
}

bool Viewport::perform(Desk& desk, Action action) {
  if (action == Action::cancel && drag_ == Drag::none && (select_.cancel(desk) || perform_curve(desk, action)))
    return true;
  if (select_.perform(desk, camera_, action, x_, y_) || (action != Action::cancel && perform_curve(desk, action)))
    return true;
  switch (action) {
    case Action::peel:
      desk.settings.peel = desk.settings.peel > 0 ? 0 : std::min(1, desk.now->layers);
      desk.show();
      return true;
    case Action::frame_all:
      if (desk.now->scene) camera_.frame(box_of(*desk.now));
      return true;
    case Action::from_front:
      camera_.look_from(-M_PI / 2, 0);
      return true;
    case Action::from_side:
      camera_.look_from(0, 0);
      return true;
    case Action::from_top:
      camera_.look_from(-M_PI / 2, M_PI / 2);
      return true;
    case Action::cut_away: {
      Settings& settings = desk.settings;
      settings.cut = !settings.cut;
      if (settings.cut) {
        // Along the axis that is looked along, so that the inside shows.
        const Eigen::Vector3d eye = camera_.towards_eye();
        Eigen::Index axis = 0;
        eye.cwiseAbs().maxCoeff(&axis);
        settings.cut_normal = Eigen::Vector3d::Zero();
        settings.cut_normal[axis] = eye[axis] < 0 ? -1 : 1;
        settings.cut_point = box_of(*desk.now).middle();
      }
      desk.show();
      return true;
    }
    case Action::brush_radius:
    case Action::brush_strength:
      if (drag_ != Drag::none || !desk.now->scene) return true;
      drag_ = action == Action::brush_radius ? Drag::radius : Drag::strength;
      brush_start_ = brush_now_ = action == Action::brush_radius ? desk.brush.radius : desk.brush.strength;
      pressed_x_ = x_;
      pressed_y_ = y_;
      return true;
    case Action::cancel:
      if (drag_ == Drag::none) return false;
      cancel(desk);
      return true;
    case Action::forces_off:
      cancel(desk);
      return false;
    default:
      return false;
  }
}

void Viewport::key_released(Desk& desk, int released) {
  const bool sizes = drag_ == Drag::radius || drag_ == Drag::strength;
  const Action action = drag_ == Drag::radius ? Action::brush_radius : Action::brush_strength;
  if (sizes && released == desk.bindings.key_of(action).key && x_ != pressed_x_) release(desk);
}

void Viewport::update_hover(Desk& desk, bool over_ui) {
  hover_.reset();
  desk.pointed.reset();
  const Snapshot& now = *desk.now;
  const bool sizes = drag_ == Drag::radius || drag_ == Drag::strength;
  if (!now.scene || over_ui || !now.scene->draw_surface || (drag_ != Drag::none && !sizes)) return;
  const Ray ray = sizes ? camera_.ray(pressed_x_, pressed_y_) : camera_.ray(x_, y_);
  hover_ = pick(now.scene->surface, ray);
  select_.hover(desk, hover_);
  Reading& reading = desk.reading;
  reading.there = hover_.has_value();
  if (!hover_) return;
  reading.at = hover_->at;
  const std::size_t vertices = now.scene->surface.positions.size();
  if (now.young_modulus.size() == vertices)
    reading.young_modulus = value_at(now.scene->surface, now.young_modulus, *hover_);
  reading.strain = now.strain.size() == vertices ? value_at(now.scene->surface, now.strain, *hover_) : -1;
}

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

void Viewport::handle(Desk& desk, const Input& input, bool control, bool shift, bool over_ui) {
  last_x_ = x_;
  last_y_ = y_;
  x_ = input.x;
  y_ = input.y;
  const bool erases = input.eraser && desk.settings.pen != PenScales::nothing;
  const bool pressed_anew = input.pressure != std::exchange(pressure_, input.pressure);
  inverts_ = control || erases;
  if (desk.now->scene && desk.now->solid_number != framed_solid_) {
    camera_.frame(box_of(*desk.now));
    camera_.arrive();
    framed_solid_ = desk.now->solid_number;
  }
  camera_.advance(input.seconds);
  update_hover(desk, over_ui);
  select_.advance(desk, camera_, x_, y_);

  const bool pressed_left = input.buttons[0] && !left_, released_left = !input.buttons[0] && left_;
  const bool pressed_middle = input.buttons[2] && !middle_, released_middle = !input.buttons[2] && middle_;
  const bool pressed_right = input.buttons[1] && !right_, released_right = !input.buttons[1] && right_;
  left_ = input.buttons[0];
  right_ = input.buttons[1];
  middle_ = input.buttons[2];

  const bool sizes = drag_ == Drag::radius || drag_ == Drag::strength;
  if (sizes && pressed_left) {
    release(desk);
  } else if (sizes && pressed_right) {
    drag_ = Drag::none;
  } else if (released_left && drag_ == Drag::choose) {
    drag_ = Drag::none;
    select_.release(desk, camera_, x_, y_, control, shift);
  } else if (drag_ == Drag::none && !over_ui) {
    if (pressed_right) {
      right_x_ = x_;
      right_y_ = y_;
      if (desk.pending.tool != nullptr)
        select_.cancel(desk);
      else
        right_armed_ = true;
    }
    if (released_right && std::exchange(right_armed_, false) &&
        std::hypot(x_ - right_x_, y_ - right_y_) < desk.ui->px(5))
      desk.wants_context_menu = true;
    if (x_ != last_x_ || y_ != last_y_) select_.follow(desk, camera_, x_, y_, shift);
    if (pressed_left) press(desk, input, control || erases, shift);
    if (pressed_middle) drag_ = shift ? Drag::pan : Drag::orbit;
  } else if (drag_ != Drag::none && (x_ != last_x_ || y_ != last_y_)) {
    drag(desk, input, shift);
  } else if (pressed_anew && (drag_ == Drag::stroke || drag_ == Drag::handle)) {
    move_device(desk, input);
  }
  if (drag_ != Drag::none && !sizes &&
      (released_left || (released_middle && (drag_ == Drag::orbit || drag_ == Drag::pan))))
    release(desk);

  if (input.wheel != 0 && !over_ui) {
    if (select_.wheel(desk, input.wheel)) {
    } else if (drag_ == Drag::stroke || drag_ == Drag::handle) {
      mouse_.push(-12 * input.wheel * camera_.pixel_size(grip_));
      move_device(desk, input);
    } else if (desk.settings.peel > 0 && !control) {
      desk.settings.peel =
          std::clamp(desk.settings.peel + (input.wheel > 0 ? 1 : -1), 1, std::max(1, desk.now->layers));
      desk.show();
    } else if (desk.settings.cut && !control) {
      move_plane(desk, -0.02 * input.wheel * 2 * box_of(*desk.now).radius());
    } else {
      camera_.zoom(input.wheel);
    }
  }
}

}  // namespace argil::studio
