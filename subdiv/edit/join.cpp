#include "subdiv/edit/join.h"

#include <algorithm>

#include "subdiv/edit/rewrite.h"
#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::subdiv {

Edit join(Transaction& transaction, const Built& other) {
  Edit edit;
  std::vector<VertexId> here(other.solid.vertex_capacity());
  for (const VertexId v : other.solid.vertices()) {
    const VertexId made = here[v.index()] = transaction.add_vertex();
    edit.placed.push_back({made, {}, other.positions.col(static_cast<Eigen::Index>(v.index()))});
    if (other.solid.vertex_sharpness(v) > 0) transaction.set_sharpness(made, other.solid.vertex_sharpness(v));
  }
  for (const CellId c : other.solid.cells()) {
    auto loops = cell_loops(other.solid, c);
    for (auto& loop : loops)
      for (VertexId& v : loop) v = here[v.index()];
    edit.next_cells.push_back(transaction.add_cell(loops));
  }
  for (const EdgeId e : other.solid.edges()) {
    if (!(other.solid.edge_sharpness(e) > 0)) continue;
    const auto [a, b] = other.solid.edge_vertices(e);
    transaction.set_sharpness(transaction.add_edge(here[a.index()], here[b.index()]),
                              other.solid.edge_sharpness(e));
  }
  for (const FaceId f : other.solid.faces()) {
    if (!(other.solid.face_sharpness(f) > 0)) continue;
    std::vector<VertexId> loop;
    for (const VertexId v : other.solid.face_vertices(f)) loop.push_back(here[v.index()]);
    transaction.set_sharpness(face_of(transaction.add_face(loop)), other.solid.face_sharpness(f));
  }
  return edit;
}

CopiedCells copy_cells(Transaction& transaction, std::span<const CellId> cells,
                       const std::map<VertexId, VertexId>& shared, bool mirrored) {
  const Solid& solid = transaction.solid();
  CopiedCells result;
  result.copy_from_vertex = shared;
  std::vector<VertexId> vertices, rim;
  std::vector<EdgeId> edges;
  std::vector<FaceId> faces;
  for (const CellId c : cells)
    for (const FaceUseId use : solid.cell_face_uses(c)) {
      faces.push_back(face_of(use));
      for (const EdgeId e : solid.face_edges(face_of(use))) edges.push_back(e);
      for (const VertexId v : solid.face_vertices(face_of(use))) vertices.push_back(v);
    }
  sort_unique(vertices);
  sort_unique(edges);
  sort_unique(faces);
  for (const VertexId v : vertices) {
    const auto [place, is_new] = result.copy_from_vertex.try_emplace(v);
    if (!is_new) {
      rim.push_back(place->second);
      continue;
    }
    place->second = transaction.add_vertex();
    transaction.set_sharpness(place->second, solid.vertex_sharpness(v));
  }
  const auto image = [&](VertexId v) { return result.copy_from_vertex.at(v); };
  for (const CellId c : cells) {
    auto loops = cell_loops(solid, c);
    for (auto& loop : loops) {
      for (VertexId& v : loop) v = image(v);
      if (mirrored) std::reverse(loop.begin(), loop.end());
    }
    result.cells.push_back({transaction.add_cell(loops), c});
  }
  for (const EdgeId e : edges) {
    const auto ends = solid.edge_vertices(e);
    const EdgeId copy = *solid.find_edge(image(ends[0]), image(ends[1]));
    if (copy == e) continue;
    transaction.set_sharpness(copy, std::max(solid.edge_sharpness(copy), solid.edge_sharpness(e)));
    result.edges.push_back({copy, e});
  }
  for (const FaceId f : faces) {
    std::vector<VertexId> loop;
    for (const VertexId v : solid.face_vertices(f)) loop.push_back(image(v));
    const FaceId copy = *solid.find_face(loop);
    if (copy == f) continue;
    if (solid.face_sharpness(f) > 0) transaction.set_sharpness(copy, solid.face_sharpness(f));
    result.faces.push_back({copy, f});
  }
  sort_unique(rim);
  drop_interior_sharpness(transaction, rim);
  check_links(solid, rim);
  return result;
}

}  // namespace argil::subdiv
