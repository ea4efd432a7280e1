#include "sculpt/region.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// 3×2×1 unit cells: 24 vertices, 46 edges, 29 faces (22 of the boundary), 6 cells.
const std::vector<std::string> k_grid = {"new box 3 2 1 size 3 2 1"};

std::size_t selected(TestSession& session, const std::string& line) {
  session.run({"select " + line});
  return session.state().selection->ids.size();
}

TEST(Region, WithoutAConditionEverythingIsMeant) {
  TestSession session(k_grid);
  EXPECT_EQ(selected(session, "vertices"), 24U);
  EXPECT_EQ(selected(session, "edges"), 46U);
  EXPECT_EQ(selected(session, "faces"), 22U);
  EXPECT_EQ(selected(session, "faces interior"), 29U);
  EXPECT_EQ(selected(session, "cells"), 6U);
  EXPECT_EQ(selected(session, "nodes"), 24U);
  session.run({"levels 1"});
  EXPECT_EQ(selected(session, "nodes"), 7U * 5 * 3);
  EXPECT_EQ(selected(session, "vertices"), 24U);
}

TEST(Region, ConditionsAreAskedAtTheCentroidUnlessAnyOrAllIsSaid) {
  TestSession session(k_grid);
  EXPECT_EQ(selected(session, "vertices where x < 0.5"), 6U);
  EXPECT_EQ(selected(session, "cells where x < 0.75"), 2U);
  EXPECT_EQ(selected(session, "cells all where x < 0.75"), 0U);
  EXPECT_EQ(selected(session, "cells any where x < 0.75"), 2U);
  EXPECT_EQ(selected(session, "cells any where x < 1.25"), 4U);
  EXPECT_EQ(selected(session, "cells all where x < 1.25"), 2U);
  // x = 0: two faces; with centroids at x = 1/2: four above and below, two at the sides; the wall at 1 is inside.
  EXPECT_EQ(selected(session, "faces where x < 0.75"), 2U + 4 + 2);
  EXPECT_EQ(selected(session, "faces all where x < 0.75"), 2U);
  EXPECT_EQ(selected(session, "faces where x = 1"), 0U);
  EXPECT_EQ(selected(session, "faces interior where x = 1"), 2U);
  EXPECT_EQ(selected(session, "edges where x = 0.5 and y = 0"), 2U);
  EXPECT_EQ(selected(session, "edges any where x = 0 and y = 0 and z = 0"), 3U);
}

TEST(Region, BoundaryAndValenceAreThoseOfTheElement) {
  TestSession session({"new box 3 3 3 size 3 3 3"});
  EXPECT_EQ(selected(session, "vertices where not boundary"), 8U);
  EXPECT_EQ(selected(session, "edges where not boundary"), 4U * 3 * 3);
  EXPECT_EQ(selected(session, "faces interior where not boundary"), 54U);
  EXPECT_EQ(selected(session, "cells where not boundary"), 1U);
  EXPECT_EQ(selected(session, "vertices where valence = 3"), 8U);
  EXPECT_EQ(selected(session, "edges where valence = 2"), 36U);
  EXPECT_EQ(selected(session, "faces where valence = 4"), 54U);
  EXPECT_EQ(selected(session, "cells where valence = 6"), 27U);
}

TEST(Region, RestAndPresentCoordinatesAreApart) {
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2", "levels 1", "gravity 0 0 -10", "step 6 dt 0.1"});
  // Free fall by BDF2 is about 1.8 m; the rest stays.
  EXPECT_EQ(selected(session, "vertices where pz < -1"), 27U);
  EXPECT_EQ(selected(session, "vertices where z < -1"), 0U);
  EXPECT_EQ(selected(session, "nodes where pz < -1 and z >= 0"), 125U);
}

TEST(Region, FieldsAreReadWhereTheElementIs) {
  TestSession session({"new box 2 2 2", "set density 100 + 100*x", "levels 2"});
  EXPECT_EQ(selected(session, "vertices where density > 175"), 9U);
  EXPECT_EQ(selected(session, "cells where density < 150"), 4U);
  const std::size_t nodes = selected(session, "nodes where density > 175");
  EXPECT_GT(nodes, 0U);
  EXPECT_LT(nodes, 729U / 2);
}

TEST(Region, SetsAreKeptNarrowedAndCombined) {
  TestSession session(k_grid);
  EXPECT_EQ(selected(session, "faces as left where x < 0.1"), 2U);
  EXPECT_EQ(selected(session, "faces as top where z > 0.9"), 6U);
  EXPECT_EQ(selected(session, "faces add set left"), 8U);
  EXPECT_EQ(selected(session, "faces add set left"), 8U);
  EXPECT_EQ(selected(session, "faces remove set top where y < 1"), 5U);
  EXPECT_EQ(selected(session, "faces set left where y < 1"), 1U);
  EXPECT_EQ(selected(session, "faces none"), 0U);
  EXPECT_EQ(selected(session, "faces set left as left where y < 1"), 1U);
  EXPECT_EQ(session.state().sets->at("left").ids.size(), 1U);
  EXPECT_EQ(session.state().sets->at("top").ids.size(), 6U);
  session.run({"select vertices"});
  EXPECT_EQ(session.fault_of("select faces add set top").code(), ErrorCode::bad_input);
  EXPECT_EQ(session.fault_of("select vertices set top").code(), ErrorCode::not_found);
  session.run({"remove where x > 2"});
  EXPECT_EQ(session.state().sets->at("top").ids.size(), 4U);
}

TEST(Region, AngleFindsBoundaryEdgesThatBend) {
  TestSession session(k_grid);
  // A box's own edges, in pieces; with a condition and beside a slope of 45°.
  EXPECT_EQ(selected(session, "edges angle 30"), 4U * (3 + 2 + 1));
  EXPECT_EQ(selected(session, "edges angle 91"), 0U);
  EXPECT_EQ(selected(session, "edges angle 30 where z > 0.9"), 10U);
  session.run({"move 0 0 1 where z > 0.9 and x > 2.9"});
  EXPECT_EQ(selected(session, "edges angle 44 where z = 1 and x = 2"), 2U);
  EXPECT_EQ(selected(session, "edges angle 46 where z = 1 and x = 2"), 0U);
}

TEST(Region, FormulasAreAskedOnlyWhereTheyAreWanted) {
  TestSession session({"new box 2 1 1", "levels 1"});
  session.run({"set density 100/x where x > 0.01"});
  EXPECT_THAT(session.fault_of("set density 100/x").what(), HasSubstr("not finite at (0, "));
}

TEST(Region, CountsHaveTheirNumber) {
  EXPECT_EQ(count_of(1, ElementType::vertices), "1 vertex");
  EXPECT_EQ(count_of(0, ElementType::cells), "0 cells");
}

}  // namespace
}  // namespace argil::sculpt
