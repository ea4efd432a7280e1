#include "subdiv/edit/rewrite.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/disjoint_sets.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::subdiv {

namespace {

template <class IdType>
std::size_t place_in(const std::vector<IdType>& sorted, IdType id) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), id) - sorted.begin());
}

// What the rewrite may take away, as it was.
class Before {
 public:
  Before(const Solid& solid, const Rewrite& change) {
    for (const CellId c : change.removed)
      for (const FaceUseId use : solid.cell_face_uses(c)) faces.push_back(face_of(use));
    faces.insert(faces.end(), change.glued.begin(), change.glued.end());
    sort_unique(faces);
    for (const FaceId f : faces) {
      for (const EdgeId e : solid.face_edges(f)) edges.push_back(e);
      for (const VertexId v : solid.face_vertices(f)) vertices.push_back(v);
    }
    sort_unique(edges);
    sort_unique(vertices);
  }
  std::vector<FaceId> faces;
  std::vector<EdgeId> edges;
  std::vector<VertexId> vertices;
};

class Rewriter {
 public:
  Rewriter(Transaction& transaction, const Rewrite& change, Edit& edit)
      : t_(transaction), change_(change), edit_(edit), before_(transaction.solid(), change) {}

  void run() {
    for (const CellId c : change_.removed) t_.remove_cell(c, false);
    for (const NewCell& cell : change_.added) {
      const CellId made = t_.add_cell(cell.loops);
      if (cell.source.valid()) edit_.cells.push_back({made, cell.source});
      for (const auto& loop : cell.loops) touched_.insert(touched_.end(), loop.begin(), loop.end());
    }
    for (const VertexId v : before_.vertices) pass_on(v);
    for (const EdgeId e : before_.edges) pass_on(e);
    for (const FaceId f : before_.faces) pass_on(f);
    for (const auto& [loop, source] : change_.cut_faces) pass_on(loop, source);
    sweep();
    forget_what_was_swept(edit_.merged);
    forget_what_was_swept(edit_.edges);
    forget_what_was_swept(edit_.faces);
    touched_.insert(touched_.end(), before_.vertices.begin(), before_.vertices.end());
    sort_unique(touched_);
    std::erase_if(touched_, [&](VertexId v) { return !solid().is_live(v); });
    drop_interior_sharpness(t_, touched_);
    check_links(solid(), touched_);
  }

 private:
  const Solid& solid() const { return t_.solid(); }
  VertexId image(VertexId v) const {
    const auto found = change_.replaced.find(v);
    return found == change_.replaced.end() ? v : found->second;
  }

  void pass_on(VertexId v) {
    const VertexId kept = image(v);
    if (kept == v) return;
    edit_.merged.push_back({kept, v});
    t_.set_sharpness(kept, std::max(solid().vertex_sharpness(kept), solid().vertex_sharpness(v)));
  }

  void pass_on(EdgeId e) {
    const auto ends = solid().edge_vertices(e);
    std::vector<VertexId> chain{ends[0]};
    if (const auto cut = change_.cut_edges.find(e); cut != change_.cut_edges.end())
      chain.insert(chain.end(), cut->second.begin(), cut->second.end());
    chain.push_back(ends[1]);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const VertexId a = image(chain[i]), b = image(chain[i + 1]);
      if (a == b) continue;
      const auto made = solid().find_edge(a, b);
      if (!made || *made == e) continue;
      edit_.edges.push_back({*made, e});
      t_.set_sharpness(*made, std::max(solid().edge_sharpness(*made), solid().edge_sharpness(e)));
    }
  }

  void pass_on(FaceId f) {
    const auto loop = solid().face_vertices(f);
    const auto edges = solid().face_edges(f);
    std::vector<VertexId> there;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      there.push_back(image(loop[i]));
      const auto cut = change_.cut_edges.find(edges[i]);
      if (cut == change_.cut_edges.end()) continue;
      std::vector<VertexId> on_edge = cut->second;
      if (solid().edge_vertices(edges[i])[0] != loop[i]) std::reverse(on_edge.begin(), on_edge.end());
      for (const VertexId v : on_edge) there.push_back(image(v));
    }
    there.erase(std::unique(there.begin(), there.end()), there.end());
    while (there.size() > 1 && there.front() == there.back()) there.pop_back();
    pass_on(there, f);
  }

  void pass_on(const std::vector<VertexId>& loop, FaceId source) {
    if (loop.size() < 3) return;
    const auto made = solid().find_face(loop);
    if (!made || *made == source) return;
    edit_.faces.push_back({*made, source});
    t_.set_sharpness(*made, std::max(solid().face_sharpness(*made), solid().face_sharpness(source)));
  }

  void sweep() {
    for (const FaceId f : before_.faces)
      if (solid().is_live(f) && !solid().owner(face_use(f, false)).valid() &&
          !solid().owner(face_use(f, true)).valid())
        t_.remove_face(f);
    for (const EdgeId e : before_.edges)
      if (solid().is_live(e) && solid().edge_valence(e) == 0) t_.remove_edge(e);
    for (const VertexId v : before_.vertices)
      if (solid().is_live(v) && solid().vertex_valence(v) == 0) t_.remove_vertex(v);
  }

  // Where a cell vanishes, what others became may go with it.
  template <class IdType>
  void forget_what_was_swept(std::vector<Descent<IdType>>& descent) const {
    std::erase_if(descent, [&](const Descent<IdType>& d) { return !solid().is_live(d.made); });
  }

  Transaction& t_;
  const Rewrite& change_;
  Edit& edit_;
  Before before_;
  std::vector<VertexId> touched_;
};

// The fans of cells about a vertex, as surfaces.
class Links {
 public:
  Links(const Solid& solid, VertexId vertex)
      : solid_(solid),
        faces_(vertex_faces(solid, vertex)),
        cells_(vertex_cells(solid, vertex)),
        fans_(cells_.size()),
        rims_(faces_.size()),
        characteristic_(cells_.size(), 0) {
    for (const FaceId f : faces_)
      if (!solid.is_boundary(f) && owner_of(f).valid())
        fans_.unite(number(solid.owner(face_use(f, false))), number(solid.owner(face_use(f, true))));
    for (const CellId c : cells_) ++characteristic_[fans_.find(number(c))];
    for (const FaceId f : faces_)
      if (owner_of(f).valid()) --characteristic_[fans_.find(number(owner_of(f)))];
    for (const EdgeId e : vertex_edges(solid, vertex))
      for (const RadialFan& fan : radial_fans(solid, e)) {
        if (fan.cells.empty()) continue;
        ++characteristic_[fans_.find(number(fan.cells[0]))];
        if (!fan.closed) rims_.unite(number(fan.faces.front()), number(fan.faces.back()));
      }
  }

  // A surface of characteristic 2 less its holes lies on a sphere.
  bool spherical() {
    std::vector<int> holes(cells_.size(), 0);
    for (std::uint32_t i = 0; i < faces_.size(); ++i)
      if (solid_.is_boundary(faces_[i]) && rims_.find(i) == i) ++holes[fans_.find(number(owner_of(faces_[i])))];
    for (std::uint32_t i = 0; i < cells_.size(); ++i)
      if (fans_.find(i) == i && characteristic_[i] != 2 - holes[i]) return false;
    return true;
  }

 private:
  std::uint32_t number(CellId c) const { return static_cast<std::uint32_t>(place_in(cells_, c)); }
  std::uint32_t number(FaceId f) const { return static_cast<std::uint32_t>(place_in(faces_, f)); }
  CellId owner_of(FaceId f) const {
    const CellId front = solid_.owner(face_use(f, false));
    return front.valid() ? front : solid_.owner(face_use(f, true));
  }

  const Solid& solid_;
  std::vector<FaceId> faces_;
  std::vector<CellId> cells_;
  DisjointSets fans_, rims_;
  std::vector<int> characteristic_;  // by the first cell of a fan
};

}  // namespace

void rewrite(Transaction& transaction, const Rewrite& change, Edit& edit) {
  Rewriter(transaction, change, edit).run();
}

void drop_interior_sharpness(Transaction& transaction, std::span<const VertexId> vertices) {
  const Solid& solid = transaction.solid();
  for (const VertexId v : vertices) {
    bool keep_vertex = solid.is_boundary(v);
    for (const EdgeId e : vertex_edges(solid, v)) {
      bool on_sheet = false;
      solid.for_each_face(e, [&](FaceId f) { on_sheet = on_sheet || solid.face_sharpness(f) > 0; });
      if (!on_sheet && solid.edge_sharpness(e) > 0 && !solid.is_boundary(e)) transaction.set_sharpness(e, 0);
      keep_vertex = keep_vertex || on_sheet;
    }
    if (!keep_vertex) transaction.set_sharpness(v, 0);
  }
}

std::vector<std::vector<VertexId>> cell_loops(const Solid& solid, CellId cell) {
  std::vector<std::vector<VertexId>> loops;
  for (const FaceUseId use : solid.cell_face_uses(cell)) loops.push_back(use_vertices(solid, use));
  return loops;
}

std::string link_fault(const Solid& solid, VertexId vertex) {
  if (Links(solid, vertex).spherical()) return {};
  return fmt::format(
      "the cells about vertex {} would close around it like a ring, not like a ball; leave out a face there, or "
      "split the cells about it first",
      vertex.value);
}

void check_links(const Solid& solid, std::span<const VertexId> vertices) {
  for (const VertexId v : vertices)
    if (const std::string fault = link_fault(solid, v); !fault.empty())
      throw Error(ErrorCode::bad_topology, fault, fmt::format("vertex {}", v.value));
}

}  // namespace argil::subdiv
