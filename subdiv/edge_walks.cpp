#include "subdiv/edge_walks.h"

#include <algorithm>
#include <set>

#include "subdiv/build.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

// The faces that a walk along an edge sees: on the boundary those of the boundary only.
std::vector<FaceId> faces_seen(const Solid& solid, EdgeId edge, bool boundary) {
  std::vector<FaceId> faces;
  solid.for_each_face(edge, [&](FaceId f) {
    if (!boundary || solid.is_boundary(f)) faces.push_back(f);
  });
  return faces;
}

// The edge opposite to `edge` at a regular vertex, or an invalid id.
EdgeId straight_on(const Solid& solid, EdgeId edge, VertexId vertex) {
  const bool boundary = solid.is_boundary(edge);
  if (!boundary && solid.is_boundary(vertex)) return {};
  const std::size_t edge_count = boundary ? 4 : 6, faces_each = boundary ? 2 : 4;
  const std::vector<FaceId> own = faces_seen(solid, edge, boundary);
  std::size_t edges = 0, opposites = 0;
  bool regular = true;
  EdgeId opposite;
  solid.for_each_edge(vertex, [&](EdgeId other) {
    if (boundary && !solid.is_boundary(other)) return;
    ++edges;
    const std::vector<FaceId> faces = faces_seen(solid, other, boundary);
    regular &= faces.size() == faces_each;
    for (const FaceId f : faces) regular &= solid.face_vertices(f).size() == 4;
    if (std::find_first_of(faces.begin(), faces.end(), own.begin(), own.end()) != faces.end()) return;
    ++opposites;
    opposite = other;
  });
  return regular && edges == edge_count && opposites == 1 ? opposite : EdgeId{};
}

EdgeId across(const Solid& solid, FaceId face, EdgeId edge) {
  const auto edges = solid.face_edges(face);
  const auto at = static_cast<std::size_t>(std::find(edges.begin(), edges.end(), edge) - edges.begin());
  return edges[(at + 2) % 4];
}

std::vector<EdgeId> ascending(const std::set<EdgeId>& edges) {
  return {edges.begin(), edges.end()};
}

// Across boundary quadrilaterals. A step is an edge and the face that is to be crossed from it.
void walk_sheet_of_boundary(const Solid& solid, std::vector<std::pair<EdgeId, FaceId>> steps,
                            std::set<EdgeId>& found) {
  std::set<std::pair<EdgeId, FaceId>> taken;
  while (!steps.empty()) {
    const auto [edge, face] = steps.back();
    steps.pop_back();
    if (solid.face_vertices(face).size() != 4 || !taken.emplace(edge, face).second) continue;
    const EdgeId next = across(solid, face, edge);
    found.insert(next);
    for (const RadialFan& fan : radial_fans(solid, next)) {
      if (fan.faces.size() < 2 || fan.closed) continue;
      if (fan.faces.front() == face) steps.emplace_back(next, fan.faces.back());
      if (fan.faces.back() == face) steps.emplace_back(next, fan.faces.front());
    }
  }
}

// Through hexahedra. A step is an edge and a cell at it.
void walk_sheet_of_cells(const Solid& solid, std::vector<std::pair<EdgeId, CellId>> steps,
                         std::set<EdgeId>& found) {
  std::set<std::pair<EdgeId, CellId>> taken;
  while (!steps.empty()) {
    const auto [edge, cell] = steps.back();
    steps.pop_back();
    if (!taken.emplace(edge, cell).second || cell_kind(solid, cell) != CellKind::hexahedron) continue;
    for (const FaceUseId use : solid.cell_face_uses(cell)) {
      const auto edges = solid.face_edges(face_of(use));
      if (std::find(edges.begin(), edges.end(), edge) == edges.end()) continue;
      const EdgeId next = across(solid, face_of(use), edge);
      found.insert(next);
      steps.emplace_back(next, cell);
      if (const CellId neighbour = solid.owner(other_side(use)); neighbour.valid())
        steps.emplace_back(edge, neighbour);
    }
  }
}

}  // namespace

std::vector<EdgeId> edge_loops(const Solid& solid, std::span<const EdgeId> seeds) {
  std::set<EdgeId> found;
  for (const EdgeId seed : seeds) {
    if (!found.insert(seed).second) continue;  // its loop is there
    for (const VertexId end : solid.edge_vertices(seed)) {
      VertexId vertex = end;
      for (EdgeId edge = straight_on(solid, seed, vertex); edge.valid() && found.insert(edge).second;) {
        vertex = solid.other_vertex(edge, vertex);
        edge = straight_on(solid, edge, vertex);
      }
    }
  }
  return ascending(found);
}

std::vector<EdgeId> edge_rings(const Solid& solid, std::span<const EdgeId> seeds) {
  std::set<EdgeId> found(seeds.begin(), seeds.end());
  std::vector<std::pair<EdgeId, FaceId>> boundary_steps;
  std::vector<std::pair<EdgeId, CellId>> cell_steps;
  for (const EdgeId seed : seeds) {
    if (solid.is_boundary(seed)) {
      for (const FaceId f : faces_seen(solid, seed, true)) boundary_steps.emplace_back(seed, f);
    } else {
      for (const CellId c : edge_cells(solid, seed)) cell_steps.emplace_back(seed, c);
    }
  }
  walk_sheet_of_boundary(solid, std::move(boundary_steps), found);
  walk_sheet_of_cells(solid, std::move(cell_steps), found);
  return ascending(found);
}

}  // namespace argil::subdiv
