#pragma once
// New cells between two regions of boundary faces of the same shape. A bridge between parts joins them; between
// places of one part it makes a handle.

#include <Eigen/Core>
#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

struct BridgeOptions {
  int steps = 1;     // cells along the way
  int twist = 0;     // single faces only: each vertex goes to the one so many further round the second face
  bool arc = false;  // leaves and arrives along the regions' mean normals: between equal normals, a half ring
};

/// Grows one cell a face and step from the first region to the second. The regions are matched as if the first had
/// been carried along the way, so that the bridge turns as little as it can. Where they share a vertex the cells
/// meet in it, as the leaves of a book. Sharp corners at both ends leave a sharp edge between them; rings between
/// steps stay smooth, what becomes interior loses its sharpness.
/// @throws Error, the transaction to be abandoned: (bad_input) for fewer than 1 step, or a twist of larger regions;
/// as check_boundary_faces and match_regions; (bad_geometry) for an arc from a region without a mean normal;
/// (bad_topology) naming cells that would overlap. Cost O(regions × steps), and see match_regions.
[[nodiscard]] Edit bridge(Transaction& transaction, const Eigen::Matrix3Xd& positions,
                          std::span<const FaceId> first, std::span<const FaceId> second,
                          const BridgeOptions& options = {});

}  // namespace argil::subdiv
