#pragma once
// The seam behind which every force tool stands (papers/004 §4.1): it takes hold of a part of the body, and for
// each step of a stroke says which springs and forces act, from where the device is and how the body lies. What it
// touches is weighted by falloff and by area (inside: by volume), and its forces enter by virtual work, Aᵀ∫Nᵀt, so
// that none acts on one vertex.

#include <memory>

#include "fem/measure/energy.h"
#include "fem/system.h"
#include "sculpt/document.h"
#include "sculpt/stroke_pose.h"

namespace argil::sculpt {

/// Force on the device [N], and its derivative by the device's position [N/m].
struct Felt {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();
};

class ForceTool {
 public:
  virtual ~ForceTool() = default;

  /// To be called once before each step, in order, with the step's device and body: a tool may take new hold or
  /// count turns. What it does depends on these calls only.
  virtual void follow(const StrokePose& pose, const Document& document) {
    (void)pose;
    (void)document;
  }

  /// What acts on the body at these control points [m]. Springs are implicit in the step; while a tool holds the
  /// same points they keep stencils and stiffness, so that solvers keep what they made for them.
  [[nodiscard]] virtual fem::Loads loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const = 0;

  /// The middle of what it touches [m].
  [[nodiscard]] virtual Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const = 0;

  /// The force on the body in all [N]; the device feels its opposite.
  [[nodiscard]] virtual Eigen::Vector3d force(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const {
    return wrench(pose, positions).force;
  }
  /// That force changes with the device's position so much in any direction, at full pressure [N/m].
  [[nodiscard]] virtual double stiffness() const { return 0; }
  /// What the device feels at the pose; by default the opposite of that force.
  [[nodiscard]] virtual Felt felt(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const {
    return {-force(pose, positions), -pose.pressure * stiffness() * Eigen::Matrix3d::Identity()};
  }

  /// Force, and moment about the origin, of what `loads` gives.
  [[nodiscard]] fem::Wrench wrench(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const;
};

/// What a stroke may ask of a tool beside its settings.
struct GripOptions {
  bool invert = false;  // the opposite: deflate for inflate, push for pull, …
  bool inside = false;  // take what is within the radius inside the solid, even where its surface is as near
  int mirror = -1;  // axis that the poses are mirrored along, of a tool that is another's mirror image; else −1
};

/// The middle of the rest shape's bounding box along an axis: where mirror images are mirrored [m].
[[nodiscard]] double mirror_plane(const Document& document, int axis);
/// The mirror image of a pose in that plane.
[[nodiscard]] StrokePose mirrored(const StrokePose& pose, int axis, double plane);

/// The tool of these settings, taking hold at `first`.
/// @throws Error (bad_input) if it touches nothing there, (not_found) for a name that is none of a force tool.
[[nodiscard]] std::unique_ptr<ForceTool> take_hold(const Document& document, const Tool& tool,
                                                   const StrokePose& first, const GripOptions& options);

/// Force and moment about the origin of forces and springs, whatever the weights of a spring sum to (those between
/// parts of the body sum to zero).
[[nodiscard]] fem::Wrench wrench_of(const fem::Loads& loads, const Eigen::Matrix3Xd& positions);

/// Adds forces and springs.
void add_loads(fem::Loads& to, const fem::Loads& loads);

}  // namespace argil::sculpt
