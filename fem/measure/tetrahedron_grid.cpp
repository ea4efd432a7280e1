#include "fem/measure/tetrahedron_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace argil::fem {

namespace {

constexpr double k_tolerance = 1e-9;

double six_volumes(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   const Eigen::Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

}  // namespace

TetrahedronGrid::TetrahedronGrid(const Eigen::Matrix3Xd& points,
                                 std::span<const std::array<std::uint32_t, 4>> corners)
    : points_(points), corners_(corners.begin(), corners.end()) {
  if (corners_.empty()) {
    offsets_.assign(2, 0);
    return;
  }
  low_.setConstant(HUGE_VAL);
  high_.setConstant(-HUGE_VAL);
  for (const auto& four : corners_)
    for (const std::uint32_t p : four) {
      low_ = low_.cwiseMin(points_.col(p));
      high_ = high_.cwiseMax(points_.col(p));
    }
  // About one box for each tetrahedron; flat bodies get no more boxes than that either.
  const Eigen::Vector3d extent = high_ - low_;
  const double longest = std::max({extent.x(), extent.y(), extent.z(), 1e-300});
  const double volume = std::max(extent.x(), 0.01 * longest) * std::max(extent.y(), 0.01 * longest) *
                        std::max(extent.z(), 0.01 * longest);
  size_ = std::cbrt(volume / static_cast<double>(corners_.size()));
  for (int axis = 0; axis < 3; ++axis)
    count_[static_cast<std::size_t>(axis)] = std::clamp(static_cast<int>(extent[axis] / size_) + 1, 1, 1000);

  const auto each_box = [&](std::size_t t, const auto& visit) {
    Eigen::Vector3d from = points_.col(corners_[t][0]), to = from;
    for (const std::uint32_t p : corners_[t]) {
      from = from.cwiseMin(points_.col(p));
      to = to.cwiseMax(points_.col(p));
    }
    const auto first = box_of(from), last = box_of(to);
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int k = first[2]; k <= last[2]; ++k) visit(index(i, j, k));
  };
  offsets_.assign(index(count_[0] - 1, count_[1] - 1, count_[2] - 1) + 2, 0);
  for (std::size_t t = 0; t < corners_.size(); ++t) each_box(t, [&](std::size_t box) { ++offsets_[box + 1]; });
  for (std::size_t box = 1; box < offsets_.size(); ++box) offsets_[box] += offsets_[box - 1];
  inside_.resize(offsets_.back());
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t t = 0; t < corners_.size(); ++t)
    each_box(t, [&](std::size_t box) { inside_[next[box]++] = static_cast<std::uint32_t>(t); });
}

std::array<int, 3> TetrahedronGrid::box_of(const Eigen::Vector3d& point) const {
  std::array<int, 3> box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double at = std::clamp((point[a] - low_[a]) / size_, 0.0, 1e6);
    box[axis] = std::min(static_cast<int>(at), count_[axis] - 1);
  }
  return box;
}

std::size_t TetrahedronGrid::index(int i, int j, int k) const {
  return (static_cast<std::size_t>(i) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(j)) *
             static_cast<std::size_t>(count_[2]) +
         static_cast<std::size_t>(k);
}

std::optional<TetrahedronPoint> TetrahedronGrid::locate(const Eigen::Vector3d& point, double slack) const {
  std::optional<TetrahedronPoint> best;
  double least = -std::max(slack, k_tolerance);
  const auto look = [&](std::size_t box) {
    for (std::size_t i = offsets_[box]; i < offsets_[box + 1]; ++i) {
      const auto& four = corners_[inside_[i]];
      const Eigen::Vector3d a = points_.col(four[0]), b = points_.col(four[1]), c = points_.col(four[2]),
                            d = points_.col(four[3]);
      const double whole = six_volumes(a, b, c, d);
      if (whole == 0) continue;
      const std::array<double, 4> weights{six_volumes(point, b, c, d) / whole, six_volumes(a, point, c, d) / whole,
                                          six_volumes(a, b, point, d) / whole, six_volumes(a, b, c, point) / whole};
      const double lowest = *std::min_element(weights.begin(), weights.end());
      const double counted = lowest >= -k_tolerance ? 0 : lowest;
      if (!(counted > least) && !(best && counted == least && inside_[i] < best->tetrahedron)) continue;
      least = counted;
      best = TetrahedronPoint{inside_[i], weights};
    }
  };
  if (!point.allFinite()) return best;
  const auto here = box_of(point);
  look(index(here[0], here[1], here[2]));
  if (least == 0 || slack <= 0) return best;
  for (int ring = 1; ring <= 2 && !best; ++ring)
    for (int i = std::max(here[0] - ring, 0); i <= std::min(here[0] + ring, count_[0] - 1); ++i)
      for (int j = std::max(here[1] - ring, 0); j <= std::min(here[1] + ring, count_[1] - 1); ++j)
        for (int k = std::max(here[2] - ring, 0); k <= std::min(here[2] + ring, count_[2] - 1); ++k)
          look(index(i, j, k));
  return best;
}

}  // namespace argil::fem
