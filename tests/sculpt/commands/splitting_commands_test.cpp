#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/solid_measures.h"
#include "subdiv/validate.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

double rest_volume(TestSession& session) {
  return subdiv::mass_properties(session.document().solid(), session.document().rest()).volume;
}

/// Runs a line, undoes and redoes it; every hash must come back.
void run_both_ways(TestSession& session, const std::string& line) {
  const std::uint64_t before = session.hash();
  session.run({line});
  const std::uint64_t after = session.hash();
  EXPECT_NE(after, before) << line;
  session.run({"undo"});
  EXPECT_EQ(session.hash(), before) << line;
  session.run({"redo"});
  EXPECT_EQ(session.hash(), after) << line;
  EXPECT_THAT(subdiv::validate(session.document().solid()), testing::IsEmpty()) << line;
}

void expect_refused(TestSession& session, const std::string& line, const std::string& reason) {
  const std::uint64_t before = session.hash();
  EXPECT_THAT(session.fault_of(line).what(), HasSubstr(reason)) << line;
  EXPECT_EQ(session.hash(), before) << line;
}

TEST(SplittingCommands, EveryExampleRunsAfterItsOwnLines) {
  for (const Command& command : command_table()) {
    if (command.before.empty()) continue;
    TestSession session(command.before);
    EXPECT_NO_THROW(session.run({command.example})) << command.example;
  }
}

TEST(SplittingCommands, SplitGivesEightAndTheirEightAndSelectsThem) {
  TestSession session({"new box 2 2 2", "select cells where x > 0.5 and y > 0.5 and z > 0.5"});
  run_both_ways(session, "split times 2");
  EXPECT_EQ(session.document().solid().cell_count(), 7u + 64u);
  EXPECT_EQ(session.state().selection->type, ElementType::cells);
  EXPECT_EQ(session.state().selection->ids.size(), 64u);
  EXPECT_NEAR(rest_volume(session), 1, 1e-13);
  expect_refused(session, "split where x > 99", "no cells fit");
}

TEST(SplittingCommands, SplitAsksTheLimitBeforeItWorks) {
  SessionOptions options;
  options.limits.cells = 1000;
  TestSession session({"new box 2 2 2"}, std::move(options));
  expect_refused(session, "split times 8 where x < 2", "--max-cells");
}

TEST(SplittingCommands, WhatWasSplitOnceRefinesAndMoves) {
  TestSession session({"new box 3 3 3", "split where x > 0.667 and y < 0.333 and z > 0.667", "levels 1",
                       "pin where x < 0.01", "gravity 0 0 -9.81", "step 2"});
  EXPECT_TRUE(session.state().motion->positions.allFinite());
}

TEST(SplittingCommands, PresentPositionsFollowTheirSources) {
  TestSession session(
      {"new box 1 1 1", "pin where z < 0.1", "gravity 5 0 -9.81", "set young_modulus 3000", "step 5"});
  run_both_ways(session, "cut plane 0 0 1");
  const Eigen::Matrix3Xd& rest = session.document().rest();
  const Eigen::Matrix3Xd& present = session.state().motion->positions;
  ASSERT_EQ(rest.cols(), 12);
  for (Eigen::Index v = 8; v < 12; ++v) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (Eigen::Index end = 0; end < 8; ++end)
      if ((rest.col(end) - rest.col(v)).head<2>().norm() < 1e-12) middle += present.col(end) / 2;
    EXPECT_LT((present.col(v) - middle).norm(), 1e-14);
    EXPECT_GT((present.col(v) - rest.col(v)).norm(), 1e-4) << "it has moved";
  }
}

TEST(SplittingCommands, TheHalfInFrontOfAPlaneIsSelectedAndCanGo) {
  TestSession session({"new box 4 2 2 size 4 1 1"});
  run_both_ways(session, "cut plane 1 0.3 0.6 at 2 0.5 0.5");
  run_both_ways(session, "remove");
  EXPECT_NEAR(rest_volume(session), 2, 1e-13);
  expect_refused(session, "cut plane 1 0 0 at 9 0 0 where x < 9", "parts none");
  expect_refused(session, "cut plane 0 0 0", "zero");
  expect_refused(session, "cut plane at 0 0 0", "direction");
  expect_refused(session, "cut plane 0 0 1 between 0 1", "between belongs to `cut face`");
}

TEST(SplittingCommands, AFaceIsCutBetweenNumbersOrPoints) {
  TestSession session({"new box 1 1 1"});
  run_both_ways(session, "cut face from 0 0 1 to 1 1 1 where z > 0.9");
  EXPECT_EQ(session.document().solid().face_count(), 7u);
  EXPECT_EQ(session.state().selection->type, ElementType::edges);
  run_both_ways(session, "cut face between 0 3");
  EXPECT_EQ(session.document().solid().face_count(), 8u);
  expect_refused(session, "cut face between 0 3", "2 faces have both");
  expect_refused(session, "cut face between 0 77", "no vertex 77");
  expect_refused(session, "cut face", "between V W");
  expect_refused(session, "cut face between 0 3 where x < 2", "one face");
}

TEST(SplittingCommands, ARingIsCutAtAFraction) {
  TestSession session({"new box 3 3 3 size 3 3 3", "select edges where y = 0 and z = 0 and x > 1 and x < 2"});
  run_both_ways(session, "cut ring fraction 0.25");
  EXPECT_EQ(session.document().solid().cell_count(), 36u);
  expect_refused(session, "cut ring fraction 1", "between");
  expect_refused(session, "cut ring where x > 99", "no edges fit");
}

TEST(GrowingCommands, ExtrudeAlongAPathSelectsItsFarEnd) {
  TestSession session({"new box 2 2 1"});
  run_both_ways(session, "extrude path 0.5 0.5 1.5 1.2 0.5 1.9 curve steps 8 scale 0.2 twist 90 where z > 0.999");
  EXPECT_EQ(session.document().solid().cell_count(), 4u + 32u);
  EXPECT_EQ(session.state().selection->ids.size(), 4u);
  run_both_ways(session, "extrude 0.1 normals");
  expect_refused(session, "extrude", "how far");
  expect_refused(session, "extrude 1 path 0 0 9", "leave the distance out");
  expect_refused(session, "extrude path 0 0", "3 values");
  expect_refused(session, "extrude path 0 0 5 1", "3 values");
  expect_refused(session, "extrude 1 along 0 0 1 normals", "exclude");
  expect_refused(session, "extrude 1 curve", "path");
  expect_refused(session, "extrude 0 twist 20", "twist");
}

TEST(GrowingCommands, NormalsSwellABoxToABox) {
  TestSession session({"new box 2 2 2 size 2 2 2"});
  run_both_ways(session, "extrude 0.5 normals where x < 9");
  EXPECT_NEAR(rest_volume(session), 27, 1e-12);
}

TEST(GrowingCommands, PeaksSelectTheirApexes) {
  TestSession session({"new box 2 2 1 size 1 1 1"});
  run_both_ways(session, "peak 0.5 where z > 0.999");
  EXPECT_EQ(session.state().selection->type, ElementType::vertices);
  EXPECT_EQ(session.state().selection->ids.size(), 4u);
  EXPECT_NEAR(rest_volume(session), 1 + 0.5 / 3, 1e-14);
}

TEST(GrowingCommands, RemoveKeepsForALaterEditAndSweeps) {
  TestSession session({"new box 3 1 1", "levels 1"});
  expect_refused(session, "remove keep where x > 0.5", "levels 0");
  session.run({"levels 0"});
  run_both_ways(session, "remove keep where x > 0.5");
  EXPECT_EQ(session.document().solid().vertex_count(), 16u);
  session.run({"pin where x < 0.01", "gravity 0 0 -9.81", "step 2"});
  EXPECT_TRUE(session.state().motion->positions.allFinite()) << "nothing hangs on what dangles";
  expect_refused(session, "levels 1", "no cell");
  run_both_ways(session, "remove dangling");
  EXPECT_EQ(session.document().solid().vertex_count(), 12u);
  session.run({"levels 1"});
  expect_refused(session, "remove where x < 9", "no cell");
  expect_refused(session, "remove dangling keep", "leave out keep");
}

}  // namespace
}  // namespace argil::sculpt
