#pragma once
// Rigid motions that nothing holds: what makes a static problem have no answer.

#include <Eigen/Core>
#include <vector>

#include "fem/system.h"

namespace argil::fem {

/// @throws Error (bad_input) if pins and springs leave a part of the body (control points that elements connect)
/// free to move rigidly and `forces` (3 x control points, generalised) push along that motion; the message says
/// what to pin. `touched` per control point: an element depends on it. Linearised at `positions`.
void check_rigid_motions(const System& system, const Loads& loads, const std::vector<std::uint8_t>& touched,
                         const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& forces);

}  // namespace argil::fem
