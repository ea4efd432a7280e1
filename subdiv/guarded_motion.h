#pragma once
// Moves vertices without closing the corners of cells: a vertex goes as far towards its target as the corners that
// it is part of stay open, or become no flatter than they were. The corner of a cell where three edges meet is open
// as far as the determinant of its unit edges is positive; where more meet, that of each three in a row.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

class GuardedMotion {
 public:
  /// Guards the corners of all cells at these vertices; `positions` 3 x vertex capacity [m]. Cost O(cells about
  /// them, log).
  GuardedMotion(const Solid& solid, Eigen::Matrix3Xd positions, std::span<const VertexId> vertices);

  const Eigen::Matrix3Xd& positions() const { return positions_; }
  Eigen::Vector3d at(VertexId v) const { return positions_.col(static_cast<Eigen::Index>(v.index())); }

  /// Moves one of the vertices the whole way to `target`, or by halves less, or not; true if it got there.
  bool move(VertexId vertex, const Eigen::Vector3d& target);
  /// The least open corner at one of the vertices: 1 for a box, 0 flat, negative inside out.
  [[nodiscard]] double openness(VertexId vertex) const { return openness(vertex, at(vertex)); }

 private:
  double openness(VertexId vertex, const Eigen::Vector3d& place) const;

  Eigen::Matrix3Xd positions_;
  std::vector<std::array<VertexId, 4>> corners_;  // the vertex and three neighbours, right-handed
  std::vector<VertexId> vertices_;                // ascending
  std::vector<std::size_t> offsets_;
  std::vector<std::uint32_t> corners_of_vertex_;
};

/// Takes vertices towards their targets (3 x vertices [m]) in a few rounds, and says how many did not arrive.
std::size_t move_guarded(GuardedMotion& motion, std::span<const VertexId> vertices,
                         const Eigen::Matrix3Xd& targets);

}  // namespace argil::subdiv
