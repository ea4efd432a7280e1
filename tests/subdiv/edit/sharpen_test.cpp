#include "subdiv/edit/sharpen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/error.h"
#include "subdiv/primitives.h"

namespace argil::subdiv {
namespace {

class Sharpen : public testing::Test {
 protected:
  ErrorCode code(auto id, double sharpness) {
    Transaction transaction(solid);
    try {
      sharpen(transaction, std::span<const decltype(id)>(std::array{decltype(id){0u}, id}), sharpness);
    } catch (const Error& error) {
      EXPECT_EQ(solid.edge_sharpness(EdgeId{0u}), 0);
      return error.code();
    }
    return ErrorCode::refused;
  }
  Solid solid = box_grid(2, 2, 2, {1, 1, 1}).solid;
  VertexId middle{13u}, top{22u};
};

TEST_F(Sharpen, SetsAndClearsTheBoundary) {
  const EdgeId edge = *solid.find_edge(VertexId{0u}, VertexId{1u});
  const std::uint64_t smooth = solid.topology_hash();
  Transaction transaction(solid);
  sharpen(transaction, std::array{edge}, k_infinitely_sharp);
  sharpen(transaction, std::array{top}, k_infinitely_sharp);
  EXPECT_EQ(solid.edge_sharpness(edge), k_infinitely_sharp);
  EXPECT_EQ(solid.vertex_sharpness(top), k_infinitely_sharp);
  EXPECT_NE(solid.topology_hash(), smooth);
  sharpen(transaction, std::array{edge}, 0);
  sharpen(transaction, std::array{top}, 0);
  EXPECT_EQ(solid.topology_hash(), smooth);
}

TEST_F(Sharpen, RefusesTheInteriorByName) {
  const EdgeId inner = *solid.find_edge(middle, top);
  EXPECT_EQ(code(inner, k_infinitely_sharp), ErrorCode::unsupported);
  EXPECT_EQ(code(middle, k_infinitely_sharp), ErrorCode::unsupported);
  EXPECT_EQ(code(inner, 0), ErrorCode::refused) << "smooth is what it is";
  Transaction transaction(solid);
  try {
    sharpen(transaction, std::array{inner}, k_infinitely_sharp);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("(vertices 13-22) is inside the solid"));
  }
}

TEST_F(Sharpen, MakesSheetsInsideAndTakesWhatIsOnThemAlongWhenTheyGo) {
  const FaceId inner = *solid.find_face(std::array{VertexId{4u}, VertexId{13u}, VertexId{14u}, VertexId{5u}});
  const FaceId outer = *solid.find_face(std::array{VertexId{0u}, VertexId{1u}, VertexId{4u}, VertexId{3u}});
  const EdgeId rim = *solid.find_edge(middle, VertexId{14u});
  const std::uint64_t smooth = solid.topology_hash();
  Transaction transaction(solid);
  try {
    sharpen(transaction, std::array{inner, outer}, 3);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_THAT(error.what(), testing::HasSubstr("is on the boundary"));
  }
  EXPECT_EQ(solid.topology_hash(), smooth);
  sharpen(transaction, std::array{inner}, 3);
  sharpen(transaction, std::array{rim}, 1.5);
  sharpen(transaction, std::array{middle}, 10);
  EXPECT_EQ(solid.face_sharpness(inner), 3);
  EXPECT_EQ(solid.edge_sharpness(rim), 1.5);
  sharpen(transaction, std::array{inner}, 0);
  EXPECT_EQ(solid.topology_hash(), smooth) << "nothing on the sheet outlives it";
}

TEST_F(Sharpen, RefusesValuesOutOfRangeAndDeadIds) {
  EXPECT_EQ(code(EdgeId{1u}, 2.5), ErrorCode::refused) << "semi-sharp is taken";
  EXPECT_EQ(code(EdgeId{1u}, -1), ErrorCode::bad_input);
  EXPECT_EQ(code(EdgeId{1u}, 10.5), ErrorCode::bad_input);
  EXPECT_EQ(code(VertexId{1u}, std::numeric_limits<double>::quiet_NaN()), ErrorCode::bad_input);
  EXPECT_EQ(code(EdgeId{1000u}, k_infinitely_sharp), ErrorCode::not_found);
}

}  // namespace
}  // namespace argil::subdiv
