#pragma once
// Faces over an open loop of edges: one where the loop is nearly flat, else the few nearly flat ones that it
// divides into, so that a notch is closed flush with its sides.

#include <Eigen/Core>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

/// Loops of the faces, running as `loop` does. Up to three new edges divide a loop of up to 24 vertices, as few as
/// will do, and those of them that enclose the most; no new edge stands where the solid has one. The loop itself if
/// that does not suffice.
[[nodiscard]] std::vector<std::vector<VertexId>> caps_over(const Solid& solid, const Eigen::Matrix3Xd& positions,
                                                           const std::vector<VertexId>& loop);

}  // namespace argil::subdiv
