#include "subdiv/hexahedral_grid.h"

#include <algorithm>

#include "subdiv/parallel.h"

namespace argil::subdiv {

namespace {

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

}  // namespace

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

BoxSides boundary_sides(const Solid& solid, CellId cell, const Box& box) {
  BoxSides sides{};
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    if (!solid.is_boundary(face_of(use))) continue;
    unsigned all = 7, any = 0;
    for (const VertexId v : loop_of(solid, use)) {
      all &= place_in_box(box, v);
      any |= place_in_box(box, v);
    }
    for (std::size_t d = 0; d < 3; ++d) {
      if (all & k_direction_bit[d]) sides[d][1] = true;
      if (!(any & k_direction_bit[d])) sides[d][0] = true;
    }
  }
  return sides;
}

HexahedralGrid::HexahedralGrid(const Solid& solid)
    : solid_(solid),
      incidence_(solid),
      boxes_(solid.cell_capacity()),
      sides_from_vertex_(solid.vertex_capacity(), k_not_regular) {
  constexpr std::size_t k_elements_per_task = 1024;
  parallel_for(solid.cell_capacity(), k_elements_per_task, [&](std::size_t c) {
    if (solid.is_live(CellId{c})) boxes_[CellId{c}] = find_box(solid, CellId{c}).value_or(Box{});
  });
  parallel_for(solid.vertex_capacity(), k_elements_per_task, [&](std::size_t v) {
    if (solid.is_live(VertexId{v})) sides_from_vertex_[VertexId{v}] = count_sides(VertexId{v});
  });
}

CellClass HexahedralGrid::classify(CellId c) const {
  if (!is_hexahedron(c)) return CellClass::irregular;
  const BoxSides sides = boundary_sides(solid_, c, box(c));
  bool interior = true;
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::uint8_t count = 0;
    for (std::size_t d = 0; d < 3; ++d) count += sides[d][(corner & k_direction_bit[d]) ? 1 : 0] ? 1 : 0;
    if (sides_from_vertex_[box(c)[corner]] != count) return CellClass::extraordinary;
    interior = interior && count == 0;
  }
  return interior ? CellClass::regular_published : CellClass::regular_boundary;
}

std::uint8_t HexahedralGrid::count_sides(VertexId v) const {
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
    const std::size_t faces = solid_.edge_valence(e), skin_faces = incidence_.skin_face_count(e);
    const double sharpness = solid_.edge_sharpness(e);
    if (faces == 4 && skin_faces == 0 && sharpness == 0) ++inside;
    if (faces == 3 && skin_faces == 2 && sharpness == 0) ++in_side;
    if (faces == 2 && skin_faces == 2 && sharpness >= k_infinitely_sharp) ++in_crease;
  });
  constexpr std::array<std::array<std::size_t, 3>, 4> k_edges{{{6, 0, 0}, {1, 4, 0}, {0, 2, 2}, {0, 0, 3}}};
  return k_edges[sides] == std::array{inside, in_side, in_crease} ? sides : k_not_regular;
}

}  // namespace argil::subdiv
