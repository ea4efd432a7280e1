#pragma once
// Round base shapes of hexahedra. Their sections are disks without poles: a square core within rings of blocks, so
// that every cell keeps its corners open. The axis is z through the origin and the shapes stand on z = 0. Points of
// the surface lie on the true one; volumes and areas approach the true ones with the square of the cells' size.

#include "subdiv/build.h"

namespace argil::subdiv {

/// How many cells: around the outline (a multiple of 4; of a tube, 3 or more), along the axis, and layers from the
/// core outward (of a tube, through its wall).
struct RoundGrid {
  int around = 8, along = 2, rings = 1;
};

// Each throws Error (bad_input) for a length that is not positive and finite or a count out of range, saying what
// was expected, and (limit_exceeded) beyond 1e8 cells. Lengths [m]. Cost O(cells).
[[nodiscard]] Built cylinder(double radius, double height, const RoundGrid& grid = {});
/// @param inner radius of the hole, less than `radius`.
[[nodiscard]] Built tube(double radius, double inner, double height, const RoundGrid& grid = {});
/// Narrows to the radius `top`; where that is 0, the uppermost layer is of pyramids that meet in the apex, which is
/// the vertex of highest id.
[[nodiscard]] Built cone(double radius, double top, double height, const RoundGrid& grid = {});
/// A ring about z: `radius` from the axis to the middle of the body, `thickness` the radius of its section; `along`
/// counts around the axis, at least 3.
[[nodiscard]] Built torus(double radius, double thickness, const RoundGrid& grid = {.along = 16});
/// A core cube of (around / 4)³ cells within `rings` layers on its six sides; `along` means nothing.
[[nodiscard]] Built sphere(double radius, const RoundGrid& grid = {});

/// Cells of a section, and of a sphere.
[[nodiscard]] double disk_cell_count(const RoundGrid& grid);
[[nodiscard]] double sphere_cell_count(const RoundGrid& grid);

}  // namespace argil::subdiv
