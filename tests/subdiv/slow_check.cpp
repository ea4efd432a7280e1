#include "slow_check.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "subdiv/disjoint_sets.h"

namespace argil::subdiv::test {

namespace {

using Pair = std::array<std::uint32_t, 2>;

Pair ordered(VertexId a, VertexId b) {
  return {std::min(a.value, b.value), std::max(a.value, b.value)};
}

// A corner of a cell: the cell at one of its vertices, or at one of its edges.
struct Corner {
  std::uint32_t at = 0;  // vertex, or number of the edge
  std::uint32_t cell = 0;
  friend auto operator<=>(const Corner&, const Corner&) = default;
};

std::vector<VertexId> loop_of(const Solid& solid, FaceUseId use) {
  const auto stored = solid.face_vertices(face_of(use));
  std::vector<VertexId> loop(stored.begin(), stored.end());
  if (is_back(use)) std::reverse(loop.begin(), loop.end());
  return loop;
}

class Check {
 public:
  Check(const Solid& solid, bool dangling) : solid_(solid), dangling_(dangling) {}

  std::vector<std::string> run() {
    check_faces();
    check_cells();
    check_use();
    return faults_;
  }

 private:
  void fault(const std::string& text) { faults_.push_back(text); }

  void check_faces() {
    std::set<std::vector<std::uint32_t>> loops;
    for (const FaceId f : solid_.faces()) {
      const auto loop = solid_.face_vertices(f);
      const auto edges = solid_.face_edges(f);
      std::vector<std::uint32_t> canonical;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        canonical.push_back(loop[i].value);
        if (!solid_.is_live(loop[i])) fault("a face has a dead vertex");
        if (!solid_.is_live(edges[i])) fault("a face has a dead edge");
        const auto& ends = solid_.edge_vertices(edges[i]);
        if (ordered(ends[0], ends[1]) != ordered(loop[i], loop[(i + 1) % loop.size()]))
          fault("an edge of a face does not join its corners");
        used_edges_.insert(edges[i].value);
        used_vertices_.insert(loop[i].value);
      }
      std::rotate(canonical.begin(), std::min_element(canonical.begin(), canonical.end()), canonical.end());
      if (canonical[1] > canonical.back()) std::reverse(canonical.begin() + 1, canonical.end());
      if (!loops.insert(canonical).second) fault("two faces have one loop");
      std::sort(canonical.begin(), canonical.end());
      if (std::adjacent_find(canonical.begin(), canonical.end()) != canonical.end())
        fault("a face has a vertex twice");
      const CellId front = solid_.owner(face_use(f, false)), back = solid_.owner(face_use(f, true));
      if (front.valid() && front == back) fault("a cell holds both sides of a face");
      if (!front.valid() && !back.valid() && !dangling_) fault("a face has no cell");
    }
    std::set<Pair> pairs;
    for (const EdgeId e : solid_.edges()) {
      const auto& ends = solid_.edge_vertices(e);
      if (ends[0] == ends[1]) fault("an edge is a loop");
      if (!pairs.insert(ordered(ends[0], ends[1])).second) fault("two edges join the same vertices");
    }
  }

  void check_cells() {
    std::size_t uses = 0;
    for (const CellId c : solid_.cells()) {
      std::map<Pair, std::array<int, 2>> runs;  // of an edge: upward and downward
      std::map<std::uint32_t, std::vector<std::uint32_t>> next_at;
      std::set<std::uint32_t> vertices;
      std::vector<std::vector<VertexId>> loops;
      for (const FaceUseId use : solid_.cell_face_uses(c)) {
        ++uses;
        if (!solid_.is_live(face_of(use)) || solid_.owner(use) != c) fault("a cell has a face that is not its own");
        loops.push_back(loop_of(solid_, use));
        for (std::size_t i = 0; i < loops.back().size(); ++i) {
          const VertexId a = loops.back()[i], b = loops.back()[(i + 1) % loops.back().size()];
          ++runs[ordered(a, b)][a < b ? 0 : 1];
          vertices.insert(a.value);
        }
      }
      for (const auto& [pair, count] : runs)
        if (count != std::array<int, 2>{1, 1}) fault("a cell does not close at an edge");
      if (static_cast<long long>(vertices.size()) - static_cast<long long>(runs.size()) +
              static_cast<long long>(loops.size()) !=
          2)
        fault("a cell is no sphere");
      // One fan of faces about every vertex of the cell.
      for (const std::uint32_t v : vertices) {
        std::map<std::uint32_t, std::uint32_t> turn;  // from the neighbour before to the neighbour after
        for (const auto& loop : loops)
          for (std::size_t i = 0; i < loop.size(); ++i)
            if (loop[i].value == v)
              turn[loop[(i + 1) % loop.size()].value] = loop[(i + loop.size() - 1) % loop.size()].value;
        std::size_t length = 0;
        std::uint32_t at = turn.begin()->first;
        do {
          at = turn[at];
          ++length;
        } while (at != turn.begin()->first && length <= turn.size());
        if (length != turn.size()) fault("a cell is pinched at a vertex");
      }
    }
    std::size_t owned = 0;
    for (const FaceId f : solid_.faces())
      for (const bool back : {false, true}) owned += solid_.owner(face_use(f, back)).valid() ? 1 : 0;
    if (owned != uses) fault("sides of faces are owned by cells that do not name them");
  }

  void check_use() {
    for (const EdgeId e : solid_.edges()) {
      if (!dangling_ && !used_edges_.contains(e.value)) fault("an edge has no face");
      for (const VertexId v : solid_.edge_vertices(e)) {
        if (!solid_.is_live(v)) fault("an edge has a dead vertex");
        used_vertices_.insert(v.value);
      }
    }
    for (const VertexId v : solid_.vertices())
      if (!dangling_ && !used_vertices_.contains(v.value)) fault("a vertex has no edge");
  }

  const Solid& solid_;
  bool dangling_;
  std::set<std::uint32_t> used_edges_, used_vertices_;
  std::vector<std::string> faults_;
};

// Corners of cells at vertices and at edges, joined where the cells share a face there.
struct Fans {
  explicit Fans(const Solid& solid) {
    for (const FaceId f : solid.faces()) {
      const auto loop = solid.face_vertices(f);
      for (std::size_t i = 0; i < loop.size(); ++i) edges.push_back(ordered(loop[i], loop[(i + 1) % loop.size()]));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const CellId c : solid.cells())
      for (const FaceUseId use : solid.cell_face_uses(c)) {
        const auto loop = loop_of(solid, use);
        for (std::size_t i = 0; i < loop.size(); ++i) {
          at_vertices.push_back({loop[i].value, c.value});
          at_edges.push_back({edge(loop[i], loop[(i + 1) % loop.size()]), c.value});
        }
      }
    for (auto* corners : {&at_vertices, &at_edges}) {
      std::sort(corners->begin(), corners->end());
      corners->erase(std::unique(corners->begin(), corners->end()), corners->end());
    }
    DisjointSets vertex_fans(at_vertices.size()), edge_fans(at_edges.size());
    for (const FaceId f : solid.faces()) {
      const CellId front = solid.owner(face_use(f, false)), back = solid.owner(face_use(f, true));
      if (!front.valid() && !back.valid()) continue;
      ++face_count;
      if (!front.valid() || !back.valid()) continue;
      const auto loop = solid.face_vertices(f);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        unite(vertex_fans, at_vertices, loop[i].value, front, back);
        unite(edge_fans, at_edges, edge(loop[i], loop[(i + 1) % loop.size()]), front, back);
      }
    }
    vertex_count = static_cast<long long>(vertex_fans.count());
    edge_count = static_cast<long long>(edge_fans.count());
    for (std::uint32_t i = 0; i < at_vertices.size(); ++i) vertex_fan.push_back(vertex_fans.find(i));
    for (std::uint32_t i = 0; i < at_edges.size(); ++i) edge_fan.push_back(edge_fans.find(i));
  }

  std::uint32_t edge(VertexId a, VertexId b) const {
    return static_cast<std::uint32_t>(std::lower_bound(edges.begin(), edges.end(), ordered(a, b)) - edges.begin());
  }
  bool has_contacts() const {
    std::size_t vertices = 0, used_edges = 0;
    for (std::size_t i = 0; i < at_vertices.size(); ++i)
      vertices += i == 0 || at_vertices[i].at != at_vertices[i - 1].at ? 1 : 0;
    for (std::size_t i = 0; i < at_edges.size(); ++i)
      used_edges += i == 0 || at_edges[i].at != at_edges[i - 1].at ? 1 : 0;
    return vertex_count > static_cast<long long>(vertices) || edge_count > static_cast<long long>(used_edges);
  }
  static std::uint32_t place(const std::vector<Corner>& corners, std::uint32_t at, CellId cell) {
    return static_cast<std::uint32_t>(std::lower_bound(corners.begin(), corners.end(), Corner{at, cell.value}) -
                                      corners.begin());
  }
  static void unite(DisjointSets& sets, const std::vector<Corner>& corners, std::uint32_t at, CellId a, CellId b) {
    sets.unite(place(corners, at, a), place(corners, at, b));
  }

  std::vector<Corner> at_vertices, at_edges;
  std::vector<std::uint32_t> vertex_fan, edge_fan;
  std::vector<Pair> edges;  // ascending
  long long vertex_count = 0, edge_count = 0, face_count = 0;
};

}  // namespace

std::vector<std::string> slow_check(const Solid& solid, bool dangling) {
  return Check(solid, dangling).run();
}

EulerRelation euler_relation(const Solid& solid) {
  const Fans fans(solid);
  EulerRelation relation;
  relation.contacts = fans.has_contacts();
  relation.solid =
      fans.vertex_count - fans.edge_count + fans.face_count - static_cast<long long>(solid.cell_count());

  // The boundary: its faces joined over the fans of edges, each open fan having two of them.
  std::map<std::uint32_t, std::vector<std::pair<std::size_t, std::size_t>>> sides;  // fan → (corner, next corner)
  std::vector<std::size_t> first;
  std::size_t corner_count = 0, face_count = 0;
  std::vector<std::size_t> face_of_corner;
  for (const FaceId f : solid.faces()) {
    if (!solid.is_boundary(f)) continue;
    const FaceUseId use = solid.boundary_use(f);
    const auto loop = loop_of(solid, use);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t number = fans.edge(loop[i], loop[(i + 1) % loop.size()]);
      const std::uint32_t fan = fans.edge_fan[Fans::place(fans.at_edges, number, solid.owner(use))];
      sides[fan].push_back({corner_count + i, corner_count + (i + 1) % loop.size()});
      face_of_corner.push_back(face_count);
    }
    corner_count += loop.size();
    ++face_count;
  }
  DisjointSets corners(corner_count), faces(face_count);
  for (const auto& [fan, runs] : sides) {
    if (runs.size() != 2) return {relation.solid, relation.solid + 1000000, 0, false};  // no surface at all
    corners.unite(static_cast<std::uint32_t>(runs[0].first), static_cast<std::uint32_t>(runs[1].second));
    corners.unite(static_cast<std::uint32_t>(runs[0].second), static_cast<std::uint32_t>(runs[1].first));
    faces.unite(static_cast<std::uint32_t>(face_of_corner[runs[0].first]),
                static_cast<std::uint32_t>(face_of_corner[runs[1].first]));
  }
  const long long characteristic = static_cast<long long>(corners.count()) - static_cast<long long>(sides.size()) +
                                   static_cast<long long>(face_count);
  const auto components = static_cast<long long>(faces.count());
  relation.genus = components - characteristic / 2;
  relation.boundary = components - relation.genus;
  return relation;
}

}  // namespace argil::subdiv::test
