#include "subdiv/radial_edge.h"

#include <algorithm>
#include <cassert>

#include "subdiv/sort_unique.h"

namespace argil::subdiv {

namespace {

// The uses at one edge, paired by the cells that they belong to.
class EdgeRing {
 public:
  EdgeRing(const Solid& solid, EdgeId edge) : solid_(solid) {
    solid.for_each_face(edge, [&](FaceId f) {
      faces_.push_back(f);
      for (const bool back : {false, true})
        if (const CellId c = solid.owner(face_use(f, back)); c.valid()) by_cell_.push_back({c, face_use(f, back)});
    });
    std::sort(by_cell_.begin(), by_cell_.end());
    visited_.assign(faces_.size(), false);
  }

  const std::vector<FaceId>& faces() const { return faces_; }
  bool visited(std::size_t i) const { return visited_[i]; }

  // Turns from `face` out of `exit` until an unowned side or the first face comes again.
  RadialFan turn(FaceId face, FaceUseId exit) {
    RadialFan fan;
    fan.faces.push_back(face);
    visit(face);
    while (true) {
      const CellId cell = solid_.owner(exit);
      if (!cell.valid()) return fan;
      fan.cells.push_back(cell);
      const FaceUseId entry = mate_of(cell, exit);
      if (face_of(entry) == face) {
        fan.closed = true;
        return fan;
      }
      fan.faces.push_back(face_of(entry));
      visit(face_of(entry));
      exit = other_side(entry);
    }
  }

 private:
  using CellUse = std::pair<CellId, FaceUseId>;
  void visit(FaceId f) {
    visited_[static_cast<std::size_t>(std::lower_bound(faces_.begin(), faces_.end(), f) - faces_.begin())] = true;
  }
  FaceUseId mate_of(CellId cell, FaceUseId use) const {
    const auto at = std::lower_bound(by_cell_.begin(), by_cell_.end(), CellUse{cell, FaceUseId{std::size_t{0}}});
    assert(at + 1 < by_cell_.end() && (at + 1)->first == cell);
    return at->second == use ? (at + 1)->second : at->second;
  }

  const Solid& solid_;
  std::vector<FaceId> faces_;
  std::vector<CellUse> by_cell_;
  std::vector<bool> visited_;
};

}  // namespace

std::vector<RadialFan> radial_fans(const Solid& solid, EdgeId edge) {
  EdgeRing ring(solid, edge);
  std::vector<RadialFan> fans;
  // Faces ascend, so that the first end of an open fan to be met is its lower one.
  for (std::size_t i = 0; i < ring.faces().size(); ++i) {
    const FaceId f = ring.faces()[i];
    const bool front = solid.owner(face_use(f, false)).valid(), back = solid.owner(face_use(f, true)).valid();
    if (!ring.visited(i) && !(front && back)) fans.push_back(ring.turn(f, face_use(f, back)));
  }
  for (std::size_t i = 0; i < ring.faces().size(); ++i)
    if (!ring.visited(i)) fans.push_back(ring.turn(ring.faces()[i], face_use(ring.faces()[i], false)));
  std::sort(fans.begin(), fans.end(), [](const auto& a, const auto& b) { return a.faces[0] < b.faces[0]; });
  return fans;
}

FaceUseId mate(const Solid& solid, FaceUseId use_of_cell, EdgeId edge) {
  const CellId cell = solid.owner(use_of_cell);
  FaceUseId result;
  solid.for_each_face(edge, [&](FaceId f) {
    for (const bool back : {false, true})
      if (face_use(f, back) != use_of_cell && solid.owner(face_use(f, back)) == cell) result = face_use(f, back);
  });
  return result;
}

std::vector<VertexId> cell_vertices(const Solid& solid, CellId cell) {
  std::vector<VertexId> result;
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto loop = solid.face_vertices(face_of(use));
    result.insert(result.end(), loop.begin(), loop.end());
  }
  sort_unique(result);
  return result;
}

std::vector<EdgeId> cell_edges(const Solid& solid, CellId cell) {
  std::vector<EdgeId> result;
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto edges = solid.face_edges(face_of(use));
    result.insert(result.end(), edges.begin(), edges.end());
  }
  sort_unique(result);
  return result;
}

std::vector<CellId> edge_cells(const Solid& solid, EdgeId edge) {
  std::vector<CellId> result;
  solid.for_each_face(edge, [&](FaceId f) {
    for (const bool back : {false, true})
      if (const CellId c = solid.owner(face_use(f, back)); c.valid()) result.push_back(c);
  });
  sort_unique(result);
  return result;
}

std::vector<EdgeId> vertex_edges(const Solid& solid, VertexId vertex) {
  std::vector<EdgeId> result;
  solid.for_each_edge(vertex, [&](EdgeId e) { result.push_back(e); });
  return result;
}

std::vector<FaceId> vertex_faces(const Solid& solid, VertexId vertex) {
  std::vector<FaceId> result;
  solid.for_each_edge(vertex, [&](EdgeId e) { solid.for_each_face(e, [&](FaceId f) { result.push_back(f); }); });
  sort_unique(result);
  return result;
}

std::vector<CellId> vertex_cells(const Solid& solid, VertexId vertex) {
  std::vector<CellId> result;
  for (const FaceId f : vertex_faces(solid, vertex))
    for (const bool back : {false, true})
      if (const CellId c = solid.owner(face_use(f, back)); c.valid()) result.push_back(c);
  sort_unique(result);
  return result;
}

std::vector<VertexId> use_vertices(const Solid& solid, FaceUseId use) {
  const auto loop = solid.face_vertices(face_of(use));
  std::vector<VertexId> result(loop.begin(), loop.end());
  if (is_back(use)) std::reverse(result.begin(), result.end());
  return result;
}

Components components(const Solid& solid) {
  Components result{CellData<int>(solid.cell_capacity(), -1), 0};
  std::vector<CellId> stack;
  for (const CellId seed : solid.cells()) {
    if (result.component_from_cell[seed] >= 0) continue;
    result.component_from_cell[seed] = result.count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const CellId c = stack.back();
      stack.pop_back();
      for (const FaceUseId use : solid.cell_face_uses(c)) {
        const CellId next = solid.owner(other_side(use));
        if (!next.valid() || result.component_from_cell[next] >= 0) continue;
        result.component_from_cell[next] = result.count;
        stack.push_back(next);
      }
    }
    ++result.count;
  }
  return result;
}

}  // namespace argil::subdiv
