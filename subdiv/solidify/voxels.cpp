#include "subdiv/solidify/voxels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace argil::subdiv {

namespace {

constexpr int k_samples = 3;  // along each side of a cube

struct Crossing {
  double x;
  int sign;  // +1: leaves the inside towards +x
};

// Signed crossings of the ray from (y, z) towards +y with the directed edge a → b, both projected along x. The
// place is computed from the lower-numbered end, so both triangles at an edge get the same answer.
int edge_crossing(const Eigen::Matrix3Xd& positions, std::uint32_t a, std::uint32_t b, double y, double z) {
  const bool a_above = positions(2, a) > z, b_above = positions(2, b) > z;
  if (a_above == b_above) return 0;
  const std::uint32_t low = std::min(a, b), high = std::max(a, b);
  const double part = (z - positions(2, low)) / (positions(2, high) - positions(2, low));
  const double at = positions(1, low) + part * (positions(1, high) - positions(1, low));
  return at > y ? (b_above ? 1 : -1) : 0;
}

class Lines {
 public:
  Lines(const Voxels& voxels) : voxels_(voxels), step_(voxels.size / k_samples) {
    crossings_.resize(static_cast<std::size_t>(lines(1)) * static_cast<std::size_t>(lines(2)));
  }
  int lines(std::size_t axis) const { return k_samples * voxels_.counts[axis]; }
  double coordinate(int axis, int line) const { return voxels_.origin[axis] + (line + 0.5) * step_; }
  std::vector<Crossing>& of(int j, int k) {
    return crossings_[static_cast<std::size_t>(k) * static_cast<std::size_t>(lines(1)) +
                      static_cast<std::size_t>(j)];
  }

  void cross(const Eigen::Matrix3Xd& p, const std::array<std::uint32_t, 3>& t) {
    const Eigen::Vector3d a = p.col(t[0]), b = p.col(t[1]), c = p.col(t[2]);
    const Eigen::Vector3d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const auto first = [&](int axis) {
      return std::max(0, static_cast<int>(std::floor((low[axis] - voxels_.origin[axis]) / step_)) - 1);
    };
    const auto last = [&](int axis) {
      return std::min(lines(static_cast<std::size_t>(axis)) - 1,
                      static_cast<int>(std::ceil((high[axis] - voxels_.origin[axis]) / step_)) + 1);
    };
    for (int k = first(2); k <= last(2); ++k)
      for (int j = first(1); j <= last(1); ++j) {
        const double y = coordinate(1, j), z = coordinate(2, k);
        int sign = 0;
        for (std::size_t i = 0; i < 3; ++i) sign += edge_crossing(p, t[i], t[(i + 1) % 3], y, z);
        if (sign == 0) continue;
        const double x = a.x() - (normal.y() * (y - a.y()) + normal.z() * (z - a.z())) / normal.x();
        of(j, k).push_back({std::isnan(x) ? low.x() : std::clamp(x, low.x(), high.x()), sign});
      }
  }

 private:
  const Voxels& voxels_;
  double step_;
  std::vector<std::vector<Crossing>> crossings_;
};

// Whether the cubes of a 2 × 2 × 2 block that are (not) filled hang together through faces; bit 4z + 2y + x.
bool connected(unsigned block) {
  if (block == 0) return true;
  unsigned reached = block & (~block + 1);
  for (int i = 0; i < 7; ++i) {
    unsigned next = reached;
    for (unsigned cube = 0; cube < 8; ++cube)
      if (reached >> cube & 1U)
        for (const unsigned axis : {1U, 2U, 4U}) next |= 1U << (cube ^ axis);
    reached = next & block;
  }
  return reached == block;
}

}  // namespace

Voxels voxel_grid(const ClosedSurface& surface, double size) {
  Voxels voxels;
  voxels.size = size;
  const Eigen::Vector3d low = surface.positions.rowwise().minCoeff(), high = surface.positions.rowwise().maxCoeff();
  for (int axis = 0; axis < 3; ++axis) {
    const int count = std::max(1, static_cast<int>(std::ceil((high[axis] - low[axis]) / size - 1e-9)));
    voxels.counts[static_cast<std::size_t>(axis)] = count;
    voxels.origin[axis] = (low[axis] + high[axis] - count * size) / 2;
  }
  return voxels;
}

void fill(Voxels& voxels, const ClosedSurface& surface, const std::function<void(double)>& progress) {
  Lines lines(voxels);
  for (const auto& triangle : surface.triangles) lines.cross(surface.positions, triangle);
  voxels.samples_inside.assign(voxels.number(0, 0, voxels.counts[2]), 0);
  for (int k = 0; k < lines.lines(2); ++k) {
    if (progress) progress(static_cast<double>(k) / lines.lines(2));
    for (int j = 0; j < lines.lines(1); ++j) {
      auto& crossings = lines.of(j, k);
      std::sort(crossings.begin(), crossings.end(),
                [](const Crossing& a, const Crossing& b) { return a.x != b.x ? a.x < b.x : a.sign < b.sign; });
      int winding = 0;
      std::size_t next = 0;
      for (int i = 0; i < lines.lines(0); ++i) {
        for (; next < crossings.size() && crossings[next].x <= lines.coordinate(0, i); ++next)
          winding -= crossings[next].sign;
        if (winding > 0) ++voxels.samples_inside[voxels.number(i / k_samples, j / k_samples, k / k_samples)];
        voxels.overlapping += winding > 1 ? 1 : 0;
        voxels.inside_out += winding < 0 ? 1 : 0;
      }
    }
  }
  voxels.filled.clear();
  constexpr int k_half = (k_samples * k_samples * k_samples + 1) / 2;
  for (const std::uint8_t inside : voxels.samples_inside) voxels.filled.push_back(inside >= k_half ? 1 : 0);
}

std::size_t make_manifold(Voxels& voxels) {
  std::size_t added = 0;
  std::vector<std::array<int, 3>> to_check;
  for (int k = 0; k <= voxels.counts[2]; ++k)
    for (int j = 0; j <= voxels.counts[1]; ++j)
      for (int i = 0; i <= voxels.counts[0]; ++i) to_check.push_back({i, j, k});
  std::reverse(to_check.begin(), to_check.end());
  while (!to_check.empty()) {
    const auto [i, j, k] = to_check.back();
    to_check.pop_back();
    const auto cube = [i = i, j = j, k = k](unsigned bit) {
      return std::array{i - 1 + int(bit & 1U), j - 1 + int(bit >> 1 & 1U), k - 1 + int(bit >> 2 & 1U)};
    };
    unsigned block = 0;
    for (unsigned bit = 0; bit < 8; ++bit) {
      const auto c = cube(bit);
      if (voxels.is_filled(c[0], c[1], c[2])) block |= 1U << bit;
    }
    const auto sound = [](unsigned cubes) { return connected(cubes) && connected(~cubes & 0xffU); };
    if (sound(block)) continue;
    std::array<int, 3> best{-1, -1, -1};
    constexpr int k_more_than_any = k_samples * k_samples * k_samples + 1;
    int fullest = -1;
    for (unsigned bit = 0; bit < 8; ++bit) {
      const auto c = cube(bit);
      bool in_grid = (block >> bit & 1U) == 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        in_grid = in_grid && c[axis] >= 0 && c[axis] < voxels.counts[axis];
      if (!in_grid) continue;
      const bool enough = sound(block | 1U << bit);
      const int inside = voxels.samples_inside[voxels.number(c[0], c[1], c[2])] + (enough ? k_more_than_any : 0);
      if (inside > fullest) {
        fullest = inside;
        best = c;
      }
    }
    voxels.filled[voxels.number(best[0], best[1], best[2])] = 1;
    ++added;
    for (int dk = 1; dk >= 0; --dk)
      for (int dj = 1; dj >= 0; --dj)
        for (int di = 1; di >= 0; --di) to_check.push_back({best[0] + di, best[1] + dj, best[2] + dk});
  }
  return added;
}

}  // namespace argil::subdiv
