#pragma once
// Geomview's OFF in text: vertices and polygons. Normals, colours and texture coordinates are passed over; the
// binary kind and other dimensions than three are refused by name.

#include <string>
#include <string_view>

#include "io/surface.h"

namespace argil::io {

/// @throws Error (bad_input) at file:line:column, (unsupported) for what is refused.
[[nodiscard]] SurfaceMesh read_off(std::string_view text, std::string_view name);
[[nodiscard]] std::string off_text(const SurfaceMesh& mesh);

}  // namespace argil::io
