#pragma once
// The linear part of how a touched patch lies: the fit x_i ≈ c + Σ shape_a(i) e_a, with shapes that grow along two
// tangents (inside the solid: three axes) from the middle of the patch, orthonormal under its weights. So
//   e_a = Σ w_i shape_a(i) x_i
// is a stencil whose weights sum to zero: a spring on it makes no net force, whatever it does in a step. A force
// G_a on each is the force w_i Σ shape_a(i) G_a at the points, with the moment Σ e_a × G_a.

#include "fem/system.h"
#include "sculpt/force_tools/touched.h"

namespace argil::sculpt {

struct PatchModes {
  std::vector<fem::PointStencil> stencils;
  std::vector<Eigen::VectorXd> shapes;  // per point
  Eigen::Matrix3Xd at_hold;             // e_a [m]
};

/// What is touched around `at` with its modes; a brush that holds too few points for them is widened.
/// @throws Error (bad_input) as touch() does.
struct TouchedPatch {
  Touched touched;
  PatchModes modes;
};
[[nodiscard]] TouchedPatch touch_patch(const Document& document, Tool tool, const Eigen::Vector3d& at, bool inside);

[[nodiscard]] Eigen::Matrix3Xd mode_vectors(const PatchModes& modes, const Eigen::Matrix3Xd& positions);
/// Normal of the plane of the first two modes: that of the patch as it lies now.
[[nodiscard]] Eigen::Vector3d mode_normal(const Eigen::Matrix3Xd& vectors);

/// Springs of this stiffness [N/m] that now pull with the mode forces `forces` (3 x modes) [N], cut where the sizes
/// of the forces at the points sum to more than `limit`.
[[nodiscard]] fem::Loads mode_loads(const TouchedPatch& patch, const Eigen::Matrix3Xd& vectors,
                                    const Eigen::Matrix3Xd& forces, double stiffness, double limit);

/// To the right of who looks at a surface with this normal and has z upwards; x where the normal is along z.
[[nodiscard]] Eigen::Vector3d rightwards(const Eigen::Vector3d& normal);

}  // namespace argil::sculpt
