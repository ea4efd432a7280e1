#pragma once
// Energy by kind, momentum and reactions of a body, from its control points. Sums run over control points in their
// order, so that they are the same bits wherever the arrays lie.

#include <span>

#include "fem/system.h"

namespace argil::fem {

struct Energy {
  double kinetic = 0, elastic = 0;  // [J]
};
[[nodiscard]] Energy energy(const System& system, const BodyState& state);

/// Energy of the springs, tools' and soft pins' [J].
[[nodiscard]] double spring_energy(std::span<const AnchorSpring> springs, const Eigen::Matrix3Xd& positions);
/// Potential of the dead loads, gravity among them, 0 at rest: −Σ f · (p − P) [J]. What they have done to the body
/// is its opposite. Pressure that follows the body has none; it counts as if it were dead.
[[nodiscard]] double load_potential(const Loads& loads, const Eigen::Matrix3Xd& rest,
                                    const Eigen::Matrix3Xd& positions);

struct Momentum {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   // [kg m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  // about the origin [kg m²/s]
};
/// ∫ρv and ∫ρ x × v of the interpolated fields, exactly.
[[nodiscard]] Momentum momentum(const System& system, const BodyState& state);

struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // about the origin [N m]
};
/// Sum of forces on control points (3 x N) and of their moments; as A is linearly precise, that is the moment of
/// what they do to the body. `chosen` names control points, ascending.
[[nodiscard]] Wrench wrench(const Eigen::Matrix3Xd& forces, const Eigen::Matrix3Xd& positions);
[[nodiscard]] Wrench wrench(const Eigen::Matrix3Xd& forces, const Eigen::Matrix3Xd& positions,
                            std::span<const std::uint32_t> chosen);
/// What springs apply to the body.
[[nodiscard]] Wrench wrench(std::span<const AnchorSpring> springs, const Eigen::Matrix3Xd& positions);

}  // namespace argil::fem
