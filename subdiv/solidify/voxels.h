#pragma once
// Which cubes of a grid a closed surface fills. Whether a point is inside is counted along lines: how often the
// surface is left, less how often it is entered, on the way out along x (the winding number). Which triangles a
// line crosses is decided edge by edge, the same way for both triangles at an edge, so that no line slips through.

#include <functional>

#include "subdiv/solidify/closed_surface.h"

namespace argil::subdiv {

struct Voxels {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // lowest corner [m]
  double size = 0;                                   // [m]
  std::array<int, 3> counts{};
  std::vector<std::uint8_t> samples_inside;  // of 27 in a cube; cube (i, j, k) is number (k ny + j) nx + i
  std::vector<std::uint8_t> filled;
  // Samples that the surface winds around more than once (it overlaps itself), or backwards (a part is inside out).
  std::size_t overlapping = 0, inside_out = 0;

  std::size_t number(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(counts[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(counts[0]) +
           static_cast<std::size_t>(i);
  }
  bool is_filled(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < counts[0] && j < counts[1] && k < counts[2] &&
           filled[number(i, j, k)] != 0;
  }
};

/// Cubes about the middle of the surface's box that cover it.
[[nodiscard]] Voxels voxel_grid(const ClosedSurface& surface, double size);
/// Fills the cubes of which half or more is inside. `progress` (may be empty) hears 0 … 1.
/// Cost O(triangles · lines across each + samples).
void fill(Voxels& voxels, const ClosedSurface& surface, const std::function<void(double)>& progress);
/// Fills more cubes until the boundary of what is filled is a manifold: no two cubes touch in an edge or a vertex
/// alone, inside or outside. Of the cubes at a fault one that mends it goes first, then the fullest. Returns how
/// many.
std::size_t make_manifold(Voxels& voxels);

}  // namespace argil::subdiv
