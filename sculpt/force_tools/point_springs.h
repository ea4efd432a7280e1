#pragma once
// Springs of all touched points, each of its share of a strength: what tools that move a patch as they please are
// made of.

#include "fem/system.h"
#include "sculpt/force_tools/touched.h"

namespace argil::sculpt {

/// A spring from each point to its column of `targets`; `pressure` scales the forces now, and they are cut where
/// their sizes sum to more than `limit` [N]. Stencils and stiffness depend on `touched` and `strength` only.
[[nodiscard]] fem::Loads point_springs(const Touched& touched, const Eigen::Matrix3Xd& positions,
                                       const Eigen::Matrix3Xd& targets, double strength, double pressure,
                                       double limit);

}  // namespace argil::sculpt
