#include "tools/studio/viewport.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tools/studio/curve_mode.h"

namespace argil::studio {

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
