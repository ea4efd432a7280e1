#pragma once
// What the graphics card gets of a SceneSurface: vertices with normals that are smooth within regions and split at
// sharp edges, and triangles that fan each face about its middle.

#include <cstdint>
#include <vector>

#include "sculpt/renderer.h"

namespace argil::view {

struct SurfaceVertex {
  Eigen::Vector3f position, normal;
  float value = 0;
  float openness = 1;      // of the sky above, 0 … 1 (openness.h)
  std::uint32_t cell = 0;  // of a face's middle; the last corner of each triangle decides (flat)
  std::uint32_t cut = 0;   // 1: of a face that a cut laid open
};

struct SurfaceMesh {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> triangles;           // 3 each; the last is always a face's middle
  std::vector<std::uint32_t> vertex_from_corner;  // of the surface's corners
  // The same with quadrilaterals of two triangles, without middles and so without cells: half as many.
  std::vector<std::uint32_t> simple_triangles;
  bool is_closed = false;  // every edge has two faces, or more
};

/// `positions`: of the surface's vertices in the coordinates of the picture. Corners of a vertex share a normal
/// where they are joined through edges with exactly two faces that are neither sharp nor the rim of a cut. Normals
/// are weighted by angle and pointed by the faces' corners. Cost O(corners log corners).
[[nodiscard]] SurfaceMesh surface_mesh(const sculpt::SceneSurface& surface,
                                       const std::vector<Eigen::Vector3f>& positions);

/// Takes the mesh to where the vertices of the surface that it was made of are now, with its values. Which corners
/// share a normal stays as it was. Cost O(corners).
void move(SurfaceMesh& mesh, const sculpt::SceneSurface& surface, const std::vector<Eigen::Vector3f>& positions);

}  // namespace argil::view
