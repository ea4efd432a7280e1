#pragma once
// A solid of hexahedra within a closed surface: cubes that are inside, layers of cells between them and the surface
// (so that no cell has two flat sides on it; Mitchell & Tautges 1995, "pillowing"), vertices on the surface and
// smoothed where that keeps every corner open.

#include <functional>

#include "subdiv/build.h"
#include "subdiv/solidify/closed_surface.h"

namespace argil::subdiv {

struct SolidifyOptions {
  double cell_size = 0.1;  // [m]
  int layers = 1;          // between the cubes and the surface; 0: the cubes' own sides go to it
  int rounds = 12;         // of going to the surface and smoothing
};

struct Solidified {
  Built built;
  std::size_t added_cubes = 0;  // to make the boundary a manifold
  std::size_t overlapping_samples = 0, inside_out_samples = 0;
  std::size_t component_count = 0;
  std::size_t off_surface = 0;  // boundary vertices held back from the surface
  double largest_gap = 0;       // from a point of the surface to the nearest of the solid's boundary [m]
};

/// How many cubes cover the surface's box: at least as many as will be cells but for the layers.
[[nodiscard]] double box_cell_count(const ClosedSurface& surface, double cell_size);

/// @throws Error (bad_geometry) where no cube is inside: the surface is thinner than the cells everywhere.
/// `progress` (may be empty) hears 0 … 1 and what is done. Cost O(triangles + cells of the box, log).
[[nodiscard]] Solidified solidify(const ClosedSurface& surface, const SolidifyOptions& options,
                                  const std::function<void(double, const char*)>& progress = {});

}  // namespace argil::subdiv
