#include "subdiv/incidence.h"

#include <algorithm>
#include <cassert>

#include "subdiv/parallel.h"

namespace argil::subdiv {

Incidence::Incidence(const Solid& solid)
    : cell_offsets_(solid.cell_capacity() + 1, 0),
      vertex_offsets_(solid.vertex_capacity() + 1, 0),
      skin_(solid),
      skin_vertex_(solid.vertex_capacity(), 0),
      skin_face_count_(solid.edge_capacity(), 0) {
  for (std::size_t c = 0; c < solid.cell_capacity(); ++c) {
    std::size_t count = 0;
    if (solid.is_live(CellId{c})) {
      std::size_t corners = 0;
      const auto uses = solid.cell_face_uses(CellId{c});
      for (const FaceUseId use : uses) corners += solid.face_vertices(face_of(use)).size();
      count = 2 + corners / 2 - uses.size();  // Euler: a cell is a sphere
    }
    cell_offsets_[c + 1] = cell_offsets_[c] + count;
  }
  cell_vertices_.resize(cell_offsets_.back());
  parallel_for(solid.cell_capacity(), 4096, [&](std::size_t c) {
    if (!solid.is_live(CellId{c})) return;
    VertexId* const first = cell_vertices_.data() + cell_offsets_[c];
    VertexId* const last = cell_vertices_.data() + cell_offsets_[c + 1];
    VertexId* end = first;
    for (const FaceUseId use : solid.cell_face_uses(CellId{c}))
      for (const VertexId v : solid.face_vertices(face_of(use))) {
        if (std::find(first, end, v) != end) continue;
        assert(end != last);
        *end++ = v;
      }
    assert(end == last);
    std::sort(first, last);
  });

  for (const VertexId v : cell_vertices_) ++vertex_offsets_[v.index() + 1];
  for (std::size_t v = 0; v < solid.vertex_capacity(); ++v) vertex_offsets_[v + 1] += vertex_offsets_[v];
  vertex_cells_.resize(cell_vertices_.size());
  std::vector<std::size_t> next(vertex_offsets_.begin(), vertex_offsets_.end() - 1);
  for (const CellId c : solid.cells())
    for (const VertexId v : vertices(c)) vertex_cells_[next[v.index()]++] = c;

  for (const FaceId f : solid.faces()) {
    if (!on_skin(f)) continue;
    for (const VertexId v : solid.face_vertices(f)) skin_vertex_[v] = 1;
    for (const EdgeId e : solid.face_edges(f)) ++skin_face_count_[e];
  }
}

}  // namespace argil::subdiv
