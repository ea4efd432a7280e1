#include "subdiv/neighbourhood.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>

#include "subdiv/incidence.h"
#include "subdiv/maccracken_joy.h"
#include "subdiv/parallel.h"

namespace argil::subdiv {

namespace {

using Box = std::array<VertexId, 8>;  // index 4i + 2j + k: one bit a direction
constexpr std::array<unsigned, 3> k_direction_bit{4, 2, 1};
constexpr std::size_t k_cells_per_task = 1024;

std::span<const VertexId> loop_of(const Solid& solid, FaceUseId use) {
  return solid.face_vertices(face_of(use));
}

// The quadrilateral of a cell, as seen from outside, in which `from` is followed by `to`, turned to begin there.
std::optional<std::array<VertexId, 4>> quad_along(const Solid& solid, CellId cell, VertexId from, VertexId to) {
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto loop = loop_of(solid, use);
    const std::size_t step = is_back(use) ? 3 : 1;
    for (std::size_t i = 0; i < 4; ++i)
      if (loop[i] == from && loop[(i + step) % 4] == to)
        return std::array{from, to, loop[(i + 2 * step) % 4], loop[(i + 3 * step) % 4]};
  }
  return std::nullopt;
}

std::optional<Box> find_box(const Solid& solid, CellId cell) {
  const auto uses = solid.cell_face_uses(cell);
  if (uses.size() != 6) return std::nullopt;
  std::array<VertexId, 24> corners;
  std::size_t count = 0;
  for (const FaceUseId use : uses) {
    const auto loop = loop_of(solid, use);
    if (loop.size() != 4) return std::nullopt;
    for (const VertexId v : loop) corners[count++] = v;
  }
  std::sort(corners.begin(), corners.end());
  for (std::size_t i = 0; i < 24; i += 3)  // eight vertices, three faces at each
    if (corners[i] != corners[i + 2] || (i > 0 && corners[i] == corners[i - 1])) return std::nullopt;

  const VertexId origin = corners[0];
  VertexId u;  // lowest neighbour of the origin
  for (const FaceUseId use : uses) {
    const auto loop = loop_of(solid, use);
    for (std::size_t i = 0; i < 4; ++i)
      if (loop[i] == origin) u = std::min({u, loop[(i + 1) % 4], loop[(i + 3) % 4]});
  }
  // Seen from outside, the side v = 0 runs origin, u, uw, w; u = 0 runs origin, w, vw, v; w = 0 origin, v, uv, u.
  const auto v_side = quad_along(solid, cell, origin, u);
  if (!v_side) return std::nullopt;
  const VertexId w = (*v_side)[3];
  const auto u_side = quad_along(solid, cell, origin, w);
  if (!u_side) return std::nullopt;
  const VertexId v = (*u_side)[3];
  const auto w_side = quad_along(solid, cell, origin, v);
  if (!w_side || (*w_side)[3] != u) return std::nullopt;
  Box box{origin, w, v, (*u_side)[2], u, (*v_side)[2], (*w_side)[2], VertexId{}};
  for (std::size_t i = 0; i < 24; i += 3)
    if (std::find(box.begin(), box.end(), corners[i]) == box.end()) {
      if (box[7].valid()) return std::nullopt;
      box[7] = corners[i];
    }
  return box[7].valid() ? std::optional(box) : std::nullopt;
}

unsigned place(const Box& box, VertexId v) {
  return static_cast<unsigned>(std::find(box.begin(), box.end(), v) - box.begin());
}

// Which of the six sides of a hexahedron are boundary: [direction][0 low, 1 high].
using Sides = std::array<std::array<bool, 2>, 3>;

Sides boundary_sides(const Solid& solid, CellId cell, const Box& box) {
  Sides sides{};
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    if (!solid.is_boundary(face_of(use))) continue;
    unsigned all = 7, any = 0;
    for (const VertexId v : loop_of(solid, use)) {
      all &= place(box, v);
      any |= place(box, v);
    }
    for (std::size_t d = 0; d < 3; ++d) {
      if (all & k_direction_bit[d]) sides[d][1] = true;
      if (!(any & k_direction_bit[d])) sides[d][0] = true;
    }
  }
  return sides;
}

// Frames of all hexahedra, and which vertices lie in a regular grid or on its side, creased edge or corner.
class Grid {
 public:
  static constexpr std::uint8_t k_not_regular = 255;

  explicit Grid(const Solid& solid)
      : solid_(solid),
        incidence_(solid),
        boxes_(solid.cell_capacity()),
        sides_from_vertex_(solid.vertex_capacity(), k_not_regular) {
    parallel_for(solid.cell_capacity(), k_cells_per_task, [&](std::size_t c) {
      if (solid.is_live(CellId{c})) boxes_[CellId{c}] = find_box(solid, CellId{c}).value_or(Box{});
    });
    parallel_for(solid.vertex_capacity(), k_cells_per_task, [&](std::size_t v) {
      if (solid.is_live(VertexId{v})) sides_from_vertex_[VertexId{v}] = count_sides(VertexId{v});
    });
  }

  bool is_hexahedron(CellId c) const { return boxes_[c][0].valid(); }
  const Box& box(CellId c) const { return boxes_[c]; }
  std::span<const CellId> cells(VertexId v) const { return incidence_.cells(v); }

  CellClass classify(CellId c) const {
    if (!is_hexahedron(c)) return CellClass::irregular;
    const Sides sides = boundary_sides(solid_, c, box(c));
    bool interior = true;
    for (unsigned corner = 0; corner < 8; ++corner) {
      std::uint8_t count = 0;
      for (std::size_t d = 0; d < 3; ++d) count += sides[d][(corner & k_direction_bit[d]) ? 1 : 0] ? 1 : 0;
      if (sides_from_vertex_[box(c)[corner]] != count) return CellClass::extraordinary;
      interior = interior && count == 0;
    }
    return interior ? CellClass::regular_published : CellClass::regular_boundary;
  }

 private:
  // In how many directions the grid ends at a vertex whose rules are those of a tensor product, or k_not_regular.
  std::uint8_t count_sides(VertexId v) const {
    const auto cells = incidence_.cells(v);
    const std::size_t edge_count = solid_.vertex_valence(v);
    if (edge_count < 3 || edge_count > 6) return k_not_regular;
    const auto sides = static_cast<std::uint8_t>(6 - edge_count);
    if (cells.size() != (std::size_t{8} >> sides)) return k_not_regular;
    for (const CellId c : cells)
      if (!is_hexahedron(c)) return k_not_regular;
    if (sides < 3 && solid_.vertex_sharpness(v) != 0) return k_not_regular;
    // How many edges lie inside, in a side, in a box edge: 6 0 0, then 1 4 0, 0 2 2, 0 0 3.
    std::size_t inside = 0, in_side = 0, in_crease = 0;
    solid_.for_each_edge(v, [&](EdgeId e) {
      const std::size_t faces = solid_.edge_valence(e), boundary_faces = incidence_.boundary_face_count(e);
      const double sharpness = solid_.edge_sharpness(e);
      if (faces == 4 && boundary_faces == 0 && sharpness == 0) ++inside;
      if (faces == 3 && boundary_faces == 2 && sharpness == 0) ++in_side;
      if (faces == 2 && boundary_faces == 2 && sharpness >= k_infinitely_sharp) ++in_crease;
    });
    constexpr std::array<std::array<std::size_t, 3>, 4> k_edges{{{6, 0, 0}, {1, 4, 0}, {0, 2, 2}, {0, 0, 3}}};
    return k_edges[sides] == std::array{inside, in_side, in_crease} ? sides : k_not_regular;
  }

  const Solid& solid_;
  Incidence incidence_;
  CellData<Box> boxes_;
  VertexData<std::uint8_t> sides_from_vertex_;
};

// The vertices of a net, papers/004 Fig. 6: those of the cell, then across each face, edge and vertex. Places on
// phantom layers stay invalid.
class NetAssembly {
 public:
  NetAssembly(const Solid& solid, const Grid& grid) : solid_(solid), grid_(grid) {}

  std::array<VertexId, 64> vertices(CellId cell) const {
    std::array<VertexId, 64> net;
    const Box& box = grid_.box(cell);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const VertexId v = box[corner];
      std::array<VertexId, 3> beyond;  // the neighbour of v that continues the cell's edge, per direction
      for (std::size_t d = 0; d < 3; ++d) beyond[d] = continuation(v, box[corner ^ k_direction_bit[d]]);
      net[at(corner, 0)] = v;
      for (std::size_t d = 0; d < 3; ++d) {
        if (!beyond[d].valid()) continue;
        net[at(corner, k_direction_bit[d])] = beyond[d];
        const std::size_t next = (d + 1) % 3;
        if (beyond[next].valid())
          net[at(corner, k_direction_bit[d] | k_direction_bit[next])] =
              opposite_in_face(v, beyond[d], beyond[next]);
      }
      if (beyond[0].valid() && beyond[1].valid() && beyond[2].valid())
        net[at(corner, 7)] = opposite_in_cell(v, beyond);
    }
    return net;
  }

 private:
  // Net index of the place that is one step outward from a corner of the cell in the directions of `outward`.
  static std::size_t at(unsigned corner, unsigned outward) {
    constexpr std::array<std::size_t, 3> k_stride{16, 4, 1};
    std::size_t index = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const bool high = (corner & k_direction_bit[d]) != 0, out = (outward & k_direction_bit[d]) != 0;
      index += k_stride[d] * (high ? (out ? 3 : 2) : (out ? 0 : 1));
    }
    return index;
  }

  bool share_face(EdgeId a, EdgeId b) const {
    bool shared = false;
    solid_.for_each_face(a, [&](FaceId f) {
      const auto edges = solid_.face_edges(f);
      shared = shared || std::find(edges.begin(), edges.end(), b) != edges.end();
    });
    return shared;
  }

  // The neighbour of v along the edge that shares no face with the edge to `inner`; invalid at a side.
  VertexId continuation(VertexId v, VertexId inner) const {
    const EdgeId inner_edge = *solid_.find_edge(v, inner);
    VertexId result;
    solid_.for_each_edge(v, [&](EdgeId e) {
      if (e != inner_edge && !share_face(e, inner_edge)) result = solid_.other_vertex(e, v);
    });
    return result;
  }

  VertexId opposite_in_face(VertexId v, VertexId a, VertexId b) const {
    VertexId result;
    solid_.for_each_face(*solid_.find_edge(v, a), [&](FaceId f) {
      const auto loop = solid_.face_vertices(f);
      if (std::find(loop.begin(), loop.end(), b) == loop.end()) return;
      result = loop[static_cast<std::size_t>(std::find(loop.begin(), loop.end(), v) - loop.begin() + 2) % 4];
    });
    assert(result.valid());
    return result;
  }

  VertexId opposite_in_cell(VertexId v, const std::array<VertexId, 3>& neighbours) const {
    for (const CellId c : grid_.cells(v)) {
      const Box& box = grid_.box(c);
      if (std::all_of(neighbours.begin(), neighbours.end(),
                      [&](VertexId n) { return std::find(box.begin(), box.end(), n) != box.end(); }))
        return box[7 - place(box, v)];
    }
    assert(false);
    return {};
  }

  const Solid& solid_;
  const Grid& grid_;
};

// Makes the phantoms of a net: with p₋₁ = 2p₀ − p₁ in every direction that ends, a product of such rows.
class PhantomTable {
 public:
  explicit PhantomTable(std::size_t vertex_capacity) { rows_.column_count = vertex_capacity; }

  void complete(const std::array<VertexId, 64>& net, const Sides& sides, std::array<std::uint32_t, 64>& nodes) {
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

  std::uint32_t phantom(const std::array<VertexId, 64>& net, const Sides& sides,
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
  const Grid grid(solid);
  CellData<CellClass> classes(solid.cell_capacity(), CellClass::irregular);
  parallel_for(solid.cell_capacity(), k_cells_per_task, [&](std::size_t c) {
    if (solid.is_live(CellId{c})) classes[CellId{c}] = grid.classify(CellId{c});
  });
  return classes;
}

RegularNets regular_nets(const Solid& solid, const CellData<CellClass>& classes) {
  const Grid grid(solid);
  RegularNets nets;
  for (const CellId c : solid.cells())
    if (classes[c] == CellClass::regular_boundary || classes[c] == CellClass::regular_published)
      nets.cells.push_back(c);
  nets.nodes.resize(nets.cells.size());

  const NetAssembly assembly(solid, grid);
  std::vector<std::array<VertexId, 64>> vertices(nets.cells.size());
  parallel_for(nets.cells.size(), k_cells_per_task,
               [&](std::size_t i) { vertices[i] = assembly.vertices(nets.cells[i]); });
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
