#include "fem/discretization/numbering.h"

#include <algorithm>
#include <cassert>

#include "subdiv/radial_edge.h"

namespace argil::fem {

using subdiv::CellId;
using subdiv::EdgeId;
using subdiv::FaceId;
using subdiv::VertexId;

NextLevel::NextLevel(const subdiv::Solid& coarse)
    : coarse_(coarse),
      vertex_(coarse.vertex_capacity()),
      edge_(coarse.edge_capacity()),
      face_(coarse.face_capacity()),
      cell_(coarse.cell_capacity()) {
  std::uint32_t next = 0;
  for (const VertexId v : coarse.vertices()) vertex_[v.index()] = next++;
  for (const EdgeId e : coarse.edges()) edge_[e.index()] = next++;
  for (const FaceId f : coarse.faces()) face_[f.index()] = next++;
  for (const CellId c : coarse.cells()) cell_[c.index()] = next++;
}

std::array<std::uint32_t, 27> NextLevel::lattice(CellId cell, const std::array<VertexId, 8>& box) const {
  std::array<std::uint32_t, 27> result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        // The corners that surround the lattice point, in both halves where a coordinate is in the middle.
        std::array<VertexId, 8> around;
        std::size_t count = 0;
        for (std::size_t corner = 0; corner < 8; ++corner) {
          const int ci = static_cast<int>(corner >> 2 & 1), cj = static_cast<int>(corner >> 1 & 1),
                    ck = static_cast<int>(corner & 1);
          if ((i == 1 || i == 2 * ci) && (j == 1 || j == 2 * cj) && (k == 1 || k == 2 * ck))
            around[count++] = box[corner];
        }
        std::uint32_t& point = result[static_cast<std::size_t>(9 * i + 3 * j + k)];
        if (count == 1) {
          point = vertex_point(around[0]);
        } else if (count == 2) {
          const auto edge = coarse_.find_edge(around[0], around[1]);
          assert(edge);
          point = edge_point(*edge);
        } else if (count == 4) {
          const std::array<VertexId, 4> loop{around[0], around[1], around[3], around[2]};
          const auto face = coarse_.find_face(loop);
          assert(face);
          point = face_point(*face);
        } else {
          point = cell_point(cell);
        }
      }
  return result;
}

subdiv::Stencils midpoint_stencils(const subdiv::Solid& coarse) {
  subdiv::Stencils result;
  result.column_count = coarse.vertex_capacity();
  std::vector<std::uint32_t> columns;
  std::vector<double> weights;
  const auto append_mean = [&] {
    std::sort(columns.begin(), columns.end());
    weights.assign(columns.size(), 1.0 / static_cast<double>(columns.size()));
    result.append(columns, weights);
    columns.clear();
  };
  const auto add = [&](VertexId v) { columns.push_back(v.value); };
  for (const VertexId v : coarse.vertices()) {
    add(v);
    append_mean();
  }
  for (const EdgeId e : coarse.edges()) {
    for (const VertexId v : coarse.edge_vertices(e)) add(v);
    append_mean();
  }
  for (const FaceId f : coarse.faces()) {
    for (const VertexId v : coarse.face_vertices(f)) add(v);
    append_mean();
  }
  for (const CellId c : coarse.cells()) {
    for (const VertexId v : subdiv::cell_vertices(coarse, c)) add(v);
    append_mean();
  }
  return result;
}

Children children(const subdiv::CellData<CellId>& parent, std::size_t parent_capacity) {
  Children result;
  result.begin.assign(parent_capacity + 1, 0);
  for (const CellId p : parent.raw()) ++result.begin[p.index() + 1];
  for (std::size_t c = 0; c < parent_capacity; ++c) result.begin[c + 1] += result.begin[c];
  result.cells.resize(parent.size());
  std::vector<std::size_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t c = 0; c < parent.size(); ++c) result.cells[next[parent.raw()[c].index()]++] = CellId{c};
  return result;
}

}  // namespace argil::fem
