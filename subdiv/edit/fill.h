#pragma once
// Openings filled with cells: a notch, a pit, a tunnel, a void inside.

#include <Eigen/Core>
#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// One new cell for each patch of boundary faces that are connected through edges, bounded by their outer sides and
/// by a new cap face over every loop of edges that stays open. Where a face stands in a cap's place already, it
/// bounds the cell.
/// @throws Error, the transaction to be abandoned: as check_boundary_faces; (bad_topology) naming the loop where
/// the sides do not close to one sphere, and what to select instead; (bad_geometry) where they do not surround an
/// opening, but bulge out or lie flat. Cost O(faces and about them, log).
[[nodiscard]] Edit fill(Transaction& transaction, const Eigen::Matrix3Xd& positions, std::span<const FaceId> faces);

}  // namespace argil::subdiv
