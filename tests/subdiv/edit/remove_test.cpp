#include "subdiv/edit/remove.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/refinement_step.h"
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

TEST(Remove, KeepsWhatDanglesUntilItIsSwept) {
  Solid solid = box_grid(3, 1, 1, {3, 1, 1}).solid;
  const std::uint64_t before = solid.topology_hash();
  Transaction transaction(solid);
  remove_cells(transaction, std::array{CellId{2u}, CellId{1u}}, Dangling::keep);
  EXPECT_EQ(solid.vertex_count(), 16u);
  EXPECT_EQ(solid.face_count(), 16u);
  EXPECT_THAT(validate(solid), testing::IsEmpty());
  EXPECT_THROW((void)refine(solid), Error);
  const Swept swept = remove_dangling(transaction);
  EXPECT_EQ(swept.faces, 10u);
  EXPECT_EQ(swept.edges, 16u);
  EXPECT_EQ(swept.vertices, 8u);
  EXPECT_EQ(solid.face_count(), 6u);
  EXPECT_THAT(validate(solid), testing::IsEmpty());
  EXPECT_EQ(refine(solid).fine.cell_count(), 8u);
  transaction.roll_back();
  EXPECT_EQ(solid.topology_hash(), before);
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
