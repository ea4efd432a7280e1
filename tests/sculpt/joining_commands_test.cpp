// merge, weld, bridge, collapse and fill as a session runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/boundary.h"
#include "subdiv/validate.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const std::vector<std::string> k_gap{"new box 3 1 1 size 3 1 1", "remove where x > 1 and x < 2"};

int genus(const TestSession& session) {
  return subdiv::boundary_surface(*session.state().solid).genus;
}

TEST(JoiningCommands, ExamplesRunAfterTheirLinesAndCanBeUndoneAndRedone) {
  for (const char* name : {"merge", "weld", "bridge", "collapse", "fill"}) {
    SCOPED_TRACE(name);
    for (const Command& command : command_table()) {
      if (command.name != name) continue;
      TestSession session(command.before);
      const std::uint64_t before = session.hash();
      session.run({command.example});
      const std::uint64_t after = session.hash();
      EXPECT_NE(after, before);
      EXPECT_THAT(subdiv::validate(*session.state().solid), testing::IsEmpty());
      session.run({"undo"});
      EXPECT_EQ(session.hash(), before);
      session.run({"redo"});
      EXPECT_EQ(session.hash(), after);
    }
  }
}

TEST(JoiningCommands, ARefusalLeavesTheDocumentAsItWas) {
  TestSession session(k_gap);
  session.run({"select faces as right where x > 2.9"});
  for (const auto& [line, message] : std::vector<std::pair<std::string, std::string>>{
           {"merge where x < 0.1 or (x > 0.9 and x < 1.1)", "same cell"},
           {"merge where x < 0.4", "expected faces that make two patches, found 1"},
           {"merge with nothing where x < 0.1", "no set of faces named 'nothing'"},
           {"merge with right where x < 0.6", "the first has 5 and the second 1 faces"},
           {"bridge twist 1 with right where x < 0.6", "the first has 5"},
           {"weld tolerance 1", "would become one"},
           {"collapse where x < 1.5 and x > 2", "no edges"},
           {"fill where x < 0.1", "is no opening"}}) {
    const std::uint64_t before = session.hash();
    EXPECT_THAT(session.fault_of(line).what(), HasSubstr(message)) << line;
    EXPECT_EQ(session.hash(), before) << line;
  }
}

TEST(JoiningCommands, ANamedSetIsTheSecondRegion) {
  TestSession session(k_gap);
  session.run(
      {"select faces as left_side where x = 2", "select faces where x = 1", "merge at second with left_side"});
  EXPECT_NEAR(session.measure("volume"), 3, 1e-12);
  EXPECT_EQ(session.state().rest->row(0).minCoeff(), 0);
  EXPECT_THAT(session.fault_of("merge with left_side where x = 0").what(), HasSubstr("face"));
}

TEST(JoiningCommands, MergedVerticesKeepPinsOnTheVertexThatStays) {
  TestSession session(k_gap);
  session.run({"select vertices where x < 1.1", "pin", "merge where x > 0.9 and x < 2.1"});
  EXPECT_EQ(session.state().pins->control_points.size(), 8u);
}

TEST(JoiningCommands, AFieldPaintedAtLevelOneStaysWhereItWas) {
  TestSession session(k_gap);
  session.run({"levels 1", "set young_modulus 1000", "paint young_modulus scale 4 where x < 0.6"});
  const auto painted = [&] { return ((*session.state().fields)[FieldName::young_modulus].array() > 2500).count(); };
  const auto before = painted();
  session.run({"merge at first where x > 0.9 and x < 2.1"});
  EXPECT_EQ(painted(), before);
  EXPECT_NEAR((*session.state().fields)[FieldName::young_modulus].minCoeff(), 1000, 1e-9);
  EXPECT_NEAR((*session.state().fields)[FieldName::young_modulus].maxCoeff(), 4000, 1e-9);
}

TEST(JoiningCommands, FourBlocksThatTouchInEdgesMergeToARing) {
  TestSession session({"new box 3 3 1 size 3 3 1", "remove where (x < 1 or x > 2) and (y < 1 or y > 2)",
                       "remove where x > 1 and x < 2 and y > 1 and y < 2"});
  EXPECT_EQ(session.state().solid->cell_count(), 4u);
  session.run({"merge where x < 1.1 and y > 1.9", "merge where x > 1.9 and y > 1.9",
               "merge where x < 1.1 and y < 1.1", "merge where x > 1.9 and y < 1.1"});
  EXPECT_EQ(session.state().solid->vertex_count(), 16u);
  EXPECT_EQ(genus(session), 1);
  session.run({"levels 1"});
  EXPECT_GT(session.measure("volume"), 0);
}

TEST(JoiningCommands, ABridgeBetweenTopsIsFlatWithoutAnArcAndSaysSo) {
  std::string said;
  SessionOptions options;
  options.print = [&](const std::string& text) { said += text; };
  TestSession session({"new box 4 1 1 size 4 1 1", "remove where x > 1 and x < 3"}, options);
  session.run({"bridge where z = 1"});
  EXPECT_THAT(said, HasSubstr("flat or inside out: 1 of 1 new cell; `arc`"));
  said.clear();
  session.run({"undo", "bridge arc steps 4 where z = 1"});
  EXPECT_EQ(said.find("flat"), std::string::npos);
}

}  // namespace
}  // namespace argil::sculpt
