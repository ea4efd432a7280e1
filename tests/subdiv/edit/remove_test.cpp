#include "subdiv/edit/remove.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/validate.h"

namespace argil::subdiv {
namespace {

TEST(Remove, TakesWhatNoOtherCellHolds) {
  Solid solid = box_grid(3, 1, 1, {3, 1, 1}).solid;
  Transaction transaction(solid);
  remove_cells(transaction, std::array{CellId{2u}, CellId{1u}});
  (void)transaction.commit();
  EXPECT_EQ(solid.vertex_count(), 8u);
  EXPECT_EQ(solid.edge_count(), 12u);
  EXPECT_EQ(solid.face_count(), 6u);
  EXPECT_EQ(solid.vertex_capacity(), 16u);
  EXPECT_THAT(validate(solid), testing::IsEmpty());
  for (const FaceId f : solid.faces()) EXPECT_TRUE(solid.is_boundary(f));
}

TEST(Remove, RefusesCellsThatAreNotThereAndChangesNothing) {
  Solid solid = box_grid(3, 1, 1, {3, 1, 1}).solid;
  const std::uint64_t before = solid.topology_hash();
  Transaction transaction(solid);
  EXPECT_THROW(remove_cells(transaction, std::array{CellId{0u}, CellId{3u}}), Error);
  EXPECT_THROW(remove_cells(transaction, std::array{CellId{0u}, CellId{0u}}), Error);
  EXPECT_EQ(solid.topology_hash(), before);
}

}  // namespace
}  // namespace argil::subdiv
