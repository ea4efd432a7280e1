#include "subdiv/solidify/closed_surface.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "subdiv/disjoint_sets.h"
#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

// Numbers points by place, in order of their first appearance.
std::vector<std::uint32_t> weld(const Eigen::Matrix3Xd& positions, ClosedSurface& surface) {
  const auto count = static_cast<std::size_t>(positions.cols());
  std::vector<std::uint32_t> order(count), welded(count);
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) { return std::array{positions(0, i), positions(1, i), positions(2, i)}; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t i = 0; i < count; ++i)
    welded[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? welded[order[i - 1]] : order[i];
  std::uint32_t kept = 0;
  surface.positions.resize(3, positions.cols());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (welded[i] != i) {
      welded[i] = welded[welded[i]];  // the first of them comes before
      continue;
    }
    surface.positions.col(kept) = positions.col(i);
    welded[i] = kept++;
  }
  surface.positions.conservativeResize(3, kept);
  return welded;
}

void check_closed(const ClosedSurface& surface) {
  struct HalfEdge {
    std::uint32_t low, high;
    int direction;
  };
  std::vector<HalfEdge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  std::size_t open = 0, turned = 0;
  const HalfEdge *first_open = nullptr, *first_turned = nullptr;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    int sum = 0;
    for (; end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high; ++end)
      sum += edges[end].direction;
    if (sum == 0) continue;
    const bool odd = (end - begin) % 2 == 1;
    (odd ? open : turned) += 1;
    auto& first = odd ? first_open : first_turned;
    if (!first) first = &edges[begin];
  }
  const auto place = [&](const HalfEdge& e) {
    const Eigen::Vector3d p = (surface.positions.col(e.low) + surface.positions.col(e.high)) / 2;
    return fmt::format("at {:.6g} {:.6g} {:.6g}", p.x(), p.y(), p.z());
  };
  if (open > 0)
    throw Error(ErrorCode::bad_topology,
                fmt::format("the surface is open along {} edges; expected a closed surface, which has "
                            "an inside: close its holes and weld its points first",
                            open),
                place(*first_open));
  if (turned > 0)
    throw Error(ErrorCode::bad_topology,
                fmt::format("polygons on the two sides of {} edges disagree about which side is "
                            "outside; make the orientation of the polygons agree first",
                            turned),
                place(*first_turned));
}

}  // namespace

ClosedSurface closed_surface(const Eigen::Matrix3Xd& positions, std::span<const std::size_t> offsets,
                             std::span<const std::uint32_t> corners) {
  for (const std::uint32_t v : corners)
    if (!positions.col(v).allFinite())
      throw Error(ErrorCode::bad_geometry, "a point of the surface is not finite; repair the file",
                  fmt::format("vertex {}", v));
  ClosedSurface surface;
  const std::vector<std::uint32_t> welded = weld(positions, surface);
  for (std::size_t f = 0; f + 1 < offsets.size(); ++f)
    for (std::size_t i = offsets[f] + 1; i + 1 < offsets[f + 1]; ++i) {
      const std::array t{welded[corners[offsets[f]]], welded[corners[i]], welded[corners[i + 1]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) surface.triangles.push_back(t);
    }
  if (surface.triangles.empty())
    throw Error(ErrorCode::bad_geometry, "the surface has no polygons with an area, so it encloses nothing");
  check_closed(surface);

  DisjointSets parts(static_cast<std::size_t>(surface.positions.cols()));
  const Eigen::Vector3d middle = surface.positions.col(surface.triangles[0][0]);
  std::vector<std::uint8_t> used(static_cast<std::size_t>(surface.positions.cols()), 0);
  for (const auto& t : surface.triangles) {
    const Eigen::Vector3d a = surface.positions.col(t[0]) - middle, b = surface.positions.col(t[1]) - middle,
                          c = surface.positions.col(t[2]) - middle;
    surface.volume += a.dot(b.cross(c)) / 6;
    parts.unite(t[0], t[1]);
    parts.unite(t[0], t[2]);
    for (const std::uint32_t v : t) used[v] = 1;
  }
  for (std::uint32_t v = 0; v < used.size(); ++v) surface.component_count += used[v] && parts.find(v) == v ? 1 : 0;
  const double reach = (surface.positions.colwise() - middle).colwise().norm().maxCoeff();
  if (!(std::abs(surface.volume) > 1e-12 * reach * reach * reach))
    throw Error(ErrorCode::bad_geometry,
                "the surface encloses no volume, or as much inside out as not; make its orientation agree");
  if (surface.volume < 0) {
    surface.was_inward = true;
    surface.volume = -surface.volume;
    for (auto& t : surface.triangles) std::swap(t[1], t[2]);
  }
  return surface;
}

}  // namespace argil::subdiv
