#include "subdiv/query/surface_tree.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "subdiv/boundary.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"

namespace {

using namespace argil::subdiv;

std::vector<std::array<std::uint32_t, 3>> unit_cube(Eigen::Matrix3Xd& positions) {
  const Built box = box_grid(3, 2, 4, {1, 1, 1});
  const BoundarySurface surface = boundary_surface(box.solid);
  positions.resize(3, static_cast<Eigen::Index>(surface.vertex_from_surface.size()));
  for (Eigen::Index v = 0; v < positions.cols(); ++v)
    positions.col(v) = box.positions.col(
        static_cast<Eigen::Index>(surface.vertex_from_surface[static_cast<std::size_t>(v)].index()));
  const SurfaceTriangles all = triangulate(surface);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = 0; i < all.corners.size(); i += 3)
    triangles.push_back({all.corners[i], all.corners[i + 1], all.corners[i + 2]});
  return triangles;
}

TEST(SurfaceTree, FindsTheNearestPointOfACube) {
  Eigen::Matrix3Xd positions;
  auto triangles = unit_cube(positions);
  triangles.push_back({0, 0, 1});  // no area: must not disturb
  const SurfaceTree tree(positions, triangles);
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = -1 + 3.0 * static_cast<double>(random()) / 4294967296.0;
    // Outside: clamp to the cube. Inside: the nearest side.
    Eigen::Vector3d expected = p.cwiseMax(0).cwiseMin(1);
    double distance = (expected - p).norm();
    if (distance == 0) distance = std::min(p.minCoeff(), 1 - p.maxCoeff());
    EXPECT_NEAR((tree.nearest(p) - p).norm(), distance, 1e-12);
  }
}

TEST(SurfaceTree, RefusesSurfacesThatAreNone) {
  Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, 3);
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}};
  EXPECT_THROW(SurfaceTree(positions, triangles), argil::Error);
  positions(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SurfaceTree(positions, triangles), argil::Error);
}

}  // namespace
