#pragma once
// Flat incidence lists of a whole solid, for loops over all its elements: vertices of cells and cells of vertices
// (both ascending), and what is boundary. radial_edge.h answers the same for one element.

#include <span>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

class Incidence {
 public:
  /// Cost O(cell corners).
  explicit Incidence(const Solid& solid);

  std::span<const VertexId> vertices(CellId c) const {
    return {cell_vertices_.data() + cell_offsets_[c.index()],
            cell_offsets_[c.index() + 1] - cell_offsets_[c.index()]};
  }
  std::span<const CellId> cells(VertexId v) const {
    return {vertex_cells_.data() + vertex_offsets_[v.index()],
            vertex_offsets_[v.index() + 1] - vertex_offsets_[v.index()]};
  }
  bool is_boundary(VertexId v) const { return boundary_vertex_[v] != 0; }
  bool is_boundary(EdgeId e) const { return boundary_face_count_[e] != 0; }
  std::size_t boundary_face_count(EdgeId e) const { return boundary_face_count_[e]; }
  /// (cell, vertex) pairs: the number of cells of the next level.
  std::size_t cell_vertex_count() const { return cell_vertices_.size(); }

 private:
  std::vector<std::size_t> cell_offsets_, vertex_offsets_;
  std::vector<VertexId> cell_vertices_;
  std::vector<CellId> vertex_cells_;
  VertexData<std::uint8_t> boundary_vertex_;
  EdgeData<std::uint32_t> boundary_face_count_;
};

}  // namespace argil::subdiv
