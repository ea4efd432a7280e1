#include "subdiv/boundary.h"

#include <algorithm>
#include <cassert>

#include "subdiv/disjoint_sets.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

struct EdgeCorner {
  EdgeId edge;
  std::uint32_t corner;  // where the surface's face runs along the edge
  friend auto operator<=>(const EdgeCorner&, const EdgeCorner&) = default;
};

class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const Solid& solid) : solid_(solid) {
    for (const FaceId f : solid.faces())
      if (solid.is_boundary(f)) add_face(solid.boundary_use(f));
    std::sort(at_edges_.begin(), at_edges_.end());
  }

  BoundarySurface run() {
    DisjointSets corner_sets(vertices_.size()), face_sets(surface_.faces.size());
    std::size_t edge_count = 0;
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
      corner_sets.unite(a, next_[b]);
      corner_sets.unite(next_[a], b);
      face_sets.unite(face_from_corner_[a], face_from_corner_[b]);
      ++edge_count;
    };
    for (std::size_t i = 0, end = 0; i < at_edges_.size(); i = end) {
      while (end < at_edges_.size() && at_edges_[end].edge == at_edges_[i].edge) ++end;
      if (end - i == 2) {
        join(at_edges_[i].corner, at_edges_[i + 1].corner);
        continue;
      }
      for (const RadialFan& fan : radial_fans(solid_, at_edges_[i].edge))
        if (!fan.closed && !fan.cells.empty())
          join(corner_of(fan.faces.front(), i, end), corner_of(fan.faces.back(), i, end));
    }
    number_vertices(corner_sets);
    surface_.component_count = face_sets.count();
    const auto characteristic = static_cast<long long>(surface_.vertex_from_surface.size()) -
                                static_cast<long long>(edge_count) + static_cast<long long>(surface_.faces.size());
    surface_.genus = static_cast<int>((2 * static_cast<long long>(surface_.component_count) - characteristic) / 2);
    return std::move(surface_);
  }

 private:
  void add_face(FaceUseId use) {
    const auto face = static_cast<std::uint32_t>(surface_.faces.size());
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    const auto stored = solid_.face_vertices(face_of(use));
    const auto edges = solid_.face_edges(face_of(use));
    const auto n = static_cast<std::uint32_t>(stored.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      // Reversed, corner i is the stored n − 1 − i, and the edge after it is the stored one before that.
      const std::uint32_t j = is_back(use) ? n - 1 - i : i;
      vertices_.push_back(stored[j]);
      at_edges_.push_back({edges[is_back(use) ? (j + n - 1) % n : j], first + i});
      next_.push_back(first + (i + 1) % n);
      face_from_corner_.push_back(face);
    }
    surface_.faces.push_back(use);
    surface_.offsets.push_back(vertices_.size());
  }

  std::uint32_t corner_of(FaceId face, std::size_t begin, std::size_t end) const {
    // Corners ascend at an edge, and faces with them.
    const auto first = at_edges_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = at_edges_.begin() + static_cast<std::ptrdiff_t>(end);
    const auto at = std::partition_point(first, last, [&](const EdgeCorner& e) {
      return face_of(surface_.faces[face_from_corner_[e.corner]]) < face;
    });
    assert(at != last && "a fan ends in a face that is not boundary");
    return at->corner;
  }

  void number_vertices(DisjointSets& corner_sets) {
    std::vector<std::pair<VertexId, std::uint32_t>> order;
    for (std::uint32_t c = 0; c < vertices_.size(); ++c)
      if (corner_sets.find(c) == c) order.emplace_back(vertices_[c], c);
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> number(vertices_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      number[order[i].second] = i;
      surface_.vertex_from_surface.push_back(order[i].first);
    }
    for (std::uint32_t c = 0; c < vertices_.size(); ++c) surface_.corners.push_back(number[corner_sets.find(c)]);
  }

  const Solid& solid_;
  BoundarySurface surface_;
  std::vector<VertexId> vertices_;  // of each corner
  std::vector<std::uint32_t> next_, face_from_corner_;
  std::vector<EdgeCorner> at_edges_;
};

}  // namespace

BoundarySurface boundary_surface(const Solid& solid) {
  return SurfaceBuilder(solid).run();
}

SurfaceTriangles triangulate(const BoundarySurface& surface) {
  SurfaceTriangles triangles;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto face = surface.face(f);
    for (std::size_t i = 2; i < face.size(); ++i) {
      triangles.corners.insert(triangles.corners.end(), {face[0], face[i - 1], face[i]});
      triangles.face_from_triangle.push_back(static_cast<std::uint32_t>(f));
    }
  }
  return triangles;
}

}  // namespace argil::subdiv
