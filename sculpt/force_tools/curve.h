#pragma once
// Sculpting by a curve (papers/004, Fig. 9): a clamped uniform cubic B-spline laid on the boundary through given
// points, its handles. Moving handle I by d moves the curve by L_I(t) d, L_I the spline that is 1 at handle I and 0
// at the others; boundary points within the tool's radius of the curve follow what is nearest to them on it, by
// springs weighted by falloff. Where L_I is small the curve holds the body in place.

#include <vector>

#include "sculpt/force_tools/force_tool.h"

namespace argil::sculpt {

/// Degree 3, or the number of points less one if there are fewer than four; knots uniform, clamped at the ends;
/// handle i at parameter_of(i), its Greville abscissa.
class HandleCurve {
 public:
  /// @throws Error (bad_input) for fewer than two points or neighbours that coincide.
  explicit HandleCurve(std::vector<Eigen::Vector3d> through);

  std::size_t handle_count() const { return through_.size(); }
  const Eigen::Vector3d& handle(std::size_t i) const { return through_[i]; }
  double end() const { return knots_.back(); }
  [[nodiscard]] double parameter_of(std::size_t handle) const;
  /// At t in [0, end()] [m]: for a window to draw.
  [[nodiscard]] Eigen::Vector3d point(double t) const;
  /// L_i(t) of all handles.
  [[nodiscard]] Eigen::VectorXd influences(double t) const;

 private:
  Eigen::VectorXd basis(double t) const;

  std::vector<Eigen::Vector3d> through_;
  int degree_;
  std::vector<double> knots_;
  Eigen::MatrixXd control_from_handles_;
};

/// Handle `handle` follows the device, which takes hold at `first`.
/// @throws Error (bad_input) for a handle that there is not, or if the surface is not within the radius of it.
[[nodiscard]] std::unique_ptr<ForceTool> take_curve(const Document& document, const Tool& tool,
                                                    const HandleCurve& curve, std::size_t handle,
                                                    const StrokePose& first);

}  // namespace argil::sculpt
