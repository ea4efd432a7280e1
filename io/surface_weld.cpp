#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/surface.h"
#include "subdiv/disjoint_sets.h"

namespace argil::io {
namespace {

using Cell = std::array<double, 3>;  // of a grid, in whole numbers
struct Placed {
  Cell cell;
  std::uint32_t vertex;
  bool operator<(const Placed& other) const {
    return cell != other.cell ? cell < other.cell : vertex < other.vertex;
  }
};

std::vector<Placed> sorted_into_cells(const Eigen::Matrix3Xd& positions, double size) {
  std::vector<Placed> placed;
  placed.reserve(static_cast<std::size_t>(positions.cols()));
  for (Eigen::Index v = 0; v < positions.cols(); ++v) {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
      const double p = positions(axis, v) + 0.0;  // −0 becomes 0
      cell[static_cast<std::size_t>(axis)] = size > 0 ? std::floor(p / size) : p;
    }
    placed.push_back({cell, static_cast<std::uint32_t>(v)});
  }
  std::sort(placed.begin(), placed.end());
  return placed;
}

// Vertices of one cell are within the tolerance of each other; those of neighbouring cells may be.
subdiv::DisjointSets joined(const Eigen::Matrix3Xd& positions, double tolerance) {
  const double size = tolerance / 2;  // less than tolerance/√3: a cell's diagonal is within the tolerance
  const std::vector<Placed> placed = sorted_into_cells(positions, size);
  subdiv::DisjointSets sets(placed.size());
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (i == 0 || placed[i].cell != placed[i - 1].cell)
      starts.push_back(i);
    else
      sets.unite(placed[i].vertex, placed[i - 1].vertex);
  }
  starts.push_back(placed.size());
  if (!(tolerance > 0)) return sets;
  const auto meet = [&](std::size_t a, std::size_t a_end, std::size_t b, std::size_t b_end) {
    if (sets.find(placed[a].vertex) == sets.find(placed[b].vertex)) return;
    for (std::size_t i = a; i < a_end; ++i)
      for (std::size_t j = b; j < b_end; ++j) {
        if ((positions.col(placed[i].vertex) - positions.col(placed[j].vertex)).norm() > tolerance) continue;
        sets.unite(placed[i].vertex, placed[j].vertex);
        return;
      }
  };
  for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
    const Cell& cell = placed[starts[c]].cell;
    for (double x = 0; x <= 2; ++x)
      for (double y = -2; y <= 2; ++y) {
        // The cells of a row from z − 2 to z + 2 lie together; each pair is met once.
        const Cell low{cell[0] + x, cell[1] + y, cell[2] - 2}, high{cell[0] + x, cell[1] + y, cell[2] + 2};
        if (high < cell) continue;
        auto at = std::lower_bound(starts.begin() + static_cast<std::ptrdiff_t>(c), starts.end() - 1, low,
                                   [&](std::size_t s, const Cell& wanted) { return placed[s].cell < wanted; });
        for (; at + 1 != starts.end() && !(high < placed[*at].cell); ++at)
          if (*at != starts[c]) meet(starts[c], starts[c + 1], *at, at[1]);
      }
  }
  return sets;
}

}  // namespace

SurfaceMesh weld(const SurfaceMesh& mesh, double tolerance) {
  subdiv::DisjointSets sets = joined(mesh.positions, tolerance);
  constexpr auto k_unused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> new_from_old(static_cast<std::size_t>(mesh.positions.cols()), k_unused), kept, face;
  SurfaceMesh welded;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    face.clear();
    for (const std::uint32_t corner : mesh.face(f)) {
      const std::uint32_t vertex = sets.find(corner);
      if (face.empty() || face.back() != vertex) face.push_back(vertex);
    }
    while (face.size() > 1 && face.front() == face.back()) face.pop_back();
    if (face.size() < 3) continue;
    for (const std::uint32_t vertex : face) {
      if (new_from_old[vertex] == k_unused) {
        new_from_old[vertex] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(vertex);
      }
      welded.corners.push_back(new_from_old[vertex]);
    }
    welded.offsets.push_back(welded.corners.size());
  }
  welded.positions.resize(3, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t v = 0; v < kept.size(); ++v)
    welded.positions.col(static_cast<Eigen::Index>(v)) = mesh.positions.col(kept[v]);
  return welded;
}

}  // namespace argil::io
