#pragma once
// PLY in its three encodings: the vertices' x, y, z of any number type, and the faces' list vertex_indices (or
// vertex_index). Every other property and element is passed over by its declared size.

#include <string>
#include <string_view>

#include "io/surface.h"

namespace argil::io {

/// @throws Error (bad_input) at file:line:column or "file: byte N", (unsupported) for triangle strips.
[[nodiscard]] SurfaceMesh read_ply(std::string_view bytes, std::string_view name);
/// Binary little endian, double.
[[nodiscard]] std::string ply_bytes(const SurfaceMesh& mesh);

}  // namespace argil::io
