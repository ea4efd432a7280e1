#pragma once
// How the boundary of a solid is to look in files that hold more than its shape (glTF).

#include "io/surface.h"
#include "subdiv/solid.h"

namespace argil::sculpt {

/// Normals split at edges of sharpness ≥ 1. For the mesh of `surface_mesh` (export.h): corner for corner.
/// Cost O(solid).
[[nodiscard]] io::SurfaceLook surface_look(const subdiv::Solid& solid);

}  // namespace argil::sculpt
