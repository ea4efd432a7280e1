#include "subdiv/guarded_motion.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::subdiv {

namespace {

// A corner as open as this may close to it.
constexpr double k_open = 0.15;
constexpr int k_halvings = 5, k_rounds = 4;

// Edges at a vertex of a cell in order, from corners (vertex, next, previous) of its outward loops: the next of one
// face is the previous of its neighbour.
void append_corners(const Solid& solid, CellId cell, std::vector<std::array<VertexId, 4>>& corners) {
  std::vector<std::array<VertexId, 3>> turns;
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto loop = use_vertices(solid, use);
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) turns.push_back({loop[i], loop[(i + 1) % n], loop[(i + n - 1) % n]});
  }
  std::sort(turns.begin(), turns.end());
  std::vector<VertexId> around;
  for (std::size_t begin = 0, end = 0; begin < turns.size(); begin = end) {
    while (end < turns.size() && turns[end][0] == turns[begin][0]) ++end;
    around.assign(1, turns[begin][1]);
    while (around.size() < end - begin)
      around.push_back((*std::lower_bound(turns.begin() + static_cast<std::ptrdiff_t>(begin),
                                          turns.begin() + static_cast<std::ptrdiff_t>(end),
                                          std::array{turns[begin][0], around.back(), VertexId{0u}}))[2]);
    const std::size_t n = around.size(), count = n == 3 ? 1 : n;
    for (std::size_t i = 0; i < count; ++i)
      corners.push_back({turns[begin][0], around[(i + 2) % n], around[(i + 1) % n], around[i]});
  }
}

}  // namespace

GuardedMotion::GuardedMotion(const Solid& solid, Eigen::Matrix3Xd positions, std::span<const VertexId> vertices)
    : positions_(std::move(positions)), vertices_(vertices.begin(), vertices.end()) {
  sort_unique(vertices_);
  std::vector<CellId> cells;
  for (const VertexId v : vertices_)
    for (const CellId c : vertex_cells(solid, v)) cells.push_back(c);
  sort_unique(cells);
  for (const CellId c : cells) append_corners(solid, c, corners_);
  std::vector<std::pair<VertexId, std::uint32_t>> uses;
  for (std::uint32_t i = 0; i < corners_.size(); ++i)
    for (const VertexId v : corners_[i]) uses.emplace_back(v, i);
  std::sort(uses.begin(), uses.end());
  std::size_t next = 0;
  for (const VertexId v : vertices_) {
    offsets_.push_back(corners_of_vertex_.size());
    while (next < uses.size() && uses[next].first < v) ++next;
    for (; next < uses.size() && uses[next].first == v; ++next) corners_of_vertex_.push_back(uses[next].second);
  }
  offsets_.push_back(corners_of_vertex_.size());
}

double GuardedMotion::openness(VertexId vertex, const Eigen::Vector3d& place) const {
  const auto index =
      static_cast<std::size_t>(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) - vertices_.begin());
  double least = 1;
  for (std::size_t i = offsets_[index]; i < offsets_[index + 1]; ++i) {
    const auto& corner = corners_[corners_of_vertex_[i]];
    std::array<Eigen::Vector3d, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = corner[k] == vertex ? place : at(corner[k]);
    const Eigen::Vector3d a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
    const double lengths = a.norm() * b.norm() * c.norm();
    least = std::min(least, lengths > 0 ? a.cross(b).dot(c) / lengths : 0);
  }
  return least;
}

bool GuardedMotion::move(VertexId vertex, const Eigen::Vector3d& target) {
  const Eigen::Vector3d from = at(vertex);
  if (from == target) return true;
  const double bound = std::min(k_open, openness(vertex, from));
  double part = 1;
  for (int i = 0; i <= k_halvings; ++i, part /= 2) {
    const Eigen::Vector3d place = i == 0 ? target : Eigen::Vector3d(from + part * (target - from));
    if (openness(vertex, place) < bound) continue;
    positions_.col(static_cast<Eigen::Index>(vertex.index())) = place;
    return i == 0;
  }
  return false;
}

std::size_t move_guarded(GuardedMotion& motion, std::span<const VertexId> vertices,
                         const Eigen::Matrix3Xd& targets) {
  std::size_t held = vertices.size();
  for (int round = 0; round < k_rounds && held > 0; ++round) {
    held = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      held += motion.move(vertices[i], targets.col(static_cast<Eigen::Index>(i))) ? 0 : 1;
  }
  return held;
}

}  // namespace argil::subdiv
