#include <fmt/format.h>

#include <algorithm>

#include "io/surface.h"
#include "io/surface_sides.h"
#include "subdiv/disjoint_sets.h"
#include "subdiv/sort_unique.h"

namespace argil::io {
namespace {

// A side of a face: from corner `corner` to the next of the face.
struct Side {
  SurfaceReport::Edge edge;
  std::uint32_t face;
  std::size_t corner, next_corner;
  bool forward;  // runs from the lower vertex to the higher
};

bool is_broken(std::span<const std::uint32_t> face, std::size_t vertices) {
  if (face.size() < 3) return true;
  std::vector<std::uint32_t> sorted(face.begin(), face.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted.back() >= vertices || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

// By edge, then in the order of the faces.
std::vector<Side> sorted_sides(const SurfaceMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(mesh.corners.size());
  for (const SurfaceSide& s : surface_sides(mesh))
    sides.push_back(
        {{std::min(s.from, s.to), std::max(s.from, s.to)}, s.face, s.corner, s.next_corner, s.from < s.to});
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tie(a.edge, a.corner) < std::tie(b.edge, b.corner); });
  return sides;
}

void count_fans(const SurfaceMesh& mesh, subdiv::DisjointSets& fans, SurfaceReport& report) {
  std::vector<std::uint32_t> fan_of_vertex(static_cast<std::size_t>(mesh.positions.cols()),
                                           static_cast<std::uint32_t>(-1));
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    const std::uint32_t fan = fans.find(static_cast<std::uint32_t>(c));
    std::uint32_t& known = fan_of_vertex[mesh.corners[c]];
    if (known == static_cast<std::uint32_t>(-1))
      known = fan;
    else if (known != fan)
      report.non_manifold_vertices.push_back(mesh.corners[c]);
  }
  auto& vertices = report.non_manifold_vertices;
  subdiv::sort_unique(vertices);
}

std::string edge_words(const std::vector<SurfaceReport::Edge>& edges) {
  return fmt::format("{} edge{} (the first from vertex {} to {})", edges.size(), edges.size() == 1 ? "" : "s",
                     edges[0][0], edges[0][1]);
}

}  // namespace

SurfaceReport check_surface(const SurfaceMesh& mesh) {
  SurfaceReport report;
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v)
    if (!mesh.positions.col(v).allFinite()) report.infinite_vertices.push_back(static_cast<std::uint32_t>(v));
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (is_broken(mesh.face(f), static_cast<std::size_t>(mesh.positions.cols())))
      report.broken_faces.push_back(static_cast<std::uint32_t>(f));
  if (!report.sound()) return report;

  const std::vector<Side> sides = sorted_sides(mesh);
  subdiv::DisjointSets components(mesh.face_count()), fans(mesh.corners.size());
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].edge == sides[begin].edge) ++end;
    const Side& first = sides[begin];
    for (std::size_t s = begin; s < end; ++s) {
      components.unite(first.face, sides[s].face);
      // The corners of two faces at either end of their edge belong to one fan.
      const bool along = sides[s].forward == first.forward;
      fans.unite(static_cast<std::uint32_t>(first.corner),
                 static_cast<std::uint32_t>(along ? sides[s].corner : sides[s].next_corner));
      fans.unite(static_cast<std::uint32_t>(first.next_corner),
                 static_cast<std::uint32_t>(along ? sides[s].next_corner : sides[s].corner));
    }
    if (end - begin == 1)
      report.open_edges.push_back(first.edge);
    else if (end - begin > 2)
      report.non_manifold_edges.push_back(first.edge);
    else if (sides[begin + 1].forward == first.forward)
      report.misoriented_edges.push_back(first.edge);
  }
  report.component_count = components.count();
  count_fans(mesh, fans, report);
  return report;
}

std::string SurfaceReport::findings() const {
  std::vector<std::string> found;
  if (!broken_faces.empty())
    found.push_back(
        fmt::format("{} faces name a vertex twice or one that is not there (the first is face {}): mend "
                    "or remove them",
                    broken_faces.size(), broken_faces[0]));
  if (!infinite_vertices.empty())
    found.push_back(fmt::format("{} vertices are not finite (the first is {}): mend them", infinite_vertices.size(),
                                infinite_vertices[0]));
  if (!open_edges.empty())
    found.push_back(edge_words(open_edges) +
                    " have a face on one side only: fill the holes, or weld what is split");
  if (!misoriented_edges.empty())
    found.push_back(edge_words(misoriented_edges) + " lie between faces that turn against each other: flip some");
  if (!non_manifold_edges.empty())
    found.push_back(edge_words(non_manifold_edges) + " have more than two faces: separate the sheets there");
  if (!non_manifold_vertices.empty() && non_manifold_edges.empty())
    found.push_back(fmt::format("sheets touch at {} vertices (the first is {}): split them there",
                                non_manifold_vertices.size(), non_manifold_vertices[0]));
  return fmt::format("{}", fmt::join(found, "; "));
}

}  // namespace argil::io
