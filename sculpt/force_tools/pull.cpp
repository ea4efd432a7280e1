#include "sculpt/force_tools/pull.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include "sculpt/document_loads.h"

#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length_squared = along.squaredNorm();
  const double t = length_squared > 0 ? std::clamp((p - a).dot(along) / length_squared, 0.0, 1.0) : 0.0;
  return (a + t * along - p).norm();
}

double distance_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const bool above = normal.squaredNorm() > 0 && (b - a).cross(p - a).dot(normal) >= 0 &&
                     (c - b).cross(p - b).dot(normal) >= 0 && (a - c).cross(p - c).dot(normal) >= 0;
  if (above) return std::abs((p - a).dot(normal)) / normal.norm();
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

// Each quadrilateral as four triangles about its middle.
double distance_to_surface(const fem::SurfacePatch& patch, const Eigen::Matrix3Xd& nodes,
                           const Eigen::Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& quad : patch.quads) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t node : quad) middle += nodes.col(node) / 4;
    for (std::size_t i = 0; i < 4; ++i)
      nearest =
          std::min(nearest, distance_to_triangle(p, nodes.col(quad[i]), nodes.col(quad[(i + 1) % 4]), middle));
  }
  return nearest;
}

}  // namespace

PullGrip::PullGrip(const Document& document, const Tool& tool, const Eigen::Vector3d& at)
    : largest_force_(tool.largest_force) {
  const fem::Discretization& d = document.discretization();
  const Eigen::Matrix3Xd nodes = subdiv::apply(d.nodes.rows, document.positions());
  const fem::SurfacePatch surface = fem::whole_surface(d, document.refinement().solid());
  // A brush finer than the mesh is widened until it holds something, so what it touches is asked of the surface
  // itself.
  const double away = distance_to_surface(surface, nodes, at);
  if (away > tool.radius)
    throw Error(
        ErrorCode::bad_input,
        fmt::format(
            "the tool touches nothing at ({:g}, {:g}, {:g}): the surface is {:.3g} m away and its radius is "
            "{:g} m; begin the stroke on the surface or make the radius larger",
            at.x(), at.y(), at.z(), away, tool.radius));
  const fem::Brush brush{at, tool.radius, falloff_by_word(tool.falloff)};
  grip_ = fem::anchor_spring(fem::brush_stencil(d, surface, nodes, brush), at, tool.strength);
  offset_ = held(document.positions()) - at;
}

Eigen::Vector3d PullGrip::held(const Eigen::Matrix3Xd& positions) const {
  return fem::held_point(grip_, positions);
}

fem::AnchorSpring PullGrip::spring(const Eigen::Vector3d& device, const Eigen::Matrix3Xd& positions) const {
  fem::AnchorSpring spring = grip_;
  const Eigen::Vector3d from = held(positions);
  Eigen::Vector3d stretch = device + offset_ - from;
  const double longest = largest_force_ / grip_.stiffness;
  if (stretch.norm() > longest) stretch *= longest / stretch.norm();
  spring.target = from + stretch;
  return spring;
}

Eigen::Vector3d PullGrip::force(const Eigen::Vector3d& device, const Eigen::Matrix3Xd& positions) const {
  const fem::AnchorSpring now = spring(device, positions);
  return now.stiffness * (now.target - held(positions));
}

}  // namespace argil::sculpt
