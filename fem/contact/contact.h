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
//   Fast points: one that could cross more than a quarter of an obstacle's thickness in the step, going on as it
//   does, is met by the plane at which it would enter, however far beyond it is at the end, and keeps that entry
//   (ContactGrip) until it is out again or as deep as the obstacle's nearest side can tell. What is slower never
//   skips a side, and no law of it changes.

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
  /// Of the spring of friction, if it gives way at a force (Huber's function of its length) [J].
  [[nodiscard]] double friction_energy(double at_limit) const;
  /// What of the stretch the spring does not hold [m].
  [[nodiscard]] double slid() const;
  [[nodiscard]] Eigen::Vector3d force() const;  // on the body [N]
  /// Its derivative −∂f/∂x as add_product() takes it [N/m].
  [[nodiscard]] Eigen::Matrix3d tangent() const;
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
  /// The control points that what touches depends on, ascending, and the same matrix in them (3 a point; they must
  /// be all of them).
  [[nodiscard]] std::vector<std::uint32_t> touched_control_points() const;
  [[nodiscard]] Eigen::MatrixXd stiffness(const std::vector<std::uint32_t>& control_points) const;
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
  const ContactGrip* held(std::size_t obstacle, std::size_t point) const;
  SignedDistance distance(std::size_t obstacle, std::size_t point, const Eigen::Vector3d& own) const;
  void find_entries();
  std::optional<Entry> entry_kept(std::size_t obstacle, std::size_t point, const Eigen::Vector3d& own) const;
  std::vector<ContactGrip> grips_without_friction() const;
  void take_entry(std::size_t obstacle, std::size_t point, const Entry& entry);

  const Contact* contact_;
  const BodyState* begin_;
  std::vector<ObstaclePose> now_, before_;
  double length_ = 0;  // of the step until here [s]
  Eigen::Matrix3Xd begin_points_, points_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> entry_of_;  // [obstacle * points + point] its place in entries_ from 1; empty: none
  std::vector<double> allowed_;          // [obstacle * points + point] depth that does not count [m]; empty: none
  std::vector<Touch> touches_;
  std::vector<double> limits_;  // [obstacle * points + point]
};

/// How far a body reaches into an obstacle.
struct Overlap {
  std::size_t points = 0;
  double depth = 0;  // of the deepest [m]
};
[[nodiscard]] Overlap overlap(const Contact& contact, const BodyState& state, std::uint32_t id);
/// Lets the points that are in an obstacle now be as deep as they are, less with time until all are out `duration`
/// [s] from now: they are pushed out no faster than that asks for, instead of by the force of their depth.
void allow_overlap(const Contact& contact, BodyState& state, std::uint32_t id, double duration);

/// What contact stores in a state as it stands, at depth and in the springs of friction [J].
[[nodiscard]] double stored_energy(const Contact& contact, const BodyState& state);
/// What friction takes in a step for good [J]: where the end of a spring slides, its force times the way; where a
/// point has let go, what its spring stored. As if the step had been taken in one.
[[nodiscard]] double friction_loss(const Contact& contact, const BodyState& begin, const BodyState& end);
/// Contact forces [N] with a state as it stands, 3 x control points; zero without contact.
[[nodiscard]] Eigen::Matrix3Xd contact_forces(const Contact& contact, const BodyState& state);
/// Force, and moment about the origin, on the body; of one obstacle by its id, or of all (id 0).
[[nodiscard]] Wrench contact_wrench(const Contact& contact, const BodyState& state, std::uint32_t id = 0);

}  // namespace argil::fem
