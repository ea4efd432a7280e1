#include "subdiv/cell_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace argil::subdiv {

namespace {

struct DirectedEdge {
  std::uint32_t low, high;
  bool descending;       // runs from high to low
  std::uint32_t corner;  // where it starts
  friend auto operator<=>(const DirectedEdge&, const DirectedEdge&) = default;
};

std::string loop_fault(const CellLoops& loops) {
  std::vector<std::uint32_t> sorted;
  for (std::size_t f = 0; f < loops.face_count(); ++f) {
    const auto loop = loops.loop(f);
    if (loop.size() < 3) return fmt::format("face {} has {} vertices; a face needs at least 3", f, loop.size());
    sorted.assign(loop.begin(), loop.end());
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) return fmt::format("face {} names vertex {} twice (repeated vertex)", f, *twice);
  }
  return {};
}

std::string edge_fault(const std::vector<DirectedEdge>& edges, std::size_t begin, std::size_t end) {
  const auto& e = edges[begin];
  if (end - begin == 1)
    return fmt::format("the cell is open: edge {}-{} has one face, expected two; is a face missing?", e.low,
                       e.high);
  if (end - begin > 2)
    return fmt::format("{} faces of the cell meet at edge {}-{}, expected two; split the cell there", end - begin,
                       e.low, e.high);
  if (edges[begin].descending == edges[begin + 1].descending)
    return fmt::format(
        "two faces of the cell run the same way along edge {}-{} (incoherent orientation); give every face "
        "counter-clockwise from outside",
        e.low, e.high);
  return {};
}

}  // namespace

std::string sphere_fault(const CellLoops& loops) {
  if (loops.face_count() < 3)
    return fmt::format("the cell has {} faces; one that closes needs at least 3", loops.face_count());
  if (std::string fault = loop_fault(loops); !fault.empty()) return fault;

  const std::size_t n = loops.corners.size();
  std::vector<DirectedEdge> edges;
  edges.reserve(n);
  std::vector<std::uint32_t> next(n), face_from_corner(n);
  for (std::size_t f = 0; f < loops.face_count(); ++f)
    for (std::size_t c = loops.offsets[f]; c < loops.offsets[f + 1]; ++c) {
      const std::size_t d = c + 1 < loops.offsets[f + 1] ? c + 1 : loops.offsets[f];
      next[c] = static_cast<std::uint32_t>(d);
      face_from_corner[c] = static_cast<std::uint32_t>(f);
      const std::uint32_t a = loops.corners[c], b = loops.corners[d];
      edges.push_back({std::min(a, b), std::max(a, b), b < a, static_cast<std::uint32_t>(c)});
    }
  std::sort(edges.begin(), edges.end());

  std::vector<std::uint32_t> mate(n);  // the corner where the same edge starts the other way
  for (std::size_t i = 0, end = 0; i < n; i = end) {
    while (end < n && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    if (std::string fault = edge_fault(edges, i, end); !fault.empty()) return fault;
    mate[edges[i].corner] = edges[i + 1].corner;
    mate[edges[i + 1].corner] = edges[i].corner;
  }

  // Corners turn about their vertex in as many rings as the surface has sheets there.
  std::vector<std::uint8_t> seen(n, 0);
  std::vector<std::uint32_t> ring_vertices;
  for (std::uint32_t c = 0; c < n; ++c) {
    if (seen[c]) continue;
    ring_vertices.push_back(loops.corners[c]);
    for (std::uint32_t d = c; !seen[d]; d = next[mate[d]]) seen[d] = 1;
  }
  std::sort(ring_vertices.begin(), ring_vertices.end());
  const auto pinched = std::adjacent_find(ring_vertices.begin(), ring_vertices.end());
  if (pinched != ring_vertices.end())
    return fmt::format("the cell is pinched at vertex {}: its faces there make more than one fan; split the cell",
                       *pinched);

  std::vector<std::uint8_t> reached(loops.face_count(), 0);
  std::vector<std::size_t> stack{0};
  std::size_t reached_count = 1;
  reached[0] = 1;
  while (!stack.empty()) {
    const std::size_t f = stack.back();
    stack.pop_back();
    for (std::size_t c = loops.offsets[f]; c < loops.offsets[f + 1]; ++c) {
      const std::uint32_t g = face_from_corner[mate[c]];
      if (reached[g]) continue;
      reached[g] = 1;
      ++reached_count;
      stack.push_back(g);
    }
  }
  if (reached_count != loops.face_count())
    return "the faces of the cell make several closed surfaces, expected one sphere; list them as cells of their "
           "own";

  const auto characteristic = static_cast<long long>(ring_vertices.size()) - static_cast<long long>(n / 2) +
                              static_cast<long long>(loops.face_count());
  if (characteristic != 2)
    return fmt::format(
        "the surface of the cell has {} handles (V - E + F = {}, expected 2 of a sphere); split the cell",
        (2 - characteristic) / 2, characteristic);
  return {};
}

}  // namespace argil::subdiv
