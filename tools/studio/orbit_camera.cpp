#include "tools/studio/orbit_camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace argil::studio {

namespace {

constexpr double k_tangent = 0.27;     // of half the angle seen across the free part's shorter side
constexpr double k_turn = 0.0075;      // [rad] a pixel
constexpr double k_steepest = 1.5707;  // just short of straight down, where up would be lost
constexpr double k_notch = 0.88;       // of the distance

}  // namespace

void OrbitCamera::set_window(int width, int height, const Rect& free) {
  width_ = std::max(1, width);
  height_ = std::max(1, height);
  free_ = free;
}

Eigen::Matrix3d OrbitCamera::view_from_world() const {
  const Eigen::Vector3d back = towards_eye();
  const Eigen::Vector3d right(-std::sin(now_.yaw), std::cos(now_.yaw), 0);
  Eigen::Matrix3d view;
  view << right.transpose(), back.cross(right).transpose(), back.transpose();
  return view;
}

Eigen::Vector3d OrbitCamera::towards_eye() const {
  return {std::cos(now_.pitch) * std::cos(now_.yaw), std::cos(now_.pitch) * std::sin(now_.yaw),
          std::sin(now_.pitch)};
}

Eigen::Vector3d OrbitCamera::eye() const {
  return now_.pivot + now_.distance * towards_eye();
}

void OrbitCamera::orbit(double right, double up) {
  goal_.reset();
  const double scale = k_turn * 800 / std::max(400.0, static_cast<double>(height_));
  now_.yaw -= scale * right;
  now_.pitch = std::clamp(now_.pitch - scale * up, -k_steepest, k_steepest);
}

void OrbitCamera::pan(double right, double up) {
  goal_.reset();
  const Eigen::Matrix3d view = view_from_world();
  const double size = pixel_size(now_.pivot);
  now_.pivot -= size * (right * view.row(0) + up * view.row(1)).transpose();
}

void OrbitCamera::zoom(double notches) {
  goal_.reset();
  now_.distance = std::clamp(now_.distance * std::pow(k_notch, notches), 1e-9, 1e9);
}

void OrbitCamera::look_from(double yaw, double pitch) {
  Pose goal = goal_.value_or(now_);
  goal.yaw = now_.yaw + std::remainder(yaw - now_.yaw, 2 * M_PI);
  goal.pitch = std::clamp(pitch, -k_steepest, k_steepest);
  goal_ = goal;
}

void OrbitCamera::frame(const Box& box) {
  Pose goal = goal_.value_or(now_);
  goal.pivot = box.middle();
  goal.distance = std::max(1e-9, 1.16 * box.radius() / k_tangent);
  goal_ = goal;
}

void OrbitCamera::arrive() {
  if (goal_) now_ = *goal_;
  goal_.reset();
}

void OrbitCamera::advance(double seconds) {
  if (!goal_) return;
  const double share = 1 - std::exp(-seconds / 0.06);
  now_.pivot += share * (goal_->pivot - now_.pivot);
  now_.yaw += share * (goal_->yaw - now_.yaw);
  now_.pitch += share * (goal_->pitch - now_.pitch);
  now_.distance += share * (goal_->distance - now_.distance);
  const double away = (goal_->pivot - now_.pivot).norm() / now_.distance + std::abs(goal_->yaw - now_.yaw) +
                      std::abs(goal_->pitch - now_.pitch) + std::abs(goal_->distance / now_.distance - 1);
  if (away < 1e-3) arrive();
}

double OrbitCamera::pixel_size(const Eigen::Vector3d& position) const {
  const double depth = std::max(1e-12, towards_eye().dot(eye() - position));
  const double shorter = std::max(1.0F, std::min(free_.width, free_.height));
  return 2 * k_tangent * depth / shorter;
}

Ray OrbitCamera::ray(double x, double y) const {
  const double shorter = std::max(1.0F, std::min(free_.width, free_.height));
  const double slope = 2 * k_tangent / shorter;
  const double right = (x - (free_.x + 0.5 * free_.width)) * slope;
  const double up = -(y - (free_.y + 0.5 * free_.height)) * slope;
  const Eigen::Matrix3d view = view_from_world();
  const Eigen::Vector3d direction =
      right * view.row(0).transpose() + up * view.row(1).transpose() - view.row(2).transpose();
  return {eye(), direction.normalized()};
}

Eigen::Vector2d OrbitCamera::pixel(const Eigen::Vector3d& position) const {
  const Eigen::Vector3d seen = view_from_world() * (position - eye());
  const double depth = std::max(1e-12, -seen.z());
  const double shorter = std::max(1.0F, std::min(free_.width, free_.height));
  const double slope = 2 * k_tangent / shorter;
  return {free_.x + 0.5 * free_.width + seen.x() / depth / slope,
          free_.y + 0.5 * free_.height - seen.y() / depth / slope};
}

view::Camera OrbitCamera::camera(const view::Place& place, const Box& box) const {
  const Eigen::Matrix3d view = view_from_world();
  const Eigen::Vector3d at = (eye() - place.middle) / place.radius, back = view.row(2);
  double nearest = HUGE_VAL, farthest = -HUGE_VAL;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1) ? box.high.x() : box.low.x(), (i & 2) ? box.high.y() : box.low.y(),
                                 (i & 4) ? box.high.z() : box.low.z());
    const double depth = back.dot(at - (corner - place.middle) / place.radius);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  view::Camera camera;
  camera.view_from_world = view.cast<float>();
  camera.eye = at.cast<float>();
  const double distance = now_.distance / place.radius;
  camera.nearest = static_cast<float>(std::max(nearest, 0.01 * distance));
  camera.farthest = static_cast<float>(std::max(farthest, 0.02 * distance));
  const double shorter = std::max(1.0F, std::min(free_.width, free_.height)), slope = 2 * k_tangent / shorter;
  camera.pixel_at_unit_distance = static_cast<float>(slope);
  // The depth range reaches beyond the scene for its shadow and what a tool draws out of it.
  const double far_plane = std::max(farthest + 4, 2 * distance);
  const double near_plane = std::clamp(0.3 * nearest, 0.004 * distance, 0.5 * distance);
  const double focus_x = 2 / (slope * width_), focus_y = 2 / (slope * height_);
  const double shift_x = 2 * (free_.x + 0.5 * free_.width) / width_ - 1;
  const double shift_y = 1 - 2 * (free_.y + 0.5 * free_.height) / height_;
  Eigen::Matrix4d clip_from_view = Eigen::Matrix4d::Zero();
  clip_from_view(0, 0) = focus_x;
  clip_from_view(0, 2) = -shift_x;
  clip_from_view(1, 1) = focus_y;
  clip_from_view(1, 2) = -shift_y;
  clip_from_view(2, 2) = -(far_plane + near_plane) / (far_plane - near_plane);
  clip_from_view(2, 3) = -2 * far_plane * near_plane / (far_plane - near_plane);
  clip_from_view(3, 2) = -1;
  Eigen::Matrix4d view_from_picture = Eigen::Matrix4d::Identity();
  view_from_picture.topLeftCorner<3, 3>() = view;
  view_from_picture.topRightCorner<3, 1>() = -view * at;
  camera.clip_from_world = (clip_from_view * view_from_picture).cast<float>();
  return camera;
}

}  // namespace argil::studio
