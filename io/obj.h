#pragma once
// Wavefront OBJ: vertices and polygons. Texture coordinates, normals, groups, materials, points and lines are
// passed over; free-form curves and surfaces are refused by name.

#include <string>
#include <string_view>

#include "io/surface.h"

namespace argil::io {

/// @throws Error (bad_input) at file:line:column, (unsupported) for free-form geometry.
[[nodiscard]] SurfaceMesh read_obj(std::string_view text, std::string_view name);
[[nodiscard]] std::string obj_text(const SurfaceMesh& mesh);

}  // namespace argil::io
