#pragma once
// Energy and momentum of a body, from its control points.

#include "fem/system.h"

namespace argil::fem {

struct Energy {
  double kinetic = 0, elastic = 0;  // [J]
};
[[nodiscard]] Energy energy(const System& system, const BodyState& state);

struct Momentum {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   // [kg m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  // about the origin [kg m²/s]
};
/// ∫ρv and ∫ρ x × v of the interpolated fields, exactly.
[[nodiscard]] Momentum momentum(const System& system, const BodyState& state);

}  // namespace argil::fem
