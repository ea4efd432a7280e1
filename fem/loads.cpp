#include "fem/loads.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/parallel.h"
#include "fem/surface_points.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::fem {

namespace {

/// Aᵀ of a force at one node, added to the control points' forces.
void scatter(const subdiv::Stencils& rows, std::uint32_t node, const Eigen::Vector3d& force,
             Eigen::Matrix3Xd& forces) {
  const auto row = rows.row(node);
  for (std::size_t e = 0; e < row.columns.size(); ++e)
    forces.col(static_cast<Eigen::Index>(row.columns[e])) += row.weights[e] * force;
}

Eigen::Matrix3Xd no_forces(const Discretization& discretization) {
  return Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(discretization.nodes.rows.column_count));
}

/// Integrates a traction, given per point as force = traction(area vector).
template <class Traction>
Eigen::Matrix3Xd surface_forces(const Discretization& discretization, const SurfacePatch& patch,
                                const Eigen::Matrix3Xd& nodes, const Traction& traction) {
  Eigen::Matrix3Xd result = no_forces(discretization);
  for_each_surface_point(patch, nodes, [&](const std::array<std::uint32_t, 4>& quad, const SurfacePoint& point) {
    const Eigen::Vector3d force = traction(point.area_vector);
    for (std::size_t c = 0; c < 4; ++c)
      scatter(discretization.nodes.rows, quad[c], point.shapes[c] * force, result);
  });
  return result;
}

/// Σ node weight · row, as a stencil.
PointStencil stencil_of_nodes(const subdiv::Stencils& rows, std::span<const std::uint32_t> nodes,
                              std::span<const double> node_weights) {
  std::vector<double> weights(rows.column_count, 0.0);
  PointStencil result;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto row = rows.row(nodes[n]);
    for (std::size_t e = 0; e < row.columns.size(); ++e)
      weights[row.columns[e]] += node_weights[n] * row.weights[e];
    result.control_points.insert(result.control_points.end(), row.columns.begin(), row.columns.end());
  }
  std::sort(result.control_points.begin(), result.control_points.end());
  result.control_points.erase(std::unique(result.control_points.begin(), result.control_points.end()),
                              result.control_points.end());
  for (const std::uint32_t c : result.control_points) result.weights.push_back(weights[c]);
  return result;
}

/// Element coordinates of a point by Newton's method; false if they do not lie in [0, 1]³.
bool element_coordinates(const ElementKind& kind, const Eigen::Matrix3Xd& corners, const Eigen::Vector3d& point,
                         Eigen::Vector3d& uvw, Eigen::VectorXd& shapes) {
  constexpr int k_iterations = 30;
  constexpr double k_outside = 1e-9;
  const double size = (corners.rowwise().maxCoeff() - corners.rowwise().minCoeff()).norm();
  Eigen::Matrix3Xd gradients;
  // Not the middle of the pyramid's axis: its map is singular at the apex only, and Newton stays away from it.
  uvw = Eigen::Vector3d(0.5, 0.5, 0.4);
  for (int i = 0; i < k_iterations; ++i) {
    kind.evaluate(uvw, shapes, gradients);
    const Eigen::Vector3d difference = point - corners * shapes;
    if (difference.norm() <= 1e-12 * size) return uvw.minCoeff() >= -k_outside && uvw.maxCoeff() <= 1 + k_outside;
    const Eigen::Matrix3d jacobian = corners * gradients.transpose();
    const Eigen::Vector3d move = jacobian.partialPivLu().solve(difference);
    if (!move.allFinite()) return false;
    uvw = (uvw + move).cwiseMax(-1.0).cwiseMin(2.0);
  }
  return false;
}

}  // namespace

SurfacePatch surface_patch(const Discretization& discretization, const subdiv::Solid& finest,
                           std::span<const subdiv::FaceId> faces) {
  SurfacePatch result;
  for (const subdiv::FaceId f : faces) {
    if (!finest.is_live(f) || !finest.is_boundary(f))
      throw Error(ErrorCode::bad_input, "Surface loads act on boundary faces; this face is not one of them.",
                  fmt::format("face {}", f.value));
    const auto loop = subdiv::use_vertices(finest, finest.boundary_use(f));
    if (loop.size() != 4)
      throw Error(
          ErrorCode::bad_input,
          fmt::format("Surface loads are spread over quadrilaterals, and this face has {} corners. Refine at "
                      "least once: levels 1.",
                      loop.size()),
          fmt::format("face {}", f.value));
    std::array<std::uint32_t, 4>& quad = result.quads.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) quad[c] = discretization.surface_node_from_vertex[loop[c].index()];
  }
  return result;
}

SurfacePatch whole_surface(const Discretization& discretization, const subdiv::Solid& finest) {
  std::vector<subdiv::FaceId> faces;
  for (const subdiv::FaceId f : finest.faces())
    if (finest.is_boundary(f)) faces.push_back(f);
  return surface_patch(discretization, finest, faces);
}

double area(const SurfacePatch& patch, const Eigen::Matrix3Xd& nodes) {
  double sum = 0;
  for_each_surface_point(patch, nodes,
                         [&](const auto&, const SurfacePoint& point) { sum += point.area_vector.norm(); });
  return sum;
}

Eigen::Matrix3Xd gravity_forces(const Discretization& discretization, const Eigen::Vector3d& acceleration) {
  const Eigen::VectorXd masses = discretization.mass * Eigen::VectorXd::Ones(discretization.mass.cols());
  return acceleration * masses.transpose();
}

Eigen::Matrix3Xd traction_forces(const Discretization& discretization, const SurfacePatch& patch,
                                 const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& traction) {
  return surface_forces(discretization, patch, nodes, [&](const Eigen::Vector3d& area_vector) {
    return Eigen::Vector3d(area_vector.norm() * traction);
  });
}

Eigen::Matrix3Xd pressure_forces(const Discretization& discretization, const SurfacePatch& patch,
                                 const Eigen::Matrix3Xd& nodes, double pressure) {
  return surface_forces(discretization, patch, nodes, [&](const Eigen::Vector3d& area_vector) {
    return Eigen::Vector3d(-pressure * area_vector);
  });
}

Eigen::Matrix3Xd spread_force(const Discretization& discretization, const SurfacePatch& patch,
                              const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& force) {
  const double total = area(patch, nodes);
  if (!(total > 0))
    throw Error(ErrorCode::bad_input,
                "A force spread over a region needs a region with area, but the one selected has none. Select at "
                "least one boundary face.");
  return traction_forces(discretization, patch, nodes, force / total);
}

Eigen::Matrix3Xd body_forces(const Discretization& discretization,
                             const std::vector<std::vector<std::uint8_t>>& marks, const Eigen::Vector3d& force) {
  // ∫ N over the marked elements, by node: their sum is the volume.
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(discretization.rest_nodes.cols());
  double total = 0;
  for (std::size_t b = 0; b < discretization.blocks.size(); ++b) {
    const ElementBlock& block = discretization.blocks[b];
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    for (std::size_t e = 0; e < block.element_count(); ++e) {
      if (!marks[b][e]) continue;
      for (int q = 0; q < block.kind->point_count; ++q) {
        const double volume = block.volumes[block.point_index(e, q)];
        const double* shapes = block.kind->shapes.data() + static_cast<std::size_t>(q) * n;
        for (std::size_t a = 0; a < n; ++a) shares[block.nodes[e * n + a]] += volume * shapes[a];
        total += volume;
      }
    }
  }
  if (!(total > 0))
    throw Error(
        ErrorCode::bad_input,
        "A force spread through cells needs cells with volume, but those selected have none. Select at least "
        "one cell.");
  Eigen::Matrix3Xd result = no_forces(discretization);
  for (Eigen::Index node = 0; node < shares.size(); ++node)
    if (shares[node] != 0)
      scatter(discretization.nodes.rows, static_cast<std::uint32_t>(node), (shares[node] / total) * force, result);
  return result;
}

Eigen::Vector3d position(const PointStencil& point, const Eigen::Matrix3Xd& control_points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t e = 0; e < point.control_points.size(); ++e)
    sum += point.weights[e] * control_points.col(static_cast<Eigen::Index>(point.control_points[e]));
  return sum;
}

Eigen::Matrix3Xd point_forces(const PointStencil& point, std::size_t control_point_count,
                              const Eigen::Vector3d& force) {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(control_point_count));
  for (std::size_t e = 0; e < point.control_points.size(); ++e)
    result.col(static_cast<Eigen::Index>(point.control_points[e])) += point.weights[e] * force;
  return result;
}

AnchorSpring anchor_spring(const PointStencil& point, const Eigen::Vector3d& target, double stiffness) {
  return {point.control_points, point.weights, target, stiffness};
}

MaterialPoint locate(const Discretization& discretization, const Eigen::Vector3d& rest_point) {
  Eigen::Matrix3Xd corners;
  Eigen::VectorXd shapes;
  MaterialPoint result;
  for (std::size_t b = 0; b < discretization.blocks.size(); ++b) {
    const ElementBlock& block = discretization.blocks[b];
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    corners.resize(3, static_cast<Eigen::Index>(n));
    for (std::size_t e = 0; e < block.element_count(); ++e) {
      const std::span<const std::uint32_t> nodes{block.nodes.data() + e * n, n};
      for (std::size_t a = 0; a < n; ++a)
        corners.col(static_cast<Eigen::Index>(a)) =
            discretization.rest_nodes.col(static_cast<Eigen::Index>(nodes[a]));
      const Eigen::Vector3d low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
      const double margin = 1e-9 * (high - low).norm();
      if (((rest_point - low).array() < -margin).any() || ((high - rest_point).array() < -margin).any()) continue;
      if (!element_coordinates(*block.kind, corners, rest_point, result.uvw, shapes)) continue;
      result.block = b;
      result.element = e;
      result.stencil = stencil_of_nodes(discretization.nodes.rows, nodes,
                                        {shapes.data(), static_cast<std::size_t>(shapes.size())});
      return result;
    }
  }
  throw Error(ErrorCode::not_found,
              fmt::format("A point load needs a point inside the solid at rest, but ({}, {}, {}) is in no element. "
                          "Corners of control cells may lie outside of the refined solid: take a point further in.",
                          rest_point.x(), rest_point.y(), rest_point.z()));
}

PointStencil brush_stencil(const Discretization& discretization, const SurfacePatch& patch,
                           const Eigen::Matrix3Xd& nodes, const Brush& brush) {
  if (patch.quads.empty() || !(brush.radius > 0))
    throw Error(ErrorCode::bad_input,
                fmt::format("A brush needs a surface and a positive radius; found {} faces and radius {} m.",
                            patch.quads.size(), brush.radius));
  double nearest = std::numeric_limits<double>::infinity();
  for_each_surface_point(patch, nodes, [&](const auto&, const SurfacePoint& point) {
    nearest = std::min(nearest, (point.position - brush.centre).norm());
  });
  const double radius = nearest < brush.radius ? brush.radius : 1.5 * nearest;
  std::vector<std::uint32_t> touched;
  std::vector<double> weights;
  double total = 0;
  for_each_surface_point(patch, nodes, [&](const std::array<std::uint32_t, 4>& quad, const SurfacePoint& point) {
    const double s = (point.position - brush.centre).norm() / radius;
    if (s >= 1) return;
    const double falloff = brush.falloff == Falloff::constant ? 1.0
                           : brush.falloff == Falloff::linear ? 1 - s
                                                              : (1 - s * s) * (1 - s * s);
    const double weight = falloff * point.area_vector.norm();
    total += weight;
    for (std::size_t c = 0; c < 4; ++c) {
      touched.push_back(quad[c]);
      weights.push_back(weight * point.shapes[c]);
    }
  });
  if (!(total > 0))
    throw Error(ErrorCode::bad_input, "The surface under the brush has no area. Undo what collapsed it.");
  for (double& w : weights) w /= total;
  return stencil_of_nodes(discretization.nodes.rows, touched, weights);
}

}  // namespace argil::fem
