#include "subdiv/query/surface_tree.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <string>
#include <vector>

#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

}  // namespace

struct SurfaceTree::Impl {
  Triangles triangles;
  Tree tree;
};

SurfaceTree::SurfaceTree(const Eigen::Matrix3Xd& positions, std::span<const std::array<std::uint32_t, 3>> triangles)
    : impl_(std::make_unique<Impl>()) {
  for (const auto& corners : triangles) {
    std::array<Kernel::Point_3, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = positions.col(corners[i]);
      if (!at.allFinite())
        throw Error(ErrorCode::bad_geometry, "a point of the surface is not finite",
                    "vertex " + std::to_string(corners[i]));
      points[i] = Kernel::Point_3(at[0], at[1], at[2]);
    }
    const Kernel::Triangle_3 triangle(points[0], points[1], points[2]);
    if (triangle.squared_area() > 0) impl_->triangles.push_back(triangle);
  }
  if (impl_->triangles.empty())
    throw Error(ErrorCode::bad_geometry, "the surface has no area, so nothing is near it; move its points apart");
  impl_->tree.insert(impl_->triangles.cbegin(), impl_->triangles.cend());
  impl_->tree.build();
}

SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

Eigen::Vector3d SurfaceTree::nearest(const Eigen::Vector3d& point) const {
  const Kernel::Point_3 found = impl_->tree.closest_point(Kernel::Point_3(point[0], point[1], point[2]));
  return {found.x(), found.y(), found.z()};
}

}  // namespace argil::subdiv
