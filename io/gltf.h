#pragma once
// glTF 2.0 (Khronos, section numbers of the specification): one mesh of triangles in single precision, y upwards
// (§3.4), with unit normals that are smooth but for creases, and linear colours at the vertices if there are any.
// Vertices that creases split keep bitwise equal positions, so the surface stays closed.

#include <string>

#include "io/surface.h"

namespace argil::io {

/// One binary file (§4.4). @throws Error (unsupported) beyond the range of single precision or of 32 bits.
[[nodiscard]] std::string glb_bytes(const SurfaceMesh& mesh, const SurfaceLook& look);
/// JSON with the buffer inside, in base64. Throws alike.
[[nodiscard]] std::string gltf_text(const SurfaceMesh& mesh, const SurfaceLook& look);

}  // namespace argil::io
