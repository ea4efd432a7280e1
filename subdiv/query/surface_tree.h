#pragma once
// Nearest points of a triangulated surface, by CGAL's tree of boxes. The only room that includes CGAL, behind plain
// types.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace argil::subdiv {

class SurfaceTree {
 public:
  /// `positions` 3 x vertices [m]; triangles without area are left out.
  /// @throws Error (bad_geometry) if no triangle has an area or a position in use is not finite. Cost O(n log n).
  SurfaceTree(const Eigen::Matrix3Xd& positions, std::span<const std::array<std::uint32_t, 3>> triangles);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;
  SurfaceTree& operator=(SurfaceTree&&) noexcept;

  /// The point of the surface nearest to `point` [m]. Cost O(log n) expected.
  [[nodiscard]] Eigen::Vector3d nearest(const Eigen::Vector3d& point) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace argil::subdiv
