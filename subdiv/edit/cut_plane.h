#pragma once
// Cutting cells by a plane.

#include <Eigen/Core>
#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

struct Plane {
  Eigen::Vector3d normal;  // any length but 0
  Eigen::Vector3d at;      // [m]
};

/// Parts each of the cells that has vertices on both sides in two, along the plane; the others, and those that only
/// touch it, stay. A vertex nearer than `tolerance` [m] is taken as on the plane, and does not move. Cells beside
/// them get the cut edges and faces, so that no vertex hangs. `next_cells` are those of the cells that lie on the
/// side that the normal points to.
/// @throws Error before anything is changed: as `checked` (cuts.h); (bad_input) for a normal of length 0, and where
/// the plane parts no cell; (bad_topology) naming a cell that is not convex so that its section is not one loop.
/// Cost O(cells and those about them).
[[nodiscard]] Edit cut_plane(Transaction& transaction, const Eigen::Matrix3Xd& rest, std::span<const CellId> cells,
                             const Plane& plane, double tolerance);

}  // namespace argil::subdiv
