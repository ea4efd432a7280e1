#pragma once
// Symmetry, within a transaction: the mirrored half of a figure grown onto it, and a figure turned to its mirror
// image.

#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

struct Plane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    // [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // of any length
};

struct MirrorOptions {
  /// Vertices so near the plane [m] are put on it and shared by both halves; negative: nothing is shared.
  double weld = 1e-6;
};

/// Adds the mirror image of cells that lie on one side of a plane. Boundary faces in the plane are glued and become
/// interior; edges and vertices in it are shared. Where two boundary faces now meet without a fold (less than 30
/// degrees) along an edge of a glued face, that edge is smooth, since what it was sharp against is gone. Copies are
/// said to descend from what they are copies of, so that they join its sets. `rest`: 3 x vertex capacity [m].
/// @throws Error (bad_input) for no cells or a plane without a normal; (bad_geometry) naming cells on both sides or
/// one flat on the plane; (bad_topology) naming a face in the plane that has a cell on its other side already.
/// Cost O(cells given, log).
[[nodiscard]] Edit mirror(Transaction& transaction, const Eigen::Matrix3Xd& rest, std::span<const CellId> cells,
                          const Plane& plane, const MirrorOptions& options = {});

/// Turns the whole solid to its mirror image: vertices, edges and faces keep their ids, cells are new and descend
/// from the old. @throws Error (bad_input) for a plane without a normal. Cost O(solid).
[[nodiscard]] Edit reflect(Transaction& transaction, const Plane& plane);

}  // namespace argil::subdiv
