#include "io/gltf_points.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/surface_sides.h"
#include "subdiv/disjoint_sets.h"
#include "subdiv/error.h"

namespace argil::io {
namespace {

std::vector<Eigen::Vector3d> area_normals(const SurfaceMesh& mesh) {
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const Eigen::Vector3d origin = mesh.positions.col(face[0]);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      normal += (mesh.positions.col(face[i]) - origin).cross(mesh.positions.col(face[i + 1]) - origin);
    normals.push_back(normal);
  }
  return normals;
}

bool comes_before(const SurfaceSide& a, const SurfaceSide& b) {
  return std::tie(a.from, a.to, a.corner) < std::tie(b.from, b.to, b.corner);
}

// Unites the corners of two faces at both ends of each smooth edge.
subdiv::DisjointSets smooth_corners(const SurfaceMesh& mesh, const SurfaceLook& look,
                                    const std::vector<Eigen::Vector3d>& normals) {
  std::vector<SurfaceSide> sides = surface_sides(mesh);
  std::sort(sides.begin(), sides.end(), comes_before);
  const double cosine = std::cos(look.crease_angle * std::numbers::pi / 180);
  const auto range_of = [&](std::uint32_t from, std::uint32_t to) {
    const auto first = std::lower_bound(sides.begin(), sides.end(), SurfaceSide{from, to, 0, 0, 0}, comes_before);
    auto last = first;
    while (last != sides.end() && last->from == from && last->to == to) ++last;
    return std::pair(first, last);
  };
  const auto is_sharp = [&](std::uint32_t corner) { return !look.sharp.empty() && look.sharp[corner] != 0; };
  subdiv::DisjointSets corners(mesh.corners.size());
  for (const SurfaceSide& side : sides) {
    if (side.from > side.to) continue;
    const auto [first, last] = range_of(side.from, side.to);
    const auto [back, back_end] = range_of(side.to, side.from);
    if (last - first != 1 || back_end - back != 1) continue;  // open, or where sheets touch
    const Eigen::Vector3d &a = normals[side.face], &b = normals[back->face];
    if (is_sharp(side.corner) || is_sharp(back->corner) || a.dot(b) < cosine * a.norm() * b.norm()) continue;
    corners.unite(side.corner, back->next_corner);
    corners.unite(side.next_corner, back->corner);
  }
  return corners;
}

}  // namespace

GltfPoints split_at_creases(const SurfaceMesh& mesh, const SurfaceLook& look) {
  subdiv::DisjointSets corners = smooth_corners(mesh, look, area_normals(mesh));
  GltfPoints points;
  points.point_from_corner.resize(mesh.corners.size());
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    const std::uint32_t first = corners.find(static_cast<std::uint32_t>(c));  // the lowest of its set
    if (first == c) {
      points.point_from_corner[c] = static_cast<std::uint32_t>(points.vertex_from_point.size());
      points.vertex_from_point.push_back(mesh.corners[c]);
    }
    points.point_from_corner[c] = points.point_from_corner[first];
  }
  return points;
}

std::vector<Eigen::Vector3d> point_normals(const SurfaceMesh& mesh, const GltfPoints& points) {
  const std::vector<Eigen::Vector3d> of_faces = area_normals(mesh);
  std::vector<Eigen::Vector3d> normals(points.count(), Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t c = mesh.offsets[f]; c < mesh.offsets[f + 1]; ++c)
      normals[points.point_from_corner[c]] += of_faces[f];
  for (Eigen::Vector3d& normal : normals) {
    const double length = normal.norm();
    normal = length > 0 && std::isfinite(length) ? Eigen::Vector3d(normal / length) : Eigen::Vector3d(0, 0, 1);
  }
  return normals;
}

void check_gltf_range(const SurfaceMesh& mesh) {
  const double largest = mesh.positions.size() == 0 ? 0 : mesh.positions.cwiseAbs().maxCoeff();
  if (largest > double{std::numeric_limits<float>::max()})
    throw Error(ErrorCode::unsupported,
                fmt::format("glTF holds single precision, which does not reach {}; write .ply", largest));
  if (mesh.corners.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorCode::unsupported,
                fmt::format("glTF cannot number {} corners of faces; write .ply", mesh.corners.size()));
}

}  // namespace argil::io
