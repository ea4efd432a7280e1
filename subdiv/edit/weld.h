#pragma once
// Welding: what lies together becomes one, as after joining parts that were modelled apart.

#include <Eigen/Core>
#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

struct Weld {
  Edit edit;
  std::size_t vertices_gone = 0, faces_glued = 0;
};

/// The boundary vertices among `vertices` that are within `tolerance` [m] of one another, directly or from one to
/// the next, become one at their mean; faces that then coincide are glued. Nothing to weld is no error.
/// @throws Error (bad_input) for a tolerance that is negative or not finite; (bad_topology) as identify, naming the
/// cell that would have two equal corners. Cost O(vertices log vertices) while few lie within the tolerance of one
/// another, and of the cells at those that are welded.
[[nodiscard]] Weld weld(Transaction& transaction, const Eigen::Matrix3Xd& positions,
                        std::span<const VertexId> vertices, double tolerance);

/// The diagonal of the box about the live vertices [m].
[[nodiscard]] double extent(const Solid& solid, const Eigen::Matrix3Xd& positions);

}  // namespace argil::subdiv
