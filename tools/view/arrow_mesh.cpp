#include "tools/view/arrow_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace argil::view {

namespace {

constexpr int k_sides = 20;
constexpr float k_shaft_radius = 2.1F, k_cone_radius = 7.6F, k_cone_length = 20.0F;  // pixels

}  // namespace

void add_arrow(std::vector<ArrowVertex>& triangles, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
               const Camera& camera, float pixel) {
  const float length = (to - from).norm();
  if (!(length > 0)) return;
  const Eigen::Vector3f along = (to - from) / length, side = along.unitOrthogonal(), other = along.cross(side);
  const float unit = pixel * std::max(camera.distance(to), 0.05F);
  const float shrink = std::min(1.0F, 0.6F * length / (k_cone_length * unit));
  const float cone_length = k_cone_length * unit * shrink, cone_radius = k_cone_radius * unit * shrink;
  const float shaft_radius = k_shaft_radius * unit * std::sqrt(shrink);
  const Eigen::Vector3f neck = to - cone_length * along;
  const Eigen::Vector2f slant = Eigen::Vector2f(cone_length, cone_radius).normalized();

  const auto spoke = [&](int i) -> Eigen::Vector3f {
    const auto turn = static_cast<float>(2 * M_PI * i / k_sides);
    return std::cos(turn) * side + std::sin(turn) * other;
  };
  const auto add = [&](const std::array<ArrowVertex, 3>& corners) {
    triangles.insert(triangles.end(), corners.begin(), corners.end());
  };
  for (int i = 0; i < k_sides; ++i) {
    const Eigen::Vector3f a = spoke(i), b = spoke(i + 1);
    const ArrowVertex tail_a{from + shaft_radius * a, a}, tail_b{from + shaft_radius * b, b};
    const ArrowVertex neck_a{neck + shaft_radius * a, a}, neck_b{neck + shaft_radius * b, b};
    add({tail_a, tail_b, neck_b});
    add({tail_a, neck_b, neck_a});
    add({ArrowVertex{from, -along}, {tail_b.position, -along}, {tail_a.position, -along}});
    const Eigen::Vector3f base_a = neck + cone_radius * a, base_b = neck + cone_radius * b;
    const Eigen::Vector3f slope_a = slant.x() * a + slant.y() * along, slope_b = slant.x() * b + slant.y() * along;
    add({ArrowVertex{base_a, slope_a}, {base_b, slope_b}, {to, (slope_a + slope_b).normalized()}});
    add({ArrowVertex{neck, -along}, {base_b, -along}, {base_a, -along}});
  }
}

}  // namespace argil::view
