#include "subdiv/edge_walks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "subdiv/primitives.h"
#include "tests/shapes/shapes.h"

namespace argil::subdiv {
namespace {

TEST(EdgeWalks, ARingOfAGridIsTheSheetOfParallelEdges) {
  const Built grid = box_grid(3, 4, 5, {3, 4, 5});
  for (const EdgeId e : grid.solid.edges()) {
    const auto& ends = grid.solid.edge_vertices(e);
    const Eigen::Vector3d along = grid.positions.col(static_cast<Eigen::Index>(ends[1].index())) -
                                  grid.positions.col(static_cast<Eigen::Index>(ends[0].index()));
    Eigen::Index axis = 0;
    along.cwiseAbs().maxCoeff(&axis);
    const std::size_t n[] = {3, 4, 5};
    const std::size_t a = n[(axis + 1) % 3], b = n[(axis + 2) % 3];
    const bool boundary = grid.solid.is_boundary(e);
    EXPECT_EQ(edge_rings(grid.solid, {&e, 1}).size(), boundary ? 2 * (a + b) : (a + 1) * (b + 1));
  }
}

TEST(EdgeWalks, EveryMemberOfAWalkLeadsToTheSameWalk) {
  for (const test::Shape& shape : test::catalogue()) {
    const Solid& solid = shape.solid;
    for (const EdgeId e : solid.edges()) {
      const auto loop = edge_loops(solid, {&e, 1});
      EXPECT_TRUE(std::is_sorted(loop.begin(), loop.end())) << shape.name;
      for (const EdgeId other : loop) EXPECT_EQ(edge_loops(solid, {&other, 1}), loop) << shape.name;
      const auto ring = edge_rings(solid, {&e, 1});
      EXPECT_TRUE(std::binary_search(ring.begin(), ring.end(), e)) << shape.name;
    }
  }
}

}  // namespace
}  // namespace argil::subdiv
