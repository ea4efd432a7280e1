#pragma once
// Flat incidence lists of a whole solid, for loops over all its elements: vertices of cells and cells of vertices
// (both ascending), and what is of the skin (skin.h) on this level. radial_edge.h answers the same for one element.

#include <span>
#include <vector>

#include "subdiv/skin.h"
#include "subdiv/solid.h"

namespace argil::subdiv {

class Incidence {
 public:
  /// Cost O(cell corners). The solid must outlive it.
  explicit Incidence(const Solid& solid);

  std::span<const VertexId> vertices(CellId c) const {
    return {cell_vertices_.data() + cell_offsets_[c.index()],
            cell_offsets_[c.index() + 1] - cell_offsets_[c.index()]};
  }
  std::span<const CellId> cells(VertexId v) const {
    return {vertex_cells_.data() + vertex_offsets_[v.index()],
            vertex_offsets_[v.index() + 1] - vertex_offsets_[v.index()]};
  }
  bool on_skin(VertexId v) const { return skin_vertex_[v] != 0; }
  bool on_skin(EdgeId e) const { return skin_face_count_[e] != 0; }
  bool on_skin(FaceId f) const { return skin_.holds(f, Phase::parent); }
  std::size_t skin_face_count(EdgeId e) const { return skin_face_count_[e]; }
  /// (cell, vertex) pairs: the number of cells of the next level.
  std::size_t cell_vertex_count() const { return cell_vertices_.size(); }

 private:
  std::vector<std::size_t> cell_offsets_, vertex_offsets_;
  std::vector<VertexId> cell_vertices_;
  std::vector<CellId> vertex_cells_;
  Skin skin_;
  VertexData<std::uint8_t> skin_vertex_;
  EdgeData<std::uint32_t> skin_face_count_;
};

}  // namespace argil::subdiv
