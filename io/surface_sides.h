#pragma once
// The sides of a surface's faces: from each corner to the next.

#include <cstdint>
#include <vector>

#include "io/surface.h"

namespace argil::io {

struct SurfaceSide {
  std::uint32_t from, to;  // vertices
  std::uint32_t face, corner, next_corner;
};

/// In the order of the corners.
[[nodiscard]] inline std::vector<SurfaceSide> surface_sides(const SurfaceMesh& mesh) {
  std::vector<SurfaceSide> sides;
  sides.reserve(mesh.corners.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto first = static_cast<std::uint32_t>(mesh.offsets[f]);
    for (std::uint32_t i = 0; i < face.size(); ++i) {
      const auto j = static_cast<std::uint32_t>((i + 1) % face.size());
      sides.push_back({face[i], face[j], static_cast<std::uint32_t>(f), first + i, first + j});
    }
  }
  return sides;
}

}  // namespace argil::io
