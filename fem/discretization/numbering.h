#pragma once
// Which vertex of the next level comes from what: vertex, edge, face and cell points in the order of
// subdiv::RefinementStep, and the 3×3×3 lattice of them in a hexahedron.

#include <array>
#include <vector>

#include "subdiv/refinement.h"
#include "subdiv/stencils.h"

namespace argil::fem {

class NextLevel {
 public:
  explicit NextLevel(const subdiv::Solid& coarse);
  std::uint32_t vertex_point(subdiv::VertexId v) const { return vertex_[v.index()]; }
  std::uint32_t edge_point(subdiv::EdgeId e) const { return edge_[e.index()]; }
  std::uint32_t face_point(subdiv::FaceId f) const { return face_[f.index()]; }
  std::uint32_t cell_point(subdiv::CellId c) const { return cell_[c.index()]; }

  /// Fine vertices at lattice point 9i + 3j + k of a hexahedron whose corners stand in box order (4i + 2j + k).
  [[nodiscard]] std::array<std::uint32_t, 27> lattice(subdiv::CellId cell,
                                                      const std::array<subdiv::VertexId, 8>& box) const;

 private:
  const subdiv::Solid& coarse_;
  std::vector<std::uint32_t> vertex_, edge_, face_, cell_;
};

/// Values at the next level's vertices as means over the vertex, edge, face or cell that each comes from: how a
/// field is carried that is trilinear in every hexahedron.
[[nodiscard]] subdiv::Stencils midpoint_stencils(const subdiv::Solid& coarse);

/// Cells of level l + 1 by their parent, ascending: children of cell c are cells[begin[c] … begin[c + 1]).
struct Children {
  std::vector<std::size_t> begin;
  std::vector<subdiv::CellId> cells;
};
[[nodiscard]] Children children(const subdiv::CellData<subdiv::CellId>& parent, std::size_t parent_capacity);

}  // namespace argil::fem
