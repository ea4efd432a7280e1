#include "tools/view/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace argil::view {

namespace {

constexpr double k_tangent = 0.27;  // of half the angle seen across the shorter side of the picture

/// Half-width of the view to the lower and upper side, at distance 1.
struct Span {
  double low, high;
};

Span free_span(double tangent, double low_margin, double high_margin) {
  const double sum = low_margin + high_margin;
  const double shrink = sum > 0.6 ? 0.6 / sum : 1.0;  // a tiny picture still shows its scene
  return {tangent * (1 - 2 * shrink * low_margin), tangent * (1 - 2 * shrink * high_margin)};
}

/// Where the eye may stand: positions (s, depth) must satisfy -span.low ≤ (s - eye) / (depth - eye_depth) ≤
/// span.high.
struct Side {
  double high = -HUGE_VAL, low = -HUGE_VAL;
  void add(double s, double depth, const Span& span) {
    high = std::max(high, s - span.high * depth);
    low = std::max(low, -s - span.low * depth);
  }
  double depth(const Span& span) const { return -(high + low) / (span.high + span.low); }
  double centre(double eye_depth, const Span& span) const {
    return 0.5 * (high + span.high * eye_depth - low - span.low * eye_depth);
  }
};

}  // namespace

Place place_of(const std::vector<Eigen::Vector3f>& positions) {
  Place place;
  if (positions.empty()) return place;
  Eigen::Vector3d low = positions.front().cast<double>(), high = low;
  for (const Eigen::Vector3f& position : positions) {
    low = low.cwiseMin(position.cast<double>());
    high = high.cwiseMax(position.cast<double>());
  }
  place.middle = 0.5 * (low + high);
  const double radius = 0.5 * (high - low).norm();
  place.radius = radius > 0 ? radius : 1.0;
  return place;
}

Eigen::Vector2f Camera::pixel(const Eigen::Vector3f& position, int width, int height) const {
  const Eigen::Vector4f clip = clip_from_world * position.homogeneous();
  return {(0.5F + 0.5F * clip.x() / clip.w()) * static_cast<float>(width),
          (0.5F - 0.5F * clip.y() / clip.w()) * static_cast<float>(height)};
}

float Camera::distance(const Eigen::Vector3f& position) const {
  return view_from_world.row(2).dot(eye - position);
}

Camera framing_camera(const std::vector<Eigen::Vector3f>& positions, const sculpt::PictureOptions& options,
                      const Margins& margins) {
  const Eigen::Vector3d back = options.view_from.normalized();
  const Eigen::Vector3d up = std::abs(back.z()) < 0.9999 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d right = up.cross(back).normalized(), top = back.cross(right);

  const double width = options.width, height = options.height, shorter = std::min(width, height);
  const double tangent_x = k_tangent * width / shorter, tangent_y = k_tangent * height / shorter;
  const Span across = free_span(tangent_x, margins.left, margins.right);
  const Span upwards = free_span(tangent_y, margins.bottom, margins.top);

  Side horizontal, vertical;
  double nearest = HUGE_VAL, farthest = -HUGE_VAL;
  const auto add = [&](const Eigen::Vector3d& position) {
    const double depth = -back.dot(position);
    horizontal.add(right.dot(position), depth, across);
    vertical.add(top.dot(position), depth, upwards);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  };
  for (const Eigen::Vector3f& position : positions) add(position.cast<double>());
  if (positions.empty()) add(Eigen::Vector3d::Zero());

  const double eye_depth = std::min({horizontal.depth(across), vertical.depth(upwards), nearest - 0.5});
  const Eigen::Vector3d eye =
      right * horizontal.centre(eye_depth, across) + top * vertical.centre(eye_depth, upwards) - back * eye_depth;

  Camera camera;
  Eigen::Matrix3d view;
  view << right.transpose(), top.transpose(), back.transpose();
  camera.view_from_world = view.cast<float>();
  camera.eye = eye.cast<float>();
  camera.nearest = static_cast<float>(nearest - eye_depth);
  camera.farthest = static_cast<float>(farthest - eye_depth);
  camera.pixel_at_unit_distance = static_cast<float>(2 * tangent_y / (height * options.zoom));

  // The depth range reaches beyond the scene for its shadow and the thickness of arrows.
  const double near_plane = 0.3 * (nearest - eye_depth), far_plane = farthest - eye_depth + 4;
  const double shift_x = (across.high - across.low) / (2 * tangent_x) * (1 - options.zoom);
  const double shift_y = (upwards.high - upwards.low) / (2 * tangent_y) * (1 - options.zoom);
  Eigen::Matrix4d clip_from_view = Eigen::Matrix4d::Zero();
  clip_from_view(0, 0) = options.zoom / tangent_x;
  clip_from_view(0, 2) = -shift_x;
  clip_from_view(1, 1) = options.zoom / tangent_y;
  clip_from_view(1, 2) = -shift_y;
  clip_from_view(2, 2) = -(far_plane + near_plane) / (far_plane - near_plane);
  clip_from_view(2, 3) = -2 * far_plane * near_plane / (far_plane - near_plane);
  clip_from_view(3, 2) = -1;
  Eigen::Matrix4d view_from_world = Eigen::Matrix4d::Identity();
  view_from_world.topLeftCorner<3, 3>() = view;
  view_from_world.topRightCorner<3, 1>() = -view * eye;
  camera.clip_from_world = (clip_from_view * view_from_world).cast<float>();
  return camera;
}

}  // namespace argil::view
