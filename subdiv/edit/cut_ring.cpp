#include "subdiv/edit/cut_ring.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "subdiv/build.h"
#include "subdiv/edit/cuts.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

using Place = std::array<int, 3>;  // in a hexahedron, each 0, 1 (the middle) or 2

// The vertices of a hexahedron as the corners of a cube.
struct Frame {
  std::vector<VertexId> vertices;  // VTK's order

  VertexId corner(int i, int j, int k) const {
    static constexpr std::array<std::size_t, 4> round{0, 1, 3, 2};
    return vertices[round[static_cast<std::size_t>(i + 2 * j)] + 4 * static_cast<std::size_t>(k)];
  }
  VertexId corner(const Place& place) const { return corner(place[0] / 2, place[1] / 2, place[2] / 2); }
};

// The four edges along an axis, each from its low end.
std::array<std::array<Place, 2>, 4> edges_along(std::size_t axis) {
  std::array<std::array<Place, 2>, 4> edges{};
  for (std::size_t n = 0; n < 4; ++n) {
    Place low{};
    low[(axis + 1) % 3] = n % 2 ? 2 : 0;
    low[(axis + 2) % 3] = n / 2 ? 2 : 0;
    Place high = low;
    high[axis] = 2;
    edges[n] = {low, high};
  }
  return edges;
}

// The six sides of a box, each counter-clockwise from outside.
std::array<std::array<Place, 4>, 6> sides_of(const Place& low, const Place& high) {
  std::array<std::array<Place, 4>, 6> sides{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      const std::size_t u = (axis + (far ? 1 : 2)) % 3, v = (axis + (far ? 2 : 1)) % 3;
      auto& side = sides[2 * axis + (far ? 1 : 0)];
      side.fill(low);
      for (Place& place : side) place[axis] = far ? high[axis] : low[axis];
      side[1][u] = side[2][u] = high[u];
      side[2][v] = side[3][v] = high[v];
    }
  return sides;
}

class RingCutter {
 public:
  RingCutter(Transaction& transaction, double fraction) : t_(transaction), fraction_(fraction) {}

  Edit run(const std::vector<EdgeId>& edges) {
    for (const EdgeId e : edges)
      if (edge_cells(solid(), e).empty())
        throw Error(
            ErrorCode::bad_topology,
            fmt::format("edge {} belongs to no cell; choose an edge of one (`remove dangling` sweeps such edges)",
                        e.value),
            fmt::format("edge {}", e.value));
    for (const EdgeId e : edges)
      if (!start_.count(e)) follow(e);
    for (const auto& [edge, start] : start_)
      cuts_.edges[edge] =
          add_blend(t_, {{start, 1 - fraction_}, {solid().other_vertex(edge, start), fraction_}}, edit_);
    for (const auto& [cell, frame] : frames_) cut(cell, frame);
    const Solid& before = solid();
    std::vector<std::array<VertexId, 3>> halves;
    for (const EdgeId e : edges)
      halves.push_back({before.edge_vertices(e)[0], cuts_.edges.at(e), before.edge_vertices(e)[1]});
    (void)apply_cuts(t_, cuts_, edit_);
    for (const auto& [a, middle, b] : halves)
      for (const VertexId end : {a, b}) edit_.next_edges.push_back(solid().find_edge(end, middle).value());
    std::sort(edit_.next_edges.begin(), edit_.next_edges.end());
    return std::move(edit_);
  }

 private:
  const Solid& solid() const { return t_.solid(); }

  void follow(EdgeId first) {
    start_[first] = std::min(solid().edge_vertices(first)[0], solid().edge_vertices(first)[1]);
    std::vector<EdgeId> open{first};
    while (!open.empty()) {
      const EdgeId e = open.back();
      open.pop_back();
      for (const CellId c : edge_cells(solid(), e)) {
        if (cell_kind(solid(), c) != CellKind::hexahedron) continue;
        Frame& frame = frames_[c];
        if (frame.vertices.empty()) frame.vertices = vtk_vertices(solid(), c);
        for (const auto& [edge, start] : parallel_edges(frame, e))
          if (const auto [known, added] = start_.emplace(edge, start); added)
            open.push_back(edge);
          else if (known->second != start && fraction_ != 0.5)
            throw Error(
                ErrorCode::bad_topology,
                fmt::format("the ring comes back the other way round at edge {}, so that it has no two sides; "
                            "cut it in the middle (fraction 0.5)",
                            edge.value),
                fmt::format("edge {}", edge.value));
      }
    }
  }

  // With the ends on the side of e's start.
  std::array<std::pair<EdgeId, VertexId>, 4> parallel_edges(const Frame& frame, EdgeId e) const {
    const VertexId start = start_.at(e), end = solid().other_vertex(e, start);
    std::array<std::pair<EdgeId, VertexId>, 4> result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto edges = edges_along(axis);
      for (const auto& [low, high] : edges) {
        const bool forward = frame.corner(low) == start && frame.corner(high) == end;
        if (!forward && !(frame.corner(low) == end && frame.corner(high) == start)) continue;
        for (std::size_t n = 0; n < 4; ++n) {
          const VertexId a = frame.corner(edges[n][0]), b = frame.corner(edges[n][1]);
          result[n] = {solid().find_edge(a, b).value(), forward ? a : b};
        }
        return result;
      }
    }
    return result;
  }

  void cut(CellId cell, const Frame& frame) {
    Place pieces{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = edges_along(axis)[0];
      pieces[axis] = start_.count(solid().find_edge(frame.corner(low), frame.corner(high)).value()) ? 2 : 1;
    }
    std::array<std::vector<Loop>, 6> parts;  // of the sides, from outside
    std::vector<std::vector<Loop>> children;
    middle_of_cell_ = VertexId{};
    Place at{};
    for (at[2] = 0; at[2] < pieces[2]; ++at[2])
      for (at[1] = 0; at[1] < pieces[1]; ++at[1])
        for (at[0] = 0; at[0] < pieces[0]; ++at[0]) {
          Place low{}, high{};
          for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = at[axis];
            high[axis] = pieces[axis] == 1 ? 2 : at[axis] + 1;
          }
          const auto sides = sides_of(low, high);
          std::vector<Loop> loops;
          for (std::size_t s = 0; s < 6; ++s) {
            Loop loop;
            for (const Place& place : sides[s]) loop.push_back(vertex(frame, place));
            if (sides[s][0][s / 2] == (s % 2 ? 2 : 0)) parts[s].push_back(loop);
            loops.push_back(std::move(loop));
          }
          children.push_back(std::move(loops));
        }
    cuts_.cells[cell] = std::move(children);
    const auto whole = sides_of({0, 0, 0}, {2, 2, 2});
    for (std::size_t s = 0; s < 6; ++s) {
      if (parts[s].size() == 1) continue;
      const FaceId face = face_at(frame, whole[s]);
      if (cuts_.faces.count(face)) continue;
      if (solid().owner(face_use(face, false)) != cell)
        for (Loop& loop : parts[s]) std::reverse(loop.begin(), loop.end());
      cuts_.faces[face] = std::move(parts[s]);
    }
  }

  FaceId face_at(const Frame& frame, const std::array<Place, 4>& side) const {
    Loop loop;
    for (const Place& place : side) loop.push_back(frame.corner(place));
    return solid().find_face(loop).value();
  }

  // The corner, or the middle of an edge, a side or the whole.
  VertexId vertex(const Frame& frame, const Place& place) {
    std::vector<std::size_t> free;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (place[axis] == 1) free.push_back(axis);
    if (free.empty()) return frame.corner(place);
    if (free.size() == 1) {
      Place low = place, high = place;
      low[free[0]] = 0;
      high[free[0]] = 2;
      return cuts_.edges.at(solid().find_edge(frame.corner(low), frame.corner(high)).value());
    }
    VertexId* known = &middle_of_cell_;
    if (free.size() == 2) {
      std::array<Place, 4> side{};
      for (std::size_t n = 0; n < 4; ++n) {
        side[n] = place;
        side[n][free[0]] = n == 1 || n == 2 ? 2 : 0;
        side[n][free[1]] = n >= 2 ? 2 : 0;
      }
      known = &middles_[face_at(frame, side)];
    }
    if (!known->valid()) *known = add_blend(t_, weights(frame, place, free), edit_);
    return *known;
  }

  // Multilinear in the corners.
  std::vector<std::pair<VertexId, double>> weights(const Frame& frame, const Place& place,
                                                   const std::vector<std::size_t>& free) const {
    std::vector<std::pair<VertexId, double>> result;
    for (std::size_t n = 0; n < std::size_t{1} << free.size(); ++n) {
      Place corner = place;
      double weight = 1;
      for (std::size_t i = 0; i < free.size(); ++i) {
        corner[free[i]] = n >> i & 1U ? 2 : 0;
        weight *= share(frame, corner, free[i]);
      }
      result.emplace_back(frame.corner(corner), weight);
    }
    return result;
  }

  // How much of the cut of the edge through this corner, along the axis, the corner takes.
  double share(const Frame& frame, const Place& corner, std::size_t axis) const {
    Place other = corner;
    other[axis] = 2 - other[axis];
    const EdgeId edge = solid().find_edge(frame.corner(corner), frame.corner(other)).value();
    return start_.at(edge) == frame.corner(corner) ? 1 - fraction_ : fraction_;
  }

  Transaction& t_;
  double fraction_;
  Edit edit_;
  Cuts cuts_;
  std::map<EdgeId, VertexId> start_;  // of the edges to cut, the end to count from
  std::map<CellId, Frame> frames_;    // of the hexahedra to cut
  std::map<FaceId, VertexId> middles_;
  VertexId middle_of_cell_;
};

}  // namespace

Edit cut_rings(Transaction& transaction, std::span<const EdgeId> edges, double fraction) {
  const auto sorted = checked(transaction.solid(), edges);
  if (!(fraction > 0 && fraction < 1))
    throw Error(ErrorCode::bad_input, fmt::format("expected a fraction between 0 and 1, found {}", fraction));
  return RingCutter(transaction, fraction).run(sorted);
}

}  // namespace argil::subdiv
