#pragma once
// The five regular bodies, each a single cell. Corners where four or five edges meet refine to irregular cells.

#include "subdiv/build.h"

namespace argil::subdiv {

enum class Platonic { tetrahedron, cube, octahedron, dodecahedron, icosahedron };

/// Stands with a face on z = 0, its middle above the origin; `radius` is that of the sphere through its corners
/// [m].
/// @throws Error (bad_input) if that is not positive and finite.
[[nodiscard]] Built platonic(Platonic body, double radius);

}  // namespace argil::subdiv
