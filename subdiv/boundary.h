#pragma once
// The boundary surface of a solid. Where it is not a manifold (an edge with more than two boundary faces, a vertex
// where sheets touch) its vertices have copies: the two boundary faces that bound one fan of cells at an edge are
// joined.

#include <cstdint>
#include <span>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

struct BoundarySurface {
  std::vector<FaceUseId> faces;               // boundary uses, ascending
  std::vector<std::size_t> offsets{0};        // face i has corners [offsets[i], offsets[i+1])
  std::vector<std::uint32_t> corners;         // surface vertices, counter-clockwise from outside
  std::vector<VertexId> vertex_from_surface;  // ascending; copies of a vertex name the same one
  std::size_t component_count = 0;            // connected through edges of the surface
  /// Genus summed over the components: each is closed and orientable.
  int genus = 0;

  std::size_t face_count() const { return faces.size(); }
  std::span<const std::uint32_t> face(std::size_t i) const {
    return {corners.data() + offsets[i], offsets[i + 1] - offsets[i]};
  }
};
/// Cost O(solid) to find the boundary, then O(its corners, log).
[[nodiscard]] BoundarySurface boundary_surface(const Solid& solid);

/// The surface as triangles, 3 surface vertices each, fanned about the first corner of each face (which suits
/// convex faces), with the face that each came from.
struct SurfaceTriangles {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> face_from_triangle;
};
[[nodiscard]] SurfaceTriangles triangulate(const BoundarySurface& surface);

}  // namespace argil::subdiv
