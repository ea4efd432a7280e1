#pragma once
// Regions of boundary faces, and how two of them correspond: what merging and bridging begin with. Two regions
// match by a map of faces to faces and vertices to vertices that reverses the sense in which loops run, since what
// is glued is seen from its two sides. Neighbours within a region are faces that bound one fan of cells at an edge,
// so that sheets which only touch there are not taken for one.

#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

/// @throws Error (bad_input) for no faces or one given twice, (not_found) for a dead one, (bad_topology) for an
/// interior one; `to_do` completes "expected boundary faces to …".
void check_boundary_faces(const Solid& solid, std::span<const FaceId> faces, const char* to_do);

/// The faces connected through edges, each patch ascending, patches by their lowest face.
[[nodiscard]] std::vector<std::vector<FaceId>> patches(const Solid& solid, std::span<const FaceId> faces);

/// The two patches that the faces make; two faces are two patches even where they meet at an edge.
/// @throws Error (bad_input) for any other number.
[[nodiscard]] std::array<std::vector<FaceId>, 2> two_regions(const Solid& solid, std::span<const FaceId> faces);

struct RegionMatch {
  std::vector<std::pair<FaceId, FaceId>> faces;         // by the first
  std::vector<std::pair<VertexId, VertexId>> vertices;  // by the first; one that both regions hold goes with itself
};
/// Of all ways to match, the one of least sum of squared distances after the first region was turned and the
/// middles were moved together; where several are equal, the one whose second vertices have lower ids.
/// @throws Error (bad_input) where a region has two patches or a face lies in both; (bad_topology) where the shapes
/// differ, saying how. Cost O(faces) for each pair of faces that have equal surroundings.
[[nodiscard]] RegionMatch match_regions(const Solid& solid, const Eigen::Matrix3Xd& positions,
                                        std::span<const FaceId> first, std::span<const FaceId> second,
                                        const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity());

/// Sum of the outward area vectors [m²].
[[nodiscard]] Eigen::Vector3d area_vector(const Solid& solid, const Eigen::Matrix3Xd& positions,
                                          std::span<const FaceId> faces);
/// Mean of the vertices, each once.
[[nodiscard]] Eigen::Vector3d middle(const Solid& solid, const Eigen::Matrix3Xd& positions,
                                     std::span<const FaceId> faces);

}  // namespace argil::subdiv
