#pragma once
// A closed triangulated surface from the polygons of a file, as `solidify` needs it.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace argil::subdiv {

struct ClosedSurface {
  Eigen::Matrix3Xd positions;                           // 3 x points, no two the same [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from outside
  double volume = 0;                                    // [m³]
  bool was_inward = false;                              // the polygons faced inward and were turned
  std::size_t component_count = 0;
};

/// Points at the very same place become one; polygons are fanned about their first corner; polygon i has corners
/// [offsets[i], offsets[i+1]).
/// @throws Error (bad_topology) naming an edge where the surface is open or its polygons disagree in orientation;
/// (bad_geometry) for a point that is not finite or a surface that encloses nothing. Cost O(corners log corners).
[[nodiscard]] ClosedSurface closed_surface(const Eigen::Matrix3Xd& positions, std::span<const std::size_t> offsets,
                                           std::span<const std::uint32_t> corners);

}  // namespace argil::subdiv
