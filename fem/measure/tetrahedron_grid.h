#pragma once
// Where a point lies among tetrahedra, by a grid of boxes over them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace argil::fem {

/// A tetrahedron and the weights of its corners, which sum to 1; all ≥ −tolerance where it holds the point.
struct TetrahedronPoint {
  std::size_t tetrahedron = 0;
  std::array<double, 4> weights{};
};

class TetrahedronGrid {
 public:
  /// `points` 3 x points [m]. Tetrahedra without volume hold nothing. Copies both. Cost O(tetrahedra).
  TetrahedronGrid(const Eigen::Matrix3Xd& points, std::span<const std::array<std::uint32_t, 4>> corners);

  /// Where the point lies: among the tetrahedra that hold it to 1e-9, the first. If none does, the one that misses
  /// it least by its weights, as long as no weight is below −`slack`: a body whose surface is faceted otherwise is
  /// carried on a little. Cost O(tetrahedra in a box) expected.
  [[nodiscard]] std::optional<TetrahedronPoint> locate(const Eigen::Vector3d& point, double slack = 0) const;

 private:
  [[nodiscard]] std::array<int, 3> box_of(const Eigen::Vector3d& point) const;
  [[nodiscard]] std::size_t index(int i, int j, int k) const;

  Eigen::Matrix3Xd points_;
  std::vector<std::array<std::uint32_t, 4>> corners_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), high_ = Eigen::Vector3d::Zero();
  double size_ = 1;  // of a box [m]
  std::array<int, 3> count_{1, 1, 1};
  std::vector<std::size_t> offsets_;  // tetrahedra of each box
  std::vector<std::uint32_t> inside_;
};

}  // namespace argil::fem
