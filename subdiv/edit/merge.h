#pragma once
// Gluing two regions of boundary faces of the same shape (papers/004 §3.1): parts become one solid, and a solid
// that is glued to itself gains a handle.

#include <Eigen/Core>
#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

enum class MergeAt { middle, first, second };

/// Glues the first region to the second: vertices that match become one, which stands in the middle or where one
/// of the two stood; all others stay. Regions may share vertices and edges, which closes the gap between them.
/// `positions` is 3 x vertex capacity.
/// @throws Error, the transaction to be abandoned: (bad_input, not_found, bad_topology) as check_boundary_faces and
/// match_regions; (bad_topology) naming the cell that would touch itself or another, and as identify. Cost
/// O(regions) and of the cells at their vertices; see match_regions.
[[nodiscard]] Edit merge(Transaction& transaction, const Eigen::Matrix3Xd& positions, std::span<const FaceId> first,
                         std::span<const FaceId> second, MergeAt at = MergeAt::middle);

}  // namespace argil::subdiv
