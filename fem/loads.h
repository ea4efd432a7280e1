#pragma once
// Loads as generalised forces on the control points, always Aᵀ∫ Nᵀ t over what they cover, never on one vertex; and
// where a tool or a point force takes hold, as affine stencils of control points.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "fem/discretization.h"
#include "fem/system.h"

namespace argil::fem {

/// Quadrilaterals of the boundary of the finest level, corners as rows of the node table, counter-clockwise from
/// outside. Integrated by 2×2 Gauss over the bilinear surface through the corners.
struct SurfacePatch {
  std::vector<std::array<std::uint32_t, 4>> quads;
};

/// `faces` of refinement.solid(), each a quadrilateral of the boundary. @throws Error (bad_input) naming
/// a face that is not.
[[nodiscard]] SurfacePatch surface_patch(const Discretization& discretization, const subdiv::Solid& finest,
                                         std::span<const subdiv::FaceId> faces);
[[nodiscard]] SurfacePatch whole_surface(const Discretization& discretization, const subdiv::Solid& finest);

/// Area [m²] with the nodes at `nodes` (3 x nodes of the table).
[[nodiscard]] double area(const SurfacePatch& patch, const Eigen::Matrix3Xd& nodes);

// All results are 3 x control points [N].

/// M̃ 1 g, `acceleration` in [m/s²].
[[nodiscard]] Eigen::Matrix3Xd gravity_forces(const Discretization& discretization,
                                              const Eigen::Vector3d& acceleration);
/// Dead traction [Pa] per unit area of the surface at `nodes` (usually the rest nodes).
[[nodiscard]] Eigen::Matrix3Xd traction_forces(const Discretization& discretization, const SurfacePatch& patch,
                                               const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& traction);
/// Pressure [Pa], pushing inwards, on the surface as it stands at `nodes`; to be taken anew where it follows the
/// body.
[[nodiscard]] Eigen::Matrix3Xd pressure_forces(const Discretization& discretization, const SurfacePatch& patch,
                                               const Eigen::Matrix3Xd& nodes, double pressure);
/// `force` [N] in total, spread over the patch by its area at `nodes`. @throws Error (bad_input) if it has none.
[[nodiscard]] Eigen::Matrix3Xd spread_force(const Discretization& discretization, const SurfacePatch& patch,
                                            const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& force);

/// `force` [N] in total, spread by volume over elements: marks[block][element] is 1 for those. @throws Error
/// (bad_input) if they have no volume. Cost O(quadrature points).
[[nodiscard]] Eigen::Matrix3Xd body_forces(const Discretization& discretization,
                                           const std::vector<std::vector<std::uint8_t>>& marks,
                                           const Eigen::Vector3d& force);

/// A point of the body as an affine combination of control points (weights sum to one), ascending.
struct PointStencil {
  std::vector<std::uint32_t> control_points;
  std::vector<double> weights;
};
[[nodiscard]] Eigen::Vector3d position(const PointStencil& point, const Eigen::Matrix3Xd& control_points);
/// A force [N] there: weights · force.
[[nodiscard]] Eigen::Matrix3Xd point_forces(const PointStencil& point, std::size_t control_point_count,
                                            const Eigen::Vector3d& force);
/// A spring that draws it to `target`.
[[nodiscard]] AnchorSpring anchor_spring(const PointStencil& point, const Eigen::Vector3d& target,
                                         double stiffness);

/// A material point: an element and its coordinates.
struct MaterialPoint {
  std::size_t block = 0, element = 0;
  Eigen::Vector3d uvw = Eigen::Vector3d::Zero();
  PointStencil stencil;
};
/// The material point at a rest position, in the first element that holds it (to 1e-9 of its coordinates).
/// @throws Error (not_found) if no element does. Cost O(elements).
[[nodiscard]] MaterialPoint locate(const Discretization& discretization, const Eigen::Vector3d& rest_point);

enum class Falloff { constant, linear, smooth };  // over s = distance / radius: 1, 1 − s, (1 − s²)²

struct Brush {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // [m]
  double radius = 0;                                 // [m]
  Falloff falloff = Falloff::smooth;
};
/// What a brush touches, as the mean of the surface weighted by falloff and area: a tool's force or spring acts on
/// all of it. Distances are straight, from `nodes` (present or rest). A brush that meets no quadrature point is
/// widened to 1.5 times the distance to the nearest one. @throws Error (bad_input) for an empty patch or a radius
/// that is not positive.
[[nodiscard]] PointStencil brush_stencil(const Discretization& discretization, const SurfacePatch& patch,
                                         const Eigen::Matrix3Xd& nodes, const Brush& brush);

}  // namespace argil::fem
