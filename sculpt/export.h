#pragma once
// A document as files: the solid of a level with its fields and named sets, or its boundary surface.

#include <filesystem>
#include <string>
#include <vector>

#include "io/surface.h"
#include "io/volume_mesh.h"
#include "sculpt/document.h"
#include "sculpt/reference_shape.h"

namespace argil::sculpt {

/// Writes by the ending of the name; with a reference, the field `error` too. Returns what the format could not
/// hold and so was left out, in words.
/// @throws Error (unsupported) where the cells themselves cannot be held.
std::vector<std::string> save_document(const Document& document, const std::filesystem::path& path, int level,
                                       const io::WriteOptions& options = {},
                                       const ReferenceShape* reference = nullptr);

/// Boundary of a solid as polygons; non-manifold vertices have copies.
[[nodiscard]] io::SurfaceMesh surface_mesh(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions);

[[nodiscard]] bool is_surface_format(const std::filesystem::path& path);

}  // namespace argil::sculpt
