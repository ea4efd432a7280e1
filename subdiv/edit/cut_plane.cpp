#include "subdiv/edit/cut_plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "subdiv/edit/cuts.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

[[noreturn]] void fail(CellId cell, const char* what) {
  throw Error(
      ErrorCode::bad_topology,
      fmt::format("the plane meets {} of cell {} more than once: the cell is not convex there, and its section "
                  "is not one loop; leave it out, or cut it by its faces first (`cut face`)",
                  what, cell.value),
      fmt::format("cell {}", cell.value));
}

class PlaneCutter {
 public:
  PlaneCutter(Transaction& transaction, const Eigen::Matrix3Xd& rest, const Plane& plane, double tolerance)
      : t_(transaction),
        rest_(rest),
        normal_(plane.normal / plane.normal.norm()),
        at_(plane.at),
        tolerance_(tolerance) {}

  Edit run(const std::vector<CellId>& cells) {
    for (const CellId c : cells)
      for (const VertexId v : cell_vertices(solid(), c)) height_.try_emplace(v, height(v));
    for (const CellId c : cells)
      for (const EdgeId e : cell_edges(solid(), c)) cut(e);
    for (const CellId c : cells)
      for (const FaceUseId use : solid().cell_face_uses(c)) cut(face_of(use), c);
    for (const CellId c : cells) cut(c);
    if (cuts_.cells.empty())
      throw Error(ErrorCode::bad_input,
                  "the plane parts none of the cells; move it with `at X Y Z`, or choose other cells");
    // What the plane leaves whole shares nothing that is cut, and keeps its id.
    std::vector<CellId> in_front;
    for (const CellId c : cells)
      if (!cuts_.cells.count(c) && lies_in_front(c)) in_front.push_back(c);
    for (const auto& [cell, parts] : apply_cuts(t_, cuts_, edit_)) in_front.push_back(parts[0]);
    std::sort(in_front.begin(), in_front.end());
    edit_.next_cells = std::move(in_front);
    return std::move(edit_);
  }

 private:
  const Solid& solid() const { return t_.solid(); }

  // Over the plane: 0 where the vertex counts as on it.
  double height(VertexId v) const {
    const double h = normal_.dot(rest_.col(static_cast<Eigen::Index>(v.index())) - at_);
    return std::abs(h) <= tolerance_ ? 0 : h;
  }
  int side(VertexId v) const {
    const auto found = height_.find(v);
    return found == height_.end() ? 0 : (found->second > 0) - (found->second < 0);
  }
  bool lies_in_front(CellId c) const {
    const auto vertices = cell_vertices(solid(), c);
    return std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) { return side(v) > 0; });
  }

  void cut(EdgeId e) {
    const auto [a, b] = solid().edge_vertices(e);
    if (side(a) * side(b) >= 0 || cuts_.edges.count(e)) return;
    const double t = height_.at(a) / (height_.at(a) - height_.at(b));
    cuts_.edges[e] = add_blend(t_, {{a, 1 - t}, {b, t}}, edit_);
  }

  // In front, from the vertex on the plane before it to the one after; and the rest.
  void cut(FaceId f, CellId cell) {
    if (cuts_.faces.count(f)) return;
    Loop loop = loop_with_cuts(solid(), cuts_, f);
    const auto has = [&](int wanted) {
      return std::any_of(loop.begin(), loop.end(), [&](VertexId v) { return side(v) == wanted; });
    };
    if (!has(1) || !has(-1)) return;
    // Begin at the first vertex in front after one behind.
    int before = -1;
    std::size_t start = 0, changes = 0;
    for (std::size_t i = 0; i < 2 * loop.size(); ++i) {
      const int here = side(loop[i % loop.size()]);
      if (here == 0) continue;
      if (i >= loop.size() && here != before) {
        ++changes;
        if (here > 0) start = i % loop.size();
      }
      before = here;
    }
    if (changes != 2) fail(cell, fmt::format("face {}", f.value).c_str());
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(start), loop.end());
    std::size_t last = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (side(loop[i]) > 0) last = i;
    Loop front{loop.back()}, rest{loop.begin() + static_cast<std::ptrdiff_t>(last) + 1, loop.end()};
    front.insert(front.end(), loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(last) + 2);
    cuts_.faces[f] = {front, rest};
  }

  void cut(CellId cell) {
    std::vector<Loop> front, behind;
    bool parted = false;
    for (const FaceUseId use : solid().cell_face_uses(cell)) {
      const auto parts = cuts_.faces.find(face_of(use));
      std::vector<Loop> loops = parts == cuts_.faces.end()
                                    ? std::vector<Loop>{loop_with_cuts(solid(), cuts_, face_of(use))}
                                    : parts->second;
      for (Loop& loop : loops) {
        if (is_back(use)) std::reverse(loop.begin(), loop.end());
        const bool in_front = std::any_of(loop.begin(), loop.end(), [&](VertexId v) { return side(v) > 0; });
        parted = parted || std::any_of(loop.begin(), loop.end(), [&](VertexId v) { return side(v) < 0; });
        (in_front ? front : behind).push_back(std::move(loop));
      }
    }
    if (front.empty() || !parted) return;
    Loop section = rim(front, cell);
    behind.push_back(section);
    std::reverse(section.begin(), section.end());
    front.push_back(std::move(section));
    cuts_.cells[cell] = {std::move(front), std::move(behind)};
  }

  // The one loop along which the faces in front end.
  static Loop rim(const std::vector<Loop>& front, CellId cell) {
    std::map<std::pair<VertexId, VertexId>, bool> directed;
    for (const Loop& loop : front)
      for (std::size_t i = 0; i < loop.size(); ++i) directed[{loop[i], loop[(i + 1) % loop.size()]}] = true;
    std::map<VertexId, VertexId> next;
    for (const auto& [edge, unused] : directed)
      if (!directed.count({edge.second, edge.first}) && !next.emplace(edge.first, edge.second).second)
        fail(cell, "a vertex");
    Loop loop;
    for (VertexId v = next.begin()->first; loop.empty() || v != loop[0]; v = next.at(v)) loop.push_back(v);
    if (loop.size() != next.size()) fail(cell, "the surface");
    return loop;
  }

  Transaction& t_;
  const Eigen::Matrix3Xd& rest_;
  Eigen::Vector3d normal_, at_;
  double tolerance_;
  Edit edit_;
  Cuts cuts_;
  std::map<VertexId, double> height_;
};

}  // namespace

Edit cut_plane(Transaction& transaction, const Eigen::Matrix3Xd& rest, std::span<const CellId> cells,
               const Plane& plane, double tolerance) {
  const auto sorted = checked(transaction.solid(), cells);
  if (!(plane.normal.norm() > 0))
    throw Error(ErrorCode::bad_input, "the plane's normal is zero; give the direction across the cut, as in 0 0 1");
  return PlaneCutter(transaction, rest, plane, tolerance).run(sorted);
}

}  // namespace argil::subdiv
