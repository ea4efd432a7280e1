#include "subdiv/edit/regions.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>

#include "subdiv/disjoint_sets.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/sort_unique.h"

namespace argil::subdiv {

namespace {

constexpr std::size_t k_none = static_cast<std::size_t>(-1);

auto column(const Eigen::Matrix3Xd& positions, VertexId v) {
  return positions.col(static_cast<Eigen::Index>(v.index()));
}

// The boundary face at the other end of the fan of cells that `face` ends.
FaceId across(const Solid& solid, FaceId face, EdgeId edge) {
  for (const RadialFan& fan : radial_fans(solid, edge)) {
    if (fan.closed) continue;
    if (fan.faces.front() == face) return fan.faces.back();
    if (fan.faces.back() == face) return fan.faces.front();
  }
  return {};
}

std::vector<EdgeId> use_edges(const Solid& solid, FaceUseId use) {
  const auto loop = use_vertices(solid, use);
  std::vector<EdgeId> edges;
  for (std::size_t i = 0; i < loop.size(); ++i)
    edges.push_back(solid.find_edge(loop[i], loop[(i + 1) % loop.size()]).value());
  return edges;
}

std::vector<VertexId> vertices_of(const Solid& solid, std::span<const FaceId> faces) {
  std::vector<VertexId> vertices;
  for (const FaceId f : faces)
    for (const VertexId v : solid.face_vertices(f)) vertices.push_back(v);
  sort_unique(vertices);
  return vertices;
}

// One region as a surface of its own.
struct Region {
  struct Neighbour {
    std::size_t face = k_none, corner = 0;  // the same edge there
  };
  Region(const Solid& solid, std::span<const FaceId> of) : faces(of.begin(), of.end()) {
    std::sort(faces.begin(), faces.end());
    vertices = vertices_of(solid, faces);
    std::vector<std::vector<EdgeId>> edges;
    for (const FaceId f : faces) {
      loops.push_back(use_vertices(solid, solid.boundary_use(f)));
      edges.push_back(use_edges(solid, solid.boundary_use(f)));
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      neighbours.emplace_back();
      for (const EdgeId e : edges[f]) {
        Neighbour found;
        const FaceId other = across(solid, faces[f], e);
        const auto at = std::lower_bound(faces.begin(), faces.end(), other);
        if (at != faces.end() && *at == other) {
          found.face = static_cast<std::size_t>(at - faces.begin());
          const auto& there = edges[found.face];
          found.corner = static_cast<std::size_t>(std::find(there.begin(), there.end(), e) - there.begin());
        }
        neighbours[f].push_back(found);
      }
    }
  }

  // Numbers that differ where the surroundings do: any match goes from one to an equal one.
  std::vector<std::uint64_t> signatures() const {
    constexpr int k_rounds = 12;
    std::vector<std::uint64_t> now(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) now[f] = mixed(0, loops[f].size());
    for (int round = 0; round < k_rounds; ++round) {
      std::vector<std::uint64_t> next(now);
      for (std::size_t f = 0; f < faces.size(); ++f) {
        std::vector<std::uint64_t> around;
        for (const Neighbour& n : neighbours[f]) around.push_back(n.face == k_none ? 0 : now[n.face]);
        std::sort(around.begin(), around.end());
        for (const std::uint64_t a : around) next[f] = mixed(next[f], a);
      }
      now = std::move(next);
    }
    return now;
  }

  std::vector<FaceId> faces;
  std::vector<VertexId> vertices;
  std::vector<std::vector<VertexId>> loops;
  std::vector<std::vector<Neighbour>> neighbours;

 private:
  static std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
    std::uint64_t x = a * 0x9e3779b97f4a7c15ULL + b + 0x7f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }
};

// Corner i of face f goes with corner offset − i of its image, and edge i with edge offset − i − 1.
struct Image {
  std::size_t face = k_none, offset = 0;
};

std::optional<std::vector<Image>> spread(const Region& first, const Region& second, std::size_t seed, Image to) {
  std::vector<Image> images(first.faces.size());
  std::vector<bool> taken(second.faces.size(), false);
  std::vector<std::size_t> front{seed};
  images[seed] = to;
  taken[to.face] = true;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const std::size_t f = front[i];
    const auto [g, offset] = images[f];
    const std::size_t n = first.loops[f].size();
    for (std::size_t e = 0; e < n; ++e) {
      const auto& here = first.neighbours[f][e];
      const auto& there = second.neighbours[g][(offset + 2 * n - e - 1) % n];
      if ((here.face == k_none) != (there.face == k_none)) return {};
      if (here.face == k_none) continue;
      const std::size_t size = first.loops[here.face].size();
      if (second.loops[there.face].size() != size) return {};
      const Image next{there.face, (here.corner + there.corner + 1) % size};
      Image& known = images[here.face];
      if (known.face == k_none) {
        if (taken[next.face]) return {};
        taken[next.face] = true;
        known = next;
        front.push_back(here.face);
      } else if (known.face != next.face || known.offset != next.offset) {
        return {};
      }
    }
  }
  return images;
}

// The second vertices in the order of the first ones, if the images of corners agree.
std::optional<std::vector<VertexId>> vertex_images(const Region& first, const Region& second,
                                                   const std::vector<Image>& images) {
  std::map<VertexId, VertexId> image, source;
  for (std::size_t f = 0; f < images.size(); ++f) {
    const auto& loop = first.loops[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const VertexId there = second.loops[images[f].face][(images[f].offset + loop.size() - i) % loop.size()];
      if (image.try_emplace(loop[i], there).first->second != there) return {};
      if (source.try_emplace(there, loop[i]).first->second != loop[i]) return {};
    }
  }
  std::vector<VertexId> result;
  for (const auto& [here, there] : image) {
    const bool shared = std::binary_search(second.vertices.begin(), second.vertices.end(), here) ||
                        std::binary_search(first.vertices.begin(), first.vertices.end(), there);
    if (shared && here != there) return {};
    result.push_back(there);
  }
  return result;
}

[[noreturn]] void refuse(const std::string& how) {
  throw Error(ErrorCode::bad_topology,
              "expected two regions of the same shape; " + how + "; choose regions that match, or split one first");
}

// Why two regions that do not match differ.
[[noreturn]] void explain(const Region& first, const Region& second) {
  if (first.faces.size() != second.faces.size())
    refuse(fmt::format("the first has {} and the second {} faces", first.faces.size(), second.faces.size()));
  const auto by_size = [](const Region& region) {
    std::vector<std::pair<std::size_t, FaceId>> sizes;
    for (std::size_t f = 0; f < region.faces.size(); ++f)
      sizes.emplace_back(region.loops[f].size(), region.faces[f]);
    std::sort(sizes.begin(), sizes.end());
    return sizes;
  };
  const auto a = by_size(first), b = by_size(second);
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].first != b[i].first)
      refuse(fmt::format("face {} of the first has {} vertices where face {} of the second has {}",
                         a[i].second.value, a[i].first, b[i].second.value, b[i].first));
  if (first.vertices.size() != second.vertices.size())
    refuse(
        fmt::format("the first has {} and the second {} vertices", first.vertices.size(), second.vertices.size()));
  refuse(first.faces.size() == 1 ? "their common vertices do not lie opposite each other"
                                 : "they have as many faces and vertices, but these hang together differently");
}

}  // namespace

void check_boundary_faces(const Solid& solid, std::span<const FaceId> faces, const char* to_do) {
  const auto where = [](FaceId f) { return fmt::format("face {}", f.value); };
  if (faces.empty())
    throw Error(ErrorCode::bad_input,
                fmt::format("expected boundary faces to {}, found none; select some first", to_do));
  for (const FaceId f : faces) {
    if (!solid.is_live(f))
      throw Error(ErrorCode::not_found, fmt::format("there is no face {}; select faces again", f.value), where(f));
    if (!solid.is_boundary(f))
      throw Error(ErrorCode::bad_topology,
                  fmt::format("expected boundary faces to {}, but face {} lies inside the solid; leave it out",
                              to_do, f.value),
                  where(f));
  }
  std::vector<FaceId> sorted(faces.begin(), faces.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    throw Error(ErrorCode::bad_input,
                fmt::format("face {} is given twice, or lies in both regions; name it once", twice->value),
                where(*twice));
}

std::vector<std::vector<FaceId>> patches(const Solid& solid, std::span<const FaceId> faces) {
  const Region all(solid, faces);
  DisjointSets sets(all.faces.size());
  for (std::size_t f = 0; f < all.faces.size(); ++f)
    for (const auto& neighbour : all.neighbours[f])
      if (neighbour.face != k_none)
        sets.unite(static_cast<std::uint32_t>(f), static_cast<std::uint32_t>(neighbour.face));
  std::map<std::uint32_t, std::vector<FaceId>> by_first;
  for (std::uint32_t f = 0; f < all.faces.size(); ++f) by_first[sets.find(f)].push_back(all.faces[f]);
  std::vector<std::vector<FaceId>> result;
  for (auto& [first, patch] : by_first) result.push_back(std::move(patch));
  return result;
}

std::array<std::vector<FaceId>, 2> two_regions(const Solid& solid, std::span<const FaceId> faces) {
  if (faces.size() == 2)
    return {std::vector{std::min(faces[0], faces[1])}, std::vector{std::max(faces[0], faces[1])}};
  auto found = patches(solid, faces);
  if (found.size() != 2)
    throw Error(ErrorCode::bad_input,
                fmt::format("expected faces that make two patches, found {}; select two, or select the first, name "
                            "the second with `select faces as NAME where …` and add `with NAME`",
                            found.size()));
  return {std::move(found[0]), std::move(found[1])};
}

RegionMatch match_regions(const Solid& solid, const Eigen::Matrix3Xd& positions, std::span<const FaceId> first,
                          std::span<const FaceId> second, const Eigen::Matrix3d& turn) {
  for (const auto& region : {first, second})
    if (const std::size_t count = patches(solid, region).size(); count != 1)
      throw Error(ErrorCode::bad_input,
                  fmt::format("expected each region to be one patch of faces connected through edges, found one of "
                              "{}; join them patch by patch",
                              count));
  const Region a(solid, first), b(solid, second);
  const auto signs_a = a.signatures(), signs_b = b.signatures();
  auto sorted_a = signs_a, sorted_b = signs_b;
  std::sort(sorted_a.begin(), sorted_a.end());
  std::sort(sorted_b.begin(), sorted_b.end());
  if (sorted_a != sorted_b) explain(a, b);

  // The rarest surroundings leave the fewest pairs to try.
  const auto count = [&](std::uint64_t sign) {
    const auto [begin, end] = std::equal_range(sorted_a.begin(), sorted_a.end(), sign);
    return end - begin;
  };
  std::size_t seed = 0;
  for (std::size_t f = 1; f < signs_a.size(); ++f)
    if (count(signs_a[f]) < count(signs_a[seed])) seed = f;

  const Eigen::Vector3d middle_a = middle(solid, positions, first), middle_b = middle(solid, positions, second);
  double size_squared = 0;
  for (const VertexId v : a.vertices) size_squared += (column(positions, v) - middle_a).squaredNorm();
  std::optional<std::vector<VertexId>> best;
  std::vector<Image> best_images;
  double least = 0;
  for (std::size_t g = 0; g < b.faces.size(); ++g) {
    if (signs_b[g] != signs_a[seed]) continue;
    for (std::size_t offset = 0; offset < b.loops[g].size(); ++offset) {
      const auto images = spread(a, b, seed, {g, offset});
      if (!images) continue;
      auto vertices = vertex_images(a, b, *images);
      if (!vertices) continue;
      double sum = 0;
      for (std::size_t i = 0; i < vertices->size(); ++i)
        sum +=
            (turn * (column(positions, a.vertices[i]) - middle_a) - (column(positions, (*vertices)[i]) - middle_b))
                .squaredNorm();
      const double same = 1e-9 * size_squared;
      if (!best || sum < least - same || (sum < least + same && *vertices < *best)) {
        least = sum;
        best = std::move(vertices);
        best_images = *images;
      }
    }
  }
  if (!best) explain(a, b);
  RegionMatch match;
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    match.faces.emplace_back(a.faces[f], b.faces[best_images[f].face]);
  for (std::size_t i = 0; i < a.vertices.size(); ++i) match.vertices.emplace_back(a.vertices[i], (*best)[i]);
  return match;
}

Eigen::Vector3d area_vector(const Solid& solid, const Eigen::Matrix3Xd& positions, std::span<const FaceId> faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const FaceId f : faces) {
    const auto loop = use_vertices(solid, solid.boundary_use(f));
    const Eigen::Vector3d from = column(positions, loop[0]);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += (column(positions, loop[i]) - from).cross(column(positions, loop[i + 1]) - from) / 2;
  }
  return sum;
}

Eigen::Vector3d middle(const Solid& solid, const Eigen::Matrix3Xd& positions, std::span<const FaceId> faces) {
  const auto vertices = vertices_of(solid, faces);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const VertexId v : vertices) sum += column(positions, v);
  return sum / static_cast<double>(vertices.size());
}

}  // namespace argil::subdiv
