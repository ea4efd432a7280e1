#pragma once
// The 2×2 Gauss points of boundary quadrilaterals, which loads on the surface are summed over.

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "fem/loads.h"

namespace argil::fem {

/// A quadrature point of a bilinear quadrilateral: shape functions, position, and the outward normal times the area
/// that belongs to it.
struct SurfacePoint {
  std::array<double, 4> shapes{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), area_vector = Eigen::Vector3d::Zero();
};

/// One of the four points of a quadrilateral, `which` = 2 i + j.
inline SurfacePoint surface_point(const std::array<std::uint32_t, 4>& quad, int which,
                                  const Eigen::Matrix3Xd& nodes) {
  const std::array<double, 2> gauss{0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
  const double u = gauss[static_cast<std::size_t>(which / 2)], v = gauss[static_cast<std::size_t>(which % 2)];
  SurfacePoint point;
  point.shapes = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
  const std::array<double, 4> du{-(1 - v), 1 - v, v, -v}, dv{-(1 - u), -u, u, 1 - u};
  Eigen::Vector3d along_u = Eigen::Vector3d::Zero(), along_v = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < 4; ++c) {
    const Eigen::Vector3d x = nodes.col(static_cast<Eigen::Index>(quad[c]));
    point.position += point.shapes[c] * x;
    along_u += du[c] * x;
    along_v += dv[c] * x;
  }
  point.area_vector = 0.25 * along_u.cross(along_v);
  return point;
}

/// Calls visit(quad, SurfacePoint) for the points of every quadrilateral, in order.
template <class Visit>
void for_each_surface_point(const SurfacePatch& patch, const Eigen::Matrix3Xd& nodes, const Visit& visit) {
  for (const auto& quad : patch.quads)
    for (int which = 0; which < 4; ++which) visit(quad, surface_point(quad, which, nodes));
}

}  // namespace argil::fem
