#pragma once
// How the boundary of a solid is to look in files that hold more than its shape (glTF).

#include <string>

#include "io/surface.h"
#include "sculpt/document.h"

namespace argil::sculpt {

/// Normals split at edges of sharpness ≥ 1. For the mesh of `surface_mesh` (export.h): corner for corner.
/// Cost O(solid).
[[nodiscard]] io::SurfaceLook surface_look(const subdiv::Solid& solid);

/// Writes the surface of the finest level as .glb or .gltf, coloured from dark blue (lowest) over green to yellow
/// by a field that can be shown (measures.h). @throws Error (unsupported) for other formats, (not_found) for other
/// fields.
void save_coloured(const Document& document, const std::filesystem::path& path, const std::string& field);

}  // namespace argil::sculpt
