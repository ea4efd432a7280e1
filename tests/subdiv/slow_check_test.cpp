#include "slow_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/boundary.h"
#include "tests/shapes/shapes.h"

namespace argil::subdiv::test {
namespace {

using testing::IsEmpty;

TEST(SlowCheck, EveryShapeOfTheCatalogueIsWholeAndKeepsEulersRelation) {
  for (const Shape& shape : catalogue()) {
    EXPECT_THAT(slow_check(shape.solid), IsEmpty()) << shape.name;
    const EulerRelation relation = euler_relation(shape.solid);
    EXPECT_EQ(relation.solid, relation.boundary) << shape.name;
    EXPECT_EQ(relation.genus, boundary_surface(shape.solid).genus) << shape.name;
  }
}

TEST(SlowCheck, TellsWhereCellsTouchWithoutAFace) {
  EXPECT_FALSE(euler_relation(box_grid(2, 2, 2, {1, 1, 1}).solid).contacts);
  EXPECT_TRUE(euler_relation(build(cubes({{0, 0, 0}, {1, 1, 0}})).solid).contacts);
  EXPECT_TRUE(euler_relation(build(cubes({{0, 0, 0}, {1, 1, 1}})).solid).contacts);
}

}  // namespace
}  // namespace argil::subdiv::test
