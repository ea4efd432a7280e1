#include "tools/view/surface_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

#include "subdiv/disjoint_sets.h"

namespace argil::view {

namespace {

constexpr std::uint32_t k_none = 0xffffffffU;

struct FaceEdge {
  std::array<std::uint32_t, 2> ends;    // surface vertices, ascending
  std::array<std::uint32_t, 2> corner;  // the face's corners at them
  std::uint32_t face;
};

bool is_cut(const sculpt::SceneSurface& surface, std::uint32_t face) {
  return !surface.cut_faces.empty() && surface.cut_faces[face] != 0;
}

std::vector<FaceEdge> face_edges(const sculpt::SceneSurface& surface) {
  std::vector<FaceEdge> edges;
  edges.reserve(surface.corners.size());
  for (std::uint32_t face = 0; face + 1 < surface.offsets.size(); ++face) {
    const auto first = static_cast<std::uint32_t>(surface.offsets[face]);
    const auto end = static_cast<std::uint32_t>(surface.offsets[face + 1]);
    for (std::uint32_t c = first; c < end; ++c) {
      const std::uint32_t next = c + 1 < end ? c + 1 : first;
      const std::uint32_t a = surface.corners[c], b = surface.corners[next];
      edges.push_back(a < b ? FaceEdge{{a, b}, {c, next}, face} : FaceEdge{{b, a}, {next, c}, face});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.corner < b.corner;
  });
  return edges;
}

/// Sets of corners that share a normal; `is_closed` becomes false if an edge has one face.
subdiv::DisjointSets join_corners(const sculpt::SceneSurface& surface, bool& is_closed) {
  auto sharp = surface.sharp_edges;
  for (auto& ends : sharp)
    if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
  std::sort(sharp.begin(), sharp.end());

  subdiv::DisjointSets sets(surface.corners.size());
  const std::vector<FaceEdge> edges = face_edges(surface);
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
    if (end - i == 1) is_closed = false;
    if (end - i != 2 || is_cut(surface, edges[i].face) != is_cut(surface, edges[i + 1].face)) continue;
    if (std::binary_search(sharp.begin(), sharp.end(), edges[i].ends)) continue;
    for (const int k : {0, 1}) sets.unite(edges[i].corner[k], edges[i + 1].corner[k]);
  }
  return sets;
}

Eigen::Vector3f normalised(const Eigen::Vector3f& v) {
  const float length = v.norm();
  if (!(length > 0)) return Eigen::Vector3f::UnitZ();
  return v / length;
}

/// Normal at corner b of a loop, as long as its angle.
Eigen::Vector3f corner_normal(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector3f u = c - b, v = a - b, cross = u.cross(v);
  const float length = cross.norm();
  if (!(length > 0)) return Eigen::Vector3f::Zero();
  return std::atan2(length, u.dot(v)) / length * cross;
}

}  // namespace

void move(SurfaceMesh& mesh, const sculpt::SceneSurface& surface, const std::vector<Eigen::Vector3f>& positions) {
  assert(positions.size() == surface.positions.size());
  assert(mesh.vertex_from_corner.size() == surface.corners.size());
  for (std::size_t c = 0; c < surface.corners.size(); ++c) {
    SurfaceVertex& vertex = mesh.vertices[mesh.vertex_from_corner[c]];
    const std::uint32_t v = surface.corners[c];
    vertex.position = positions[v];
    vertex.normal = Eigen::Vector3f::Zero();
    vertex.value = surface.values.empty() ? 0.0F : surface.values[v];
  }
  std::size_t middles = mesh.vertices.size();
  for (std::uint32_t face = 0; face + 1 < surface.offsets.size(); ++face) {
    const std::size_t first = surface.offsets[face], size = surface.offsets[face + 1] - first;
    if (size >= 3) --middles;
    for (std::size_t i = 0; i < size; ++i) {
      const auto at = [&](std::size_t k) { return positions[surface.corners[first + k % size]]; };
      mesh.vertices[mesh.vertex_from_corner[first + i]].normal += corner_normal(at(i + size - 1), at(i), at(i + 1));
    }
  }
  for (std::size_t i = 0; i < middles; ++i) mesh.vertices[i].normal = normalised(mesh.vertices[i].normal);

  for (std::uint32_t face = 0; face + 1 < surface.offsets.size(); ++face) {
    const std::size_t first = surface.offsets[face], size = surface.offsets[face + 1] - first;
    if (size < 3) continue;
    SurfaceVertex& middle = mesh.vertices[middles++];
    middle.position = middle.normal = Eigen::Vector3f::Zero();
    middle.value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const SurfaceVertex& corner = mesh.vertices[mesh.vertex_from_corner[first + i]];
      middle.position += corner.position / static_cast<float>(size);
      middle.normal += corner.normal;
      middle.value += corner.value / static_cast<float>(size);
    }
    middle.normal = normalised(middle.normal);
  }
}

SurfaceMesh surface_mesh(const sculpt::SceneSurface& surface, const std::vector<Eigen::Vector3f>& positions) {
  assert(surface.cell_from_face.size() + 1 == surface.offsets.size());
  SurfaceMesh mesh;
  mesh.is_closed = true;
  subdiv::DisjointSets sets = join_corners(surface, mesh.is_closed);
  std::vector<std::uint32_t> vertex_from_root(surface.corners.size(), k_none);
  mesh.vertex_from_corner.resize(surface.corners.size());
  for (std::uint32_t corner = 0; corner < surface.corners.size(); ++corner) {
    std::uint32_t& vertex = vertex_from_root[sets.find(corner)];
    if (vertex == k_none) {
      vertex = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back({Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()});
    }
    mesh.vertex_from_corner[corner] = vertex;
  }
  for (std::uint32_t face = 0; face + 1 < surface.offsets.size(); ++face) {
    const std::size_t first = surface.offsets[face], size = surface.offsets[face + 1] - first;
    if (size < 3) continue;
    const auto middle_index = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < size; ++i)
      for (const std::uint32_t v :
           {mesh.vertex_from_corner[first + i], mesh.vertex_from_corner[first + (i + 1) % size], middle_index})
        mesh.triangles.push_back(v);
    SurfaceVertex middle{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
    middle.cell = surface.cell_from_face[face];
    middle.cut = is_cut(surface, face) ? 1 : 0;
    mesh.vertices.push_back(middle);
    const std::uint32_t* corner = &mesh.vertex_from_corner[first];
    for (std::size_t i = 0; i < size; ++i) mesh.vertices[corner[i]].cut = middle.cut;  // rims are split
    if (size <= 4)
      for (std::size_t i = 2; i < size; ++i)
        mesh.simple_triangles.insert(mesh.simple_triangles.end(), {corner[0], corner[i - 1], corner[i]});
    else
      mesh.simple_triangles.insert(mesh.simple_triangles.end(),
                                   mesh.triangles.end() - static_cast<std::ptrdiff_t>(3 * size),
                                   mesh.triangles.end());
  }
  move(mesh, surface, positions);
  return mesh;
}

}  // namespace argil::view
