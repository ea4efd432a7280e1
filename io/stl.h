#pragma once
// STL, binary and in text: triangles. It is binary if its size is that of the triangles it counts, whatever it
// begins with; else text if it begins with "solid". Normals are passed over.

#include <string>
#include <string_view>

#include "io/surface.h"

namespace argil::io {

/// Equal vertices are one (−0 equals +0), numbered by first use; others can be joined by `weld`.
/// @throws Error (bad_input) at file:line:column or "file: byte N".
[[nodiscard]] SurfaceMesh read_stl(std::string_view bytes, std::string_view name);
/// Binary; polygons are triangulated about their first corner. @throws Error (unsupported) beyond the range of
/// single precision.
[[nodiscard]] std::string stl_bytes(const SurfaceMesh& mesh);

}  // namespace argil::io
