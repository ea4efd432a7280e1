#pragma once
// The vertices of a glTF surface: corners of faces share one unless a crease runs between them. Which they share is
// decided once, so that a surface that moves keeps its vertices.

#include <cstdint>
#include <vector>

#include "io/surface.h"

namespace argil::io {

struct GltfPoints {
  std::vector<std::uint32_t> point_from_corner;
  std::vector<std::uint32_t> vertex_from_point;

  std::size_t count() const { return vertex_from_point.size(); }
};

[[nodiscard]] GltfPoints split_at_creases(const SurfaceMesh& mesh, const SurfaceLook& look);

/// One a point, of unit length: the mean of its faces by area.
[[nodiscard]] std::vector<Eigen::Vector3d> point_normals(const SurfaceMesh& mesh, const GltfPoints& points);

/// @throws Error (unsupported) beyond the range of single precision or of 32 bits.
void check_gltf_range(const SurfaceMesh& mesh);

}  // namespace argil::io
