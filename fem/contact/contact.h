#pragma once
// Contact of a body with obstacles, one-sided, by virtual work at the points of contact_surface.h.
//   Normal: a point at depth d > 0 stores ½ k a d², k the stiffness [Pa/m], a its area; nothing acts before
//   contact. Friction (Coulomb): a spring of the same stiffness draws it along the surface to its anchor, the place
//   of the
// obstacle where it touched first (where it stood when the step began). Beyond μ times the normal force the anchor
// follows. What sticks therefore does not creep: it stands k⁻¹ times the shear stress away from its anchor.
// Anchors lie in the obstacle's frame, so that a moving obstacle drags what it holds.
// Both are implicit: forces are those at the end of a step, where the obstacles are then. The tangent is symmetric:
// it takes the normal force in the limit of friction as it is (its change with depth enters with the next
// iteration) and leaves out the curvature of the obstacle, which would soften the contact.

#include <memory>
#include <vector>

#include "fem/contact/contact_surface.h"
#include "fem/contact/obstacle.h"
#include "fem/measure/energy.h"
#include "fem/system.h"

namespace argil::fem {

struct Contact {
  std::shared_ptr<const ContactSurface> surface;
  std::vector<Obstacle> obstacles;  // by id, ascending
};

/// A point that touches.
struct Touch {
  std::uint32_t obstacle = 0, point = 0;  // places in Contact::obstacles and in the surface
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d stretch = Eigen::Vector3d::Zero();  // of the spring of friction, along the surface [m]
  double depth = 0, stiffness = 0;                    // [m], [N/m]
  double limit = 0;                                   // of friction: μ times the normal force [N]
  [[nodiscard]] bool slips() const;
  [[nodiscard]] Eigen::Vector3d force() const;  // on the body [N]
};

/// Contact in one step, with the obstacles where they are at one time.
class ContactStep {
 public:
  /// `begin` is the state before the step; both must outlive this.
  ContactStep(const Contact& contact, const BodyState& begin, double time);

  /// Finds what touches with the control points there. Cost O(points · obstacles), in parallel.
  void set_state(const Eigen::Matrix3Xd& positions);
  /// What was found, by obstacle and point.
  [[nodiscard]] const std::vector<Touch>& touches() const { return touches_; }
  /// Adds its forces on the control points [N].
  void add_forces(Eigen::Matrix3Xd& forces) const;
  /// Adds their derivative, −∂f/∂p · direction; symmetric and positive semi-definite.
  void add_product(const Eigen::Matrix3Xd& direction, Eigen::Matrix3Xd& result) const;
  /// Per control point the largest that its own block of that matrix can be [N/m].
  [[nodiscard]] Eigen::VectorXd diagonal() const;
  /// Energy [J] with the control points elsewhere, friction up to the limits found by set_state(): its gradient
  /// there is what add_forces() gives, but for what the turning of a curved obstacle's normal adds to friction.
  [[nodiscard]] double energy(const Eigen::Matrix3Xd& positions) const;
  /// What a state has that ends the step where set_state() was called.
  [[nodiscard]] std::vector<ContactGrip> grips() const;
  /// A spring at every point that touches, as stiff in all directions: for preconditioners.
  [[nodiscard]] std::vector<AnchorSpring> springs() const;

 private:
  Touch touch(std::size_t obstacle, std::size_t point, const Eigen::Vector3d& x, const SignedDistance& own) const;

  const Contact* contact_;
  const BodyState* begin_;
  std::vector<ObstaclePose> now_, before_;
  Eigen::Matrix3Xd begin_points_;
  std::vector<Touch> touches_;
  std::vector<double> limits_;  // [obstacle * points + point]
};

/// Contact forces [N] with a state as it stands, 3 x control points; zero without contact.
[[nodiscard]] Eigen::Matrix3Xd contact_forces(const Contact& contact, const BodyState& state);
/// Force, and moment about the origin, on the body; of one obstacle by its id, or of all (id 0).
[[nodiscard]] Wrench contact_wrench(const Contact& contact, const BodyState& state, std::uint32_t id = 0);

}  // namespace argil::fem
