#pragma once
// The loads of a document as the integrator takes them, and places in its body by their rest position.

#include <string>
#include <vector>

#include "fem/loads.h"
#include "sculpt/document.h"

namespace argil::sculpt {

/// Gravity and applied forces as generalised forces, soft pins as springs: what lasts, and by which weights of the
/// control points what is keyed changes with time.
class DocumentLoads {
 public:
  /// Pressures act where the control points have the surface, of the discretization that this was made of.
  [[nodiscard]] fem::Loads at(double time, const fem::Discretization& discretization,
                              const Eigen::Matrix3Xd& control_points) const;
  [[nodiscard]] bool change() const { return !keyed_.empty() || !led_.empty() || !pressures_.empty(); }
  /// Whether they depend on where the body is.
  [[nodiscard]] bool follow() const { return !pressures_.empty(); }

 private:
  friend DocumentLoads document_loads(const Document& document);
  struct KeyedForce {
    Track track;
    Eigen::VectorXd weights;  // of the control points
  };
  struct Pressure {
    AppliedPressure applied;
    fem::SurfacePatch patch;
  };
  struct LedSpring {
    std::size_t spring, motion;
  };
  fem::Loads lasting_;
  std::vector<KeyedForce> keyed_;
  std::vector<Pressure> pressures_;
  std::vector<LedSpring> led_;
  std::vector<PinMotion> motions_;
};
/// @throws Error (bad_input) if a force acts at a point that is not in the body. Cost O(solid); `at` then costs
/// O(control points · keyed forces).
[[nodiscard]] DocumentLoads document_loads(const Document& document);

/// Where the pins that keys lead are to be at the end of a step that takes the body from `motion` to `time`.
[[nodiscard]] fem::LedPoints led_points(const Pins& pins, const fem::BodyState& motion, double time);
/// The target of a soft pin of a motion at a time, and the one that it has to have so that it is at `target` then.
[[nodiscard]] Eigen::Vector3d led_target(const PinMotion& motion, const Eigen::Vector3d& target, double time);
[[nodiscard]] Eigen::Vector3d target_before(const PinMotion& motion, const Eigen::Vector3d& led, double time);
/// The motion that leads a vertex or node; null: none.
[[nodiscard]] const PinMotion* motion_of(const Pins& pins, ElementType type, std::uint32_t id);
/// What acts now: the value of its track, or its own.
[[nodiscard]] Eigen::Vector3d force_at(const AppliedForce& force, double time);
[[nodiscard]] Eigen::Vector3d gravity_at(const AppliedLoads& loads, double time);
[[nodiscard]] double pressure_at(const AppliedPressure& pressure, double time);  // [Pa]
/// Of the painted prestress that acts.
[[nodiscard]] double prestress_share_at(const AppliedLoads& loads, double time);

/// The material point at a rest position. @throws Error (bad_input) if it lies outside, with the remedy.
[[nodiscard]] fem::MaterialPoint material_point(const Document& document, const Eigen::Vector3d& rest_position);

/// Boundary faces of the finest level that came from these control faces, ascending.
[[nodiscard]] std::vector<subdiv::FaceId> finest_faces(const subdiv::Refinement& refinement,
                                                       const std::vector<std::uint32_t>& control_faces);

/// smooth, linear or constant.
[[nodiscard]] fem::Falloff falloff_by_word(const std::string& word);
/// Weight of a brush at distance / radius.
[[nodiscard]] double falloff_weight(fem::Falloff falloff, double distance_ratio);

}  // namespace argil::sculpt
