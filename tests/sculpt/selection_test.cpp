#include "sculpt/selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const std::vector<std::string> k_grid = {"new box 3 2 1 size 3 2 1"};
// Eight cubes about a square hole.
const std::vector<std::string> k_ring = {"new box 3 3 1 size 3 3 1",
                                         "remove where x > 1 and x < 2 and y > 1 and y < 2"};
// Two cubes that touch in the edge x = y = 1.
const std::vector<std::string> k_contact = {"new box 2 2 1 size 2 2 1",
                                            "remove where (x < 1 and y > 1) or (x > 1 and y < 1)"};

std::size_t selected(TestSession& session, const std::string& line) {
  session.run({"select " + line});
  return session.state().selection->ids.size();
}

// The mean of the vertices of what is selected, which must be one element.
Eigen::Vector3d middle_of_selected(TestSession& session) {
  EXPECT_EQ(session.state().selection->ids.size(), 1U);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto vertices = vertices_of(session.document(), *session.state().selection);
  for (const std::uint32_t v : vertices) sum += session.document().positions().col(v);
  return sum / static_cast<double>(vertices.size());
}

TEST(Selection, ARayMeetsTheFirstFaceAndWhatOfItIsNearest) {
  TestSession session(k_grid);
  for (const char* level : {"levels 0", "levels 1"}) {
    session.run({level});
    selected(session, "faces ray 1.2 0.6 5 0 0 -1");
    EXPECT_EQ(middle_of_selected(session), Eigen::Vector3d(1.5, 0.5, 1));
    selected(session, "vertices ray 1.2 0.6 5 0 0 -1");
    EXPECT_EQ(middle_of_selected(session), Eigen::Vector3d(1, 1, 1));
    selected(session, "edges ray 1.2 0.5 5 0 0 -1");
    EXPECT_EQ(middle_of_selected(session), Eigen::Vector3d(1, 0.5, 1));
    selected(session, "cells ray 1.2 0.6 5 0 0 -1");
    EXPECT_EQ(middle_of_selected(session), Eigen::Vector3d(1.5, 0.5, 0.5));
    selected(session, "faces ray 1.2 0.6 -5 0 0 0.1");
    EXPECT_EQ(middle_of_selected(session), Eigen::Vector3d(1.5, 0.5, 0));
    selected(session, "faces ray 1.2 0.6 0.5 1 0 0");  // from the inside
    EXPECT_EQ(middle_of_selected(session), Eigen::Vector3d(3, 0.5, 0.5));
  }
}

TEST(Selection, ARayThroughAnEdgeOrAVertexDoesNotSlipThrough) {
  TestSession session(k_grid);
  EXPECT_EQ(selected(session, "faces ray 1 1 5 0 0 -1"), 1U);
  EXPECT_EQ(selected(session, "faces ray 1.5 1 5 0 0 -1"), 1U);
  EXPECT_EQ(selected(session, "faces ray 1.25 0.25 5 0 0 -1"), 1U);  // on the diagonal of a face
  EXPECT_EQ(selected(session, "faces ray 4 3 2 -1 -1 -1"), 1U);      // at the corner
}

TEST(Selection, ARayThatMissesSelectsNothingAndSaysSo) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& message) { printed = message; };
  TestSession session(k_grid, options);
  EXPECT_EQ(selected(session, "faces ray 1.2 0.6 5 0 0 1"), 0U);
  EXPECT_THAT(printed, HasSubstr("0 faces selected: the ray meets nothing"));
  EXPECT_EQ(selected(session, "faces where x < 0.1"), 2U);
  EXPECT_EQ(selected(session, "faces ray 1.2 0.6 5 0 0 1 add"), 2U);
  EXPECT_EQ(selected(session, "faces ray 1.2 0.6 5 0 0 -1 add"), 3U);
  EXPECT_THAT(session.fault_of("select faces ray 0 0 1 0 0 0").what(), HasSubstr("direction"));
}

TEST(Selection, ARayMeetsTheSolidWhereItStandsNow) {
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2", "levels 1", "gravity 0 0 -10", "step 6 dt 0.1"});
  EXPECT_EQ(selected(session, "faces ray 5 0.05 0.05 -1 0 0"), 0U);
  EXPECT_EQ(selected(session, "faces ray 0.05 0.05 5 0 0 -1"), 1U);
  EXPECT_EQ(selected(session, "nodes ray 0.05 0.05 5 0 0 -1"), 1U);
}

TEST(Selection, BoxesAndBallsAskTheCentroidUnlessAnyOrAllIsSaid) {
  TestSession session(k_grid);
  EXPECT_EQ(selected(session, "vertices box 0 0 0 1 1 1"), 8U);
  EXPECT_EQ(selected(session, "vertices box 1 1 1 0 0 0"), 8U);  // corners in any order
  EXPECT_EQ(selected(session, "cells box 0 0 0 1 1 1"), 1U);
  EXPECT_EQ(selected(session, "cells any box 0 0 0 1 1 1"), 4U);
  EXPECT_EQ(selected(session, "cells all box 0 0 0 1.4 1.4 1"), 1U);
  EXPECT_EQ(selected(session, "faces all box 0 0 1 2 1 1"), 2U);
  EXPECT_EQ(selected(session, "vertices sphere 0 0 0 1"), 4U);
  EXPECT_EQ(selected(session, "vertices sphere 0 0 0 1.5"), 7U);
  EXPECT_EQ(selected(session, "nodes sphere 0 0 0 1.5 where z > 0.5"), 3U);
  EXPECT_THAT(session.fault_of("select cells sphere 0 0 0 0").what(), HasSubstr("radius above 0"));
}

TEST(Selection, BoundaryAndInsideAreForEveryType) {
  TestSession session({"new box 3 3 3 size 3 3 3"});
  EXPECT_EQ(selected(session, "vertices boundary"), 56U);
  EXPECT_EQ(selected(session, "vertices inside"), 8U);
  EXPECT_EQ(selected(session, "edges inside"), 36U);
  EXPECT_EQ(selected(session, "edges boundary"), 144U - 36);
  EXPECT_EQ(selected(session, "faces inside"), 54U);
  EXPECT_EQ(selected(session, "faces boundary"), 54U);
  EXPECT_EQ(selected(session, "cells boundary"), 26U);
  EXPECT_EQ(selected(session, "cells inside"), 1U);
  session.run({"levels 1"});
  EXPECT_EQ(selected(session, "nodes inside"), 125U);
}

TEST(Selection, GrowingAndShrinkingGoByWhatTouches) {
  TestSession session({"new box 5 5 5 size 5 5 5"});
  selected(session, "cells where x > 2 and x < 3 and y > 2 and y < 3 and z > 2 and z < 3");
  EXPECT_EQ(selected(session, "cells grow"), 27U);
  EXPECT_EQ(selected(session, "cells grow"), 125U);
  EXPECT_EQ(selected(session, "cells shrink"), 125U);  // there is nothing else to touch
  EXPECT_EQ(selected(session, "faces ray 2.5 2.5 9 0 0 -1"), 1U);
  EXPECT_EQ(selected(session, "faces grow 2"), 25U);
  EXPECT_EQ(selected(session, "faces shrink"), 9U);
  EXPECT_EQ(selected(session, "faces grow 3 add"), 25U + 20 + 20);  // the last two rows go down the sides
  EXPECT_EQ(selected(session, "vertices ray 2.1 2.1 9 0 0 -1"), 1U);
  EXPECT_EQ(selected(session, "vertices grow"), 6U);  // four on the top, one below
  EXPECT_EQ(selected(session, "edges grow where z = 5 and x = 2.5 and y = 2"), 1U + 2 * 4);
  EXPECT_EQ(selected(session, "edges shrink"), 1U);
  EXPECT_EQ(selected(session, "cells grow 100 where x < 0.1"), 0U);  // no centroid there: nothing grows
}

TEST(Selection, GrowingShrinkingAndInvertingKeepToBoundaryFacesUnlessInteriorIsSaid) {
  TestSession session(k_grid);
  EXPECT_EQ(selected(session, "faces where x < 0.1"), 2U);
  EXPECT_EQ(selected(session, "faces invert"), 20U);
  EXPECT_EQ(selected(session, "faces interior invert"), 29U - 20);
  EXPECT_EQ(selected(session, "cells invert where x < 1"), 4U);
  EXPECT_EQ(selected(session, "vertices none"), 0U);
  EXPECT_EQ(selected(session, "vertices invert"), 24U);
  EXPECT_EQ(selected(session, "vertices invert"), 0U);
  EXPECT_EQ(selected(session, "faces grow where x < 0.1"), 2U + 4 + 2);
  EXPECT_EQ(selected(session, "faces interior grow where x < 0.1"), 2U + 4 + 2 + 1);
}

TEST(Selection, LoopsRunRoundABoxAndEndAtItsCorners) {
  TestSession session({"new box 4 3 2 size 4 3 2"});
  // Round the box in the plane y = 1, and along its own edge.
  EXPECT_EQ(selected(session, "edges loop where y = 1 and x = 0.5 and z = 2"), 2U * (4 + 2));
  EXPECT_EQ(selected(session, "edges loop where y = 0 and x = 0.5 and z = 2"), 4U);
  // Inside: from side to side.
  EXPECT_EQ(selected(session, "edges loop where y = 1 and x = 1.5 and z = 1"), 4U);
  // From what is selected, added to it.
  selected(session, "edges where y = 1 and x = 0.5 and z = 2");
  EXPECT_EQ(selected(session, "edges loop as belt"), 12U);
  EXPECT_EQ(selected(session, "edges loop add where x = 1 and y = 0.5 and z = 2"), 12U + 2 * (3 + 2));
}

TEST(Selection, LoopsRunRoundARing) {
  TestSession session(k_ring);
  // The inner rim: the corners of the hole have five faces, so each side ends there.
  EXPECT_EQ(selected(session, "edges loop where z = 1 and x = 1.5 and y = 1"), 1U);
  // Across the ring from the hole to the outside and back below.
  EXPECT_EQ(selected(session, "edges ring where z = 1 and x = 1.5 and y = 1"), 4U);
}

TEST(Selection, RingsTakeTheParallelEdges) {
  TestSession session({"new box 4 3 2 size 4 3 2"});
  // On the boundary: the edges along x between x = 0 and 1.
  EXPECT_EQ(selected(session, "edges ring where x = 0.5 and y = 1 and z = 2"), 2U * (3 + 2));
  // Inside: the whole sheet.
  EXPECT_EQ(selected(session, "edges ring where x = 0.5 and y = 1 and z = 1"), 4U * 3);
  EXPECT_EQ(selected(session, "edges ring where x = 0.5 or x = 1.5"), 2U * 12);
}

TEST(Selection, TetrahedraHaveNeitherLoopsNorRings) {
  TestSession session({"new tetrahedron"});
  EXPECT_EQ(selected(session, "edges loop where x = 0 and y = 0"), 1U);
  EXPECT_EQ(selected(session, "edges ring where x = 0 and y = 0"), 1U);
  TestSession wedge({"new wedge"});
  EXPECT_EQ(selected(wedge, "edges ring where x = 0 and y = 0"), 3U);  // round its three quadrilaterals
  // Rings end where a pyramid stands in the way.
  TestSession peak({"new box 1 1 1", "peak 0.5 where z > 0.9"});
  EXPECT_EQ(selected(peak, "edges ring where x = 0.5 and y = 0 and z = 1"), 4U);
}

TEST(Selection, LoopsAndRingsDoNotLeapOverAContact) {
  TestSession session(k_contact);
  EXPECT_EQ(session.document().solid().cell_count(), 2U);
  // The edge of contact is parallel to three of each cube.
  EXPECT_EQ(selected(session, "edges ring where x = 0 and y = 0"), 4U);
  EXPECT_EQ(selected(session, "edges ring where x = 1 and y = 1"), 7U);
  EXPECT_EQ(selected(session, "edges loop where x = 1 and y = 1"), 1U);
  EXPECT_EQ(selected(session, "faces where z = 1"), 2U);
}

TEST(Selection, ComponentsAreConnectedThroughFaces) {
  TestSession session(k_contact);
  EXPECT_EQ(selected(session, "faces component where x = 0"), 6U);
  EXPECT_EQ(selected(session, "cells component where x < 1"), 1U);
  EXPECT_EQ(selected(session, "vertices component ray -1 0.4 0.4 1 0 0"), 8U);
  EXPECT_EQ(selected(session, "edges component where x = 1 and y = 1"), 23U);  // of both
  EXPECT_EQ(selected(session, "edges where x = 0 and y = 0"), 1U);
  EXPECT_EQ(selected(session, "edges component"), 12U);
  EXPECT_EQ(selected(session, "edges component remove where x = 2"), 11U);  // but for the edge of contact
  session.run({"levels 1"});
  EXPECT_EQ(selected(session, "nodes component where x = 0"), 27U);
}

TEST(Selection, WhatCannotBeMeantIsRefused) {
  TestSession session(k_grid);
  EXPECT_THAT(session.fault_of("select faces grow").what(), HasSubstr("that is nothing; select faces first"));
  session.run({"select cells"});
  EXPECT_THAT(session.fault_of("select faces grow").what(), HasSubstr("that is 6 cells"));
  EXPECT_THAT(session.fault_of("select faces loop").what(), HasSubstr("loop is asked of edges"));
  EXPECT_THAT(session.fault_of("select edges loop ring").what(), HasSubstr("a line for each"));
  EXPECT_THAT(session.fault_of("select faces boundary inside").what(), HasSubstr("exclude"));
  EXPECT_THAT(session.fault_of("select faces none grow").what(), HasSubstr("leave out grow"));
  EXPECT_THAT(session.fault_of("select faces grow 0").what(), HasSubstr("between 1"));
  EXPECT_THAT(session.fault_of("select faces ray 0 0 1 0 0").what(), HasSubstr("6 values"));
  EXPECT_EQ(session.state().selection->ids.size(), 6U);
}

TEST(Selection, SetsAreForgottenByName) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& message) { printed += message + "\n"; };
  TestSession session({"new box 3 2 1 size 3 2 1", "select faces as top where z > 0.9"}, options);
  printed.clear();
  session.run({"sets"});
  EXPECT_EQ(printed, "top: 6 faces\n");
  EXPECT_THAT(session.fault_of("sets forget tops").what(), HasSubstr("did you mean"));
  session.run({"sets forget top"});
  EXPECT_TRUE(session.state().sets->empty());
  EXPECT_EQ(session.state().selection->ids.size(), 6U);
  session.run({"undo"});
  EXPECT_EQ(session.state().sets->size(), 1U);
}

TEST(Selection, IdsAscendAndAreTheSameEveryTime) {
  const char* const lines[] = {"edges ring where x = 1.5", "edges loop where z = 1", "faces grow 2 where x < 0.6",
                               "vertices component where x = 0", "cells shrink where x < 2"};
  for (const char* line : lines) {
    TestSession one(k_grid), other(k_grid);
    selected(one, line);
    selected(other, line);
    const auto& ids = one.state().selection->ids;
    EXPECT_EQ(ids, other.state().selection->ids);
    EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
    EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
  }
}

}  // namespace
}  // namespace argil::sculpt
