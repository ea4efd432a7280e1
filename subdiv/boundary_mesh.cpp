#include "subdiv/boundary_mesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

// OpenMesh prints and gives up on such edges; they are found before it sees them.
void check_edges(const BoundarySurface& surface) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> directed;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto face = surface.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) directed.emplace_back(face[i], face[(i + 1) % face.size()]);
  }
  std::sort(directed.begin(), directed.end());
  const auto twice = std::adjacent_find(directed.begin(), directed.end());
  if (twice == directed.end()) return;
  const auto a = surface.vertex_from_surface[twice->first], b = surface.vertex_from_surface[twice->second];
  throw Error(
      ErrorCode::bad_topology,
      fmt::format("the boundary runs twice along edge {}-{}, which a half-edge mesh cannot hold; fill or open "
                  "the gap there",
                  a.value, b.value),
      fmt::format("edge {}-{}", a.value, b.value));
}

}  // namespace

BoundaryMesh boundary_mesh(const BoundarySurface& surface, const Eigen::Matrix3Xd& positions) {
  check_edges(surface);
  BoundaryMesh result;
  result.vertex_from_mesh = surface.vertex_from_surface;
  result.face_from_mesh = surface.faces;
  result.mesh.reserve(surface.vertex_from_surface.size(), surface.corners.size() / 2, surface.face_count());
  for (const VertexId v : surface.vertex_from_surface) {
    const Eigen::Vector3d p = positions.col(static_cast<Eigen::Index>(v.index()));
    result.mesh.add_vertex({p.x(), p.y(), p.z()});
  }
  std::vector<SurfaceMesh::VertexHandle> loop;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    loop.clear();
    for (const std::uint32_t v : surface.face(f)) loop.emplace_back(static_cast<int>(v));
    if (!result.mesh.add_face(loop).is_valid())
      throw Error(ErrorCode::bad_topology, fmt::format("OpenMesh cannot hold face {} of the boundary surface", f),
                  fmt::format("face {}", face_of(surface.faces[f]).value));
  }
  return result;
}

}  // namespace argil::subdiv
