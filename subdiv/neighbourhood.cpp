#include "subdiv/neighbourhood.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "subdiv/hexahedral_grid.h"
#include "subdiv/parallel.h"

namespace argil::subdiv {

namespace {

constexpr std::size_t k_cells_per_task = 1024;

// Net index of the place that is one step outward from a corner of the cell in the directions of `outward`.
std::size_t net_index(unsigned corner, unsigned outward) {
  constexpr std::array<std::size_t, 3> k_stride{16, 4, 1};
  std::size_t index = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const bool high = (corner & k_direction_bit[d]) != 0, out = (outward & k_direction_bit[d]) != 0;
    index += k_stride[d] * (high ? (out ? 3 : 2) : (out ? 0 : 1));
  }
  return index;
}

// The vertices of a net, papers/004 Fig. 6: those of the cell, then across each face, edge and vertex. A cell that
// shares with ours, at one of its vertices, the edges along all directions but some lies outward in these; its
// vertex farthest in these is the net's. Places on phantom layers stay invalid.
std::array<VertexId, 64> net_vertices(const HexahedralGrid& grid, CellId cell) {
  std::array<VertexId, 64> net;
  const Box& box = grid.box(cell);
  for (unsigned corner = 0; corner < 8; ++corner)
    for (const CellId other : grid.cells(box[corner])) {
      const Box& there = grid.box(other);
      const unsigned place = place_in_box(there, box[corner]);
      unsigned shared = 0, outward = 7;
      for (const unsigned bit : k_direction_bit)
        for (const unsigned other_bit : k_direction_bit)
          if (box[corner ^ bit] == there[place ^ other_bit]) {
            shared |= other_bit;
            outward &= ~bit;
          }
      net[net_index(corner, outward)] = there[place ^ (7U & ~shared)];
    }
  return net;
}

// Makes the phantoms of a net: with p₋₁ = 2p₀ − p₁ in every direction that ends, a product of such rows.
class PhantomTable {
 public:
  explicit PhantomTable(std::size_t vertex_capacity) { rows_.column_count = vertex_capacity; }

  void complete(const std::array<VertexId, 64>& net, const BoxSides& sides, std::array<std::uint32_t, 64>& nodes) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k) {
          const std::size_t index = 16 * i + 4 * j + k;
          nodes[index] = net[index].valid() ? net[index].value : phantom(net, sides, {i, j, k});
        }
  }

  Stencils take() { return std::move(rows_); }

 private:
  struct Term {
    std::size_t place;
    int weight;
  };
  struct Terms {
    std::array<Term, 2> terms;
    std::size_t count;
  };

  static Terms along(std::size_t place, const std::array<bool, 2>& sides) {
    if (place == 0 && sides[0]) return {{{{1, 2}, {2, -1}}}, 2};
    if (place == 3 && sides[1]) return {{{{2, 2}, {1, -1}}}, 2};
    return {{{{place, 1}, {}}}, 1};
  }

  std::uint32_t phantom(const std::array<VertexId, 64>& net, const BoxSides& sides,
                        const std::array<std::size_t, 3>& place) {
    const Terms u = along(place[0], sides[0]), v = along(place[1], sides[1]), w = along(place[2], sides[2]);
    std::vector<std::pair<std::uint32_t, int>> row;
    for (std::size_t i = 0; i < u.count; ++i)
      for (std::size_t j = 0; j < v.count; ++j)
        for (std::size_t k = 0; k < w.count; ++k) {
          const VertexId vertex = net[16 * u.terms[i].place + 4 * v.terms[j].place + w.terms[k].place];
          assert(vertex.valid());
          row.push_back({vertex.value, u.terms[i].weight * v.terms[j].weight * w.terms[k].weight});
        }
    std::sort(row.begin(), row.end());
    const auto [at, added] =
        number_.try_emplace(row, static_cast<std::uint32_t>(rows_.column_count + rows_.row_count()));
    if (added) {
      for (const auto& [column, weight] : row) {
        rows_.columns.push_back(column);
        rows_.weights.push_back(weight);
      }
      rows_.offsets.push_back(rows_.columns.size());
    }
    return at->second;
  }

  std::map<std::vector<std::pair<std::uint32_t, int>>, std::uint32_t> number_;
  Stencils rows_;
};

}  // namespace

CellData<CellClass> classify_cells(const Solid& solid) {
  const HexahedralGrid grid(solid);
  CellData<CellClass> classes(solid.cell_capacity(), CellClass::irregular);
  parallel_for(solid.cell_capacity(), k_cells_per_task, [&](std::size_t c) {
    if (solid.is_live(CellId{c})) classes[CellId{c}] = grid.classify(CellId{c});
  });
  return classes;
}

RegularNets regular_nets(const Solid& solid, const CellData<CellClass>& classes) {
  const HexahedralGrid grid(solid);
  RegularNets nets;
  for (const CellId c : solid.cells())
    if (classes[c] == CellClass::regular_boundary || classes[c] == CellClass::regular_published)
      nets.cells.push_back(c);
  nets.nodes.resize(nets.cells.size());

  std::vector<std::array<VertexId, 64>> vertices(nets.cells.size());
  parallel_for(nets.cells.size(), k_cells_per_task,
               [&](std::size_t i) { vertices[i] = net_vertices(grid, nets.cells[i]); });
  PhantomTable phantoms(solid.vertex_capacity());
  for (std::size_t i = 0; i < nets.cells.size(); ++i)
    phantoms.complete(vertices[i], boundary_sides(solid, nets.cells[i], grid.box(nets.cells[i])), nets.nodes[i]);
  nets.phantoms = phantoms.take();
  return nets;
}

std::array<VertexId, 8> box_vertices(const Solid& solid, CellId hexahedron) {
  const auto box = find_box(solid, hexahedron);
  assert(box);
  return *box;
}

}  // namespace argil::subdiv
