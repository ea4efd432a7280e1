#include "subdiv/cell_lists.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "subdiv/build.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

// The loop of a face-use from a corner of it on; nothing is copied, since a fine level has millions of them.
struct LoopView {
  std::span<const VertexId> stored;
  bool back = false;
  std::size_t start = 0;
  VertexId operator[](std::size_t i) const {
    const std::size_t n = stored.size(), j = (start + i) % n;
    return stored[back ? n - 1 - j : j];
  }
};

// The loop of the use of `cell` that runs from `a` to `b`, beginning with them.
LoopView loop_along(const Solid& solid, CellId cell, VertexId a, VertexId b) {
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    LoopView loop{solid.face_vertices(face_of(use)), is_back(use), 0};
    for (; loop.start < loop.stored.size(); ++loop.start)
      if (loop[0] == a && loop[1] == b) return loop;
  }
  assert(false && "the cell does not have this edge");
  return {};
}

struct Count {
  VertexId vertex;
  int corners;
};

// Vertices of the cell, ascending, with the number of its corners at each.
std::vector<Count> corner_counts(const Solid& solid, CellId cell) {
  std::vector<VertexId> corners;
  corners.reserve(32);
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto loop = solid.face_vertices(face_of(use));
    corners.insert(corners.end(), loop.begin(), loop.end());
  }
  std::sort(corners.begin(), corners.end());
  std::vector<Count> counts;
  counts.reserve(8);
  for (const VertexId v : corners) {
    if (counts.empty() || counts.back().vertex != v) counts.push_back({v, 0});
    ++counts.back().corners;
  }
  return counts;
}

VertexId lowest_vertex(const Solid& solid, CellId cell) {
  VertexId lowest;  // an invalid id is above all others
  for (const FaceUseId use : solid.cell_face_uses(cell))
    for (const VertexId v : solid.face_vertices(face_of(use))) lowest = std::min(lowest, v);
  return lowest;
}

VertexId lowest_neighbour(const Solid& solid, CellId cell, VertexId v) {
  VertexId lowest;
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto loop = solid.face_vertices(face_of(use));
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i)
      if (loop[i] == v) lowest = std::min({lowest, loop[(i + 1) % n], loop[(i + n - 1) % n]});
  }
  return lowest;
}

}  // namespace

CellKind cell_kind(const Solid& solid, CellId cell) {
  const auto uses = solid.cell_face_uses(cell);
  int triangles = 0, quads = 0;
  FaceId quad;
  for (const FaceUseId use : uses) {
    const std::size_t n = solid.face_vertices(face_of(use)).size();
    triangles += n == 3;
    quads += n == 4;
    if (n == 4) quad = face_of(use);
  }
  if (triangles + quads != static_cast<int>(uses.size()) || uses.size() > 6) return CellKind::polyhedron;
  const auto counts = corner_counts(solid, cell);
  const auto threes = std::count_if(counts.begin(), counts.end(), [](const Count& c) { return c.corners == 3; });
  const bool simple = threes == static_cast<std::ptrdiff_t>(counts.size());
  // A closed cell with these faces and three at every vertex is the named one: the cubic planar graphs with 4, 6
  // and 8 vertices and these faces are unique.
  if (simple && triangles == 4 && quads == 0) return CellKind::tetrahedron;
  if (simple && triangles == 2 && quads == 3) return CellKind::wedge;
  if (simple && triangles == 0 && quads == 6) return CellKind::hexahedron;
  if (triangles == 4 && quads == 1 && counts.size() == 5 && threes == 4) {
    const auto base = solid.face_vertices(quad);
    for (const Count& c : counts)
      if (c.corners == 4 && std::find(base.begin(), base.end(), c.vertex) == base.end()) return CellKind::pyramid;
  }
  return CellKind::polyhedron;
}

namespace {

std::vector<VertexId> vtk_vertices_of_kind(const Solid& solid, CellId cell, CellKind kind) {
  assert(kind != CellKind::polyhedron);
  if (kind == CellKind::tetrahedron || kind == CellKind::hexahedron) {
    const VertexId v0 = lowest_vertex(solid, cell);
    const VertexId v1 = lowest_neighbour(solid, cell, v0);
    const auto below = loop_along(solid, cell, v1, v0), beside = loop_along(solid, cell, v0, v1);
    if (kind == CellKind::tetrahedron) return {v0, v1, below[2], beside[2]};
    const VertexId v2 = below[3], v3 = below[2];
    const auto opposite = loop_along(solid, cell, v2, v3);
    return {v0, v1, v2, v3, beside[3], beside[2], opposite[3], opposite[2]};
  }
  // The base of a pyramid, or the triangle of a wedge that holds its lowest vertex, from the lowest vertex of it.
  std::vector<VertexId> base;
  const std::size_t base_size = kind == CellKind::pyramid ? 4 : 3;
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    auto loop = use_vertices(solid, use);
    if (loop.size() != base_size) continue;
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    if (base.empty() || loop[0] < base[0]) base = loop;
  }
  if (kind == CellKind::pyramid) {
    const auto side = loop_along(solid, cell, base[1], base[0]);
    return {base[0], base[3], base[2], base[1], side[2]};
  }
  const auto side = loop_along(solid, cell, base[1], base[0]);
  const auto other = loop_along(solid, cell, base[2], base[1]);
  return {base[0], base[1], base[2], side[2], side[3], other[3]};
}

}  // namespace

std::vector<VertexId> vtk_vertices(const Solid& solid, CellId cell) {
  return vtk_vertices_of_kind(solid, cell, cell_kind(solid, cell));
}

CellLists cell_lists(const Solid& solid, const Eigen::Matrix3Xd& positions) {
  CellLists lists;
  lists.positions.resize(3, static_cast<Eigen::Index>(solid.vertex_count()));
  VertexData<std::uint32_t> point_from_vertex(solid.vertex_capacity(), 0);
  std::uint32_t points = 0;
  for (const VertexId v : solid.vertices()) {
    lists.positions.col(points) = positions.col(static_cast<Eigen::Index>(v.index()));
    point_from_vertex[v] = points++;
  }
  for (const CellId c : solid.cells()) {
    const CellKind kind = cell_kind(solid, c);
    if (kind == CellKind::polyhedron) {
      const auto uses = solid.cell_face_uses(c);
      lists.connectivity.push_back(static_cast<std::uint32_t>(uses.size()));
      for (const FaceUseId use : uses) {
        const auto loop = use_vertices(solid, use);
        lists.connectivity.push_back(static_cast<std::uint32_t>(loop.size()));
        for (const VertexId v : loop) lists.connectivity.push_back(point_from_vertex[v]);
      }
    } else {
      for (const VertexId v : vtk_vertices_of_kind(solid, c, kind))
        lists.connectivity.push_back(point_from_vertex[v]);
    }
    lists.kinds.push_back(kind);
    lists.offsets.push_back(lists.connectivity.size());
  }
  return lists;
}

}  // namespace argil::subdiv
