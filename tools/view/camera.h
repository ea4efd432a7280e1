#pragma once
// Where the scene lies and how it is seen: perspective, z up, nothing cut.

#include <Eigen/Geometry>
#include <vector>

#include "sculpt/renderer.h"

namespace argil::view {

/// Pictures are drawn in coordinates where the scene has its middle at 0 and fits a ball of radius 1, so that a
/// model of 1e-6 m and one of 1e6 m look alike.
struct Place {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double radius = 1;
  Eigen::Vector3f operator()(const Eigen::Vector3f& position) const {
    return ((position.cast<double>() - middle) / radius).cast<float>();
  }
};
[[nodiscard]] Place place_of(const std::vector<Eigen::Vector3f>& positions);

/// Parts of the picture that stay free, as fractions of its width and height.
struct Margins {
  double left = 0.07, right = 0.07, top = 0.07, bottom = 0.07;
};

struct Camera {
  Eigen::Matrix4f clip_from_world = Eigen::Matrix4f::Identity();
  Eigen::Matrix3f view_from_world = Eigen::Matrix3f::Identity();  // x right, y up, z towards the eye
  Eigen::Vector3f eye = Eigen::Vector3f::UnitZ();
  float nearest = 0, farthest = 1;   // distances of the scene along the view
  float pixel_at_unit_distance = 0;  // size of a pixel at distance 1

  /// Pixel coordinates from the top left corner.
  [[nodiscard]] Eigen::Vector2f pixel(const Eigen::Vector3f& position, int width, int height) const;
  [[nodiscard]] float distance(const Eigen::Vector3f& position) const;
};

/// The nearest camera in the direction of options.view_from from which all `positions` (in picture coordinates) lie
/// within the margins, in their middle; zoom then magnifies about the middle of the free part.
[[nodiscard]] Camera framing_camera(const std::vector<Eigen::Vector3f>& positions,
                                    const sculpt::PictureOptions& options, const Margins& margins);

}  // namespace argil::view
