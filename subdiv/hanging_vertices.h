#pragma once
// Meshes with hanging nodes: a boundary vertex that lies on a boundary edge or face whose corner it is not, so that
// what looks joined is not. Asked within pieces that hang together by vertices: bodies that merely touch are not
// meant.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

struct HangingVertex {
  VertexId vertex;  // the lowest such vertex
  FaceId face;      // the boundary face in which, or on an edge of which, it lies
  CellId cell;      // that the face bounds
};

/// `tolerance` is a share of the face's size: how far off the face a vertex may lie, and how far from its corners
/// it must. `positions` is 3 x vertex capacity.
/// Cost O(boundary · log), more only where boundary faces of very different size crowd together.
[[nodiscard]] std::optional<HangingVertex> find_hanging_vertex(const Solid& solid,
                                                               const Eigen::Matrix3Xd& positions,
                                                               double tolerance = 1e-6);

}  // namespace argil::subdiv
