#include "sculpt/session.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <map>
#include <sstream>

#include "sessions.h"
#include "subdiv/validate.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// A block in motion: pinned, painted, loaded, with the history of the integrator and a part of a step left over.
const std::vector<std::string> k_block_in_motion = {
    "new box 2 2 2 size 0.2 0.2 0.2",
    "select edges angle 30 as rim",
    "sharpen 10",
    "levels 1",
    "set damping 3",
    "set young_modulus 2e4 + 1e4*z",
    "pin where z < 0.01",
    "select nodes as side where x < 0.01",
    "pin stiffness 10",
    "force 0.5 0 0 where z > 0.19",
    "tool pull radius 0.08 strength 40",
    "stroke from 0.1 0.1 0.2 to 0.1 0.15 0.25 ticks 60",
};

// Lines that change the block above. Commands that want another solid are tried by their examples
// (command_document_test).
const std::map<std::string, std::vector<std::string>> k_changes = {
    {"commit", {"commit"}},
    {"cut", {"cut plane 1 0 0.3 where z > 0.1", "cut ring where x > 0.01 and x < 0.09 and z < 0.01"}},
    {"extrude", {"extrude 0.1 steps 2 scale 0.8 where x > 0.19"}},
    {"force", {"force 0 0 1 at 0.1 0.1 0.1", "force clear"}},
    {"gravity", {"gravity 0 0 -9.81"}},
    {"integrator", {"integrator implicit_euler newton 5"}},
    {"levels", {"levels 2", "levels 0"}},
    {"model", {"model linear"}},
    {"move", {"move 0 0.01 0 where z > 0.19"}},
    {"new", {"new wedge"}},
    {"open", {"open block.vtu"}},
    {"mask", {"mask selected", "mask invert"}},
    {"paint", {"paint density scale 3 at 0.1 0.1 0.2 radius 0.1", "paint mask value 0.5 where z > 0.1"}},
    {"peak", {"peak 0.05 where x > 0.19"}},
    {"pin", {"pin where x < 0.01", "pin off where z < 0.01"}},
    {"remove", {"remove where z > 0.1 and x > 0.1"}},
    {"select", {"select cells as top where z > 0.1", "select vertices none"}},
    {"sets", {"sets forget rim"}},
    {"set", {"set poisson_ratio 0.2 + x/2 where z > 0.1"}},
    {"rules", {"rules multilinear"}},
    {"sharpen", {"sharpen 0 where z > 0.19", "sharpen 1.5 where z > 0.19"}},
    {"solve", {"solve"}},
    {"space", {"space cubic split 0"}},
    {"split", {"split where z > 0.1 and x > 0.1"}},
    {"step", {"step 2", "step dt 1/100"}},
    {"stroke", {"stroke from 0.1 0.1 0.2 to 0.15 0.1 0.2 ticks 40 device hand"}},
    {"curve", {"curve through 0.05 0.1 0.2 0.15 0.1 0.2 handle 1 to 0.05 0.1 0.25 ticks 40"}},
    {"tool", {"tool pull limit 2 falloff constant"}},
};

TEST(Session, UndoAndRedoOfEveryCommandRestoreTheState) {
  for (const Command& command : command_table()) {
    if (command.effect != Effect::state) continue;
    const auto lines = k_changes.find(command.name);
    if (lines == k_changes.end()) continue;
    for (const std::string& line : lines->second) {
      SCOPED_TRACE(line);
      ASSERT_THAT(line, StartsWith(command.name));
      TestSession session(k_block_in_motion);
      session.run({"save block.vtu"});
      const std::uint64_t before = session.hash();
      session.run({line});
      const std::uint64_t after = session.hash();
      EXPECT_NE(before, after);
      for (int round = 0; round < 2; ++round) {
        session.run({"undo"});
        EXPECT_EQ(session.hash(), before);
        EXPECT_THAT(subdiv::validate(session.document().solid()), IsEmpty());
        session.run({"redo"});
        EXPECT_EQ(session.hash(), after);
        EXPECT_THAT(subdiv::validate(session.document().solid()), IsEmpty());
      }
      // And what comes after is the same as if nothing had been undone.
      TestSession straight(k_block_in_motion);
      straight.run({"save block.vtu", line});
      if (session.state().level == 0) continue;
      session.run({"step 2"});
      straight.run({"step 2"});
      EXPECT_EQ(session.hash(), straight.hash());
    }
  }
}

// Shape, physics, strokes and steps, an edit of a body in motion among them, and a name with a blank.
const std::vector<std::string> k_long_session = {
    "new box 2 2 1 size 0.4 0.4 0.2",
    "select faces as \"two seats\" where z > 0.19 and x > 0.2",
    "extrude 0.2 steps 2 scale 0.8",
    "select edges angle 40",
    "sharpen",
    "peak 0.05 where z < 0.01 and y < 0.2",
    "levels 1",
    "set density 300 + 100*z",
    "paint young_modulus scale 3 where z < 0.1",
    "pin where z < 0.01",
    "gravity 0 0 -9.81",
    "step 3 dt 1/60",
    "tool pull radius 0.1 strength 60",
    "stroke from 0.3 0.3 0.4 to 0.35 0.4 0.45 ticks 100 ease smooth hold 20",
    "extrude 10% where z > 0.39",
    "step 2 dt 0.01",
    "select faces set \"two seats\" where x > 0",
    "stroke from 0.1 0.1 0.2 to 0.1 0.1 0.15 ticks 35 device hand",
    "levels 2",
    "step",
    "solve",
    "commit",
    "gravity 0 0 0",
    "step 2",
};

TEST(Session, UndoingEverythingAndRedoingItPassesThroughTheSameStates) {
  TestSession session;
  std::vector<std::uint64_t> hashes{session.hash()};
  for (const std::string& line : k_long_session) {
    session.run({line});
    hashes.push_back(session.hash());
  }
  ASSERT_EQ(session->undo_depth(), k_long_session.size());
  session.run({"undo all"});
  EXPECT_EQ(session.hash(), hashes.front());
  session.run({"redo all"});
  EXPECT_EQ(session.hash(), hashes.back());
  for (std::size_t i = k_long_session.size(); i-- > 0;) {
    session.run({"undo"});
    ASSERT_EQ(session.hash(), hashes[i]) << "after undoing " << k_long_session[i];
  }
  for (std::size_t i = 0; i < k_long_session.size(); ++i) {
    session.run({"redo"});
    ASSERT_EQ(session.hash(), hashes[i + 1]) << "after redoing " << k_long_session[i];
  }
}

TEST(Session, ANewChangeForgetsWhatWasUndone) {
  TestSession session({"new box", "levels 1", "undo", "gravity 0 0 -1"});
  EXPECT_EQ(session->redo_depth(), 0U);
  EXPECT_THAT(session.fault_of("redo").what(), HasSubstr("0 commands to redo"));
}

TEST(Session, ItsJournalReplaysToTheSameState) {
  TestSession session(k_long_session);
  session.run({"undo 3", "redo 1", "undo 2", "expect volume 0 within 50%", "measure mass as \"its mass\"",
               "step 1 dt 1/90"});
  EXPECT_THROW(session.run({"levels 99"}), Error);
  TestSession again;
  again->run_text(session.folder().text_of("journal.argil"), "journal.argil");
  EXPECT_EQ(again.hash(), session.hash());
  EXPECT_EQ(again->steps().size(), session->steps().size());
  EXPECT_EQ(again.folder().text_of("journal.argil"), session.folder().text_of("journal.argil"));
}

TEST(Session, TheNumberOfThreadsDoesNotReachTheState) {
  std::uint64_t hash[2];
  for (const std::size_t threads : {1U, 2U}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    hash[threads - 1] = TestSession(k_long_session).hash();
  }
  EXPECT_EQ(hash[0], hash[1]);
}

TEST(Session, WhatWasDerivedBeforeDoesNotReachTheState) {
  const TestSession plain(k_long_session);
  // Everything is derived after each line, and again after it was undone and redone.
  TestSession measured;
  for (const std::string& line : k_long_session) {
    measured.run({line, "measure cells", "undo", "redo"});
    if (measured.state().level > 0) measured.run({"measure strain_max", "measure energy"});
  }
  EXPECT_EQ(measured.hash(), plain.hash());
  // Other materials, pins, models, levels and spaces come and go before each line.
  TestSession roundabout;
  for (const std::string& line : k_long_session) {
    if (!roundabout.document().empty() && roundabout.state().level > 0)
      roundabout.run({"set young_modulus 3e3", "step", "undo 2", "pin where x < 0.1", "step", "undo 2",
                      "model linear", "step", "undo 2", "levels 0", "undo", "space cubic", "measure mass", "undo",
                      "gravity 1 2 3", "step", "undo 2"});
    roundabout.run({line});
  }
  EXPECT_EQ(roundabout.hash(), plain.hash());
}

struct BadLine {
  std::string line;
  ErrorCode code = ErrorCode::bad_input;
  std::string message;
  std::string place = "input:1:1";  // the fault is the command's, rather than of one token
};

// At least one for every command; the block in motion is what they are tried on.
const std::vector<BadLine> k_bad_lines = {
    {"commit now", ErrorCode::bad_input, "not one of its arguments", "input:1:8"},
    {"expect volume", ErrorCode::bad_input, "wants a value"},
    {"expect volume within 1 above 2", ErrorCode::bad_input, "within wants the value"},
    {"expect volum 1", ErrorCode::bad_input, "must be one of", "input:1:8"},
    {"expect strain_max 1 where z", ErrorCode::bad_input, "wants a condition", "input:1:27"},
    {"cut", ErrorCode::bad_input, "way is missing", "input:1:4"},
    {"cut ring fraction 2 where x > 0", ErrorCode::bad_input, "must lie", "input:1:19"},
    {"cut plane 0 0 0 where z > 0", ErrorCode::bad_input, "zero"},
    {"key gravity at 1", ErrorCode::bad_input, "wants a value"},
    {"key force nothing 0 0 1", ErrorCode::not_found, "no force named"},
    {"key pressure nothing amount 5", ErrorCode::not_found, "no pressure named"},
    {"pressure 5 clear", ErrorCode::bad_input, "on a line of its own"},
    {"keys now", ErrorCode::bad_input, "not one of its arguments", "input:1:6"},
    {"record film.mov", ErrorCode::unsupported, "ends in .pvd"},
    {"mask clear value 0.5", ErrorCode::bad_input, "leave it out"},
    {"extrude 0.1", ErrorCode::bad_input, "what is selected are nodes"},
    {"extrude where z > 1", ErrorCode::bad_input, "expected how far"},
    {"extrude 0.1 where z > 9", ErrorCode::bad_input, "no faces fit"},
    {"extrude 0.1 where x + 1", ErrorCode::bad_input, "wants a condition", "input:1:19"},
    {"extrude 0.1 along 0 0 0 where x > 0.1", ErrorCode::bad_input, "direction is zero"},
    {"extrude 0.1 where not boundary or x < 9 and w > 1", ErrorCode::bad_input, "`w`", "input:1:45"},
    {"force 1 2", ErrorCode::bad_input, "wants 3 values", "input:1:10"},
    {"force", ErrorCode::bad_input, "three components"},
    {"force 0 0 1 at 9 9 9", ErrorCode::bad_input, "not inside the solid"},
    {"force 0 0 1 clear", ErrorCode::bad_input, "a line of its own"},
    {"force 0 0 1 at 0.1 0.1 0.1 where z > 0", ErrorCode::bad_input, "leave out"},
    {"gravity 0 0 down", ErrorCode::bad_input, "wants a number", "input:1:13"},
    {"integrator rk4", ErrorCode::bad_input, "must be one of", "input:1:12"},
    {"integrator bdf2 newton 0", ErrorCode::bad_input, "between 1 and 100", "input:1:24"},
    {"levels 9", ErrorCode::bad_input, "between 0 and 8", "input:1:8"},
    {"levels 1.5", ErrorCode::bad_input, "whole number", "input:1:8"},
    {"levels 8", ErrorCode::limit_exceeded, "--max-cells"},
    {"measure displacement", ErrorCode::bad_input, "wants a material point"},
    {"measure displacement at 7 7 7", ErrorCode::bad_input, "not inside"},
    {"measure volume where z > 0", ErrorCode::bad_input, "leave out `where`"},
    {"measure strain_max where z > 7", ErrorCode::bad_input, "no node fits"},
    {"model rubber", ErrorCode::bad_input, "must be one of", "input:1:7"},
    {"move 0 0 1 where z > 9", ErrorCode::bad_input, "no vertices"},
    {"move 0 0 1 where 3", ErrorCode::bad_input, "wants a condition", "input:1:18"},
    {"move 0 0 1", ErrorCode::bad_input, "what is selected are nodes"},
    {"new ball", ErrorCode::bad_input, "must be one of", "input:1:5"},
    {"new box 1000 1000 1000", ErrorCode::limit_exceeded, "--max-cells"},
    {"new box 0 1 1", ErrorCode::bad_input, "between 1 and 1000", "input:1:9"},
    {"new wedge 2", ErrorCode::bad_input, "a wedge has no `nx`"},
    {"open nowhere.vtu", ErrorCode::not_found, "nowhere.vtu"},
    {"open ../block.vtu", ErrorCode::refused, "climbs out"},
    {"open journal.argil", ErrorCode::unsupported, ""},
    {"paint density", ErrorCode::bad_input, "either"},
    {"paint density value -1", ErrorCode::bad_input, "must lie between"},
    {"paint density scale 1e9", ErrorCode::bad_input, "at node"},
    {"paint density scale 2 at 0 0 0", ErrorCode::bad_input, "radius"},
    {"paint density scale 2 falloff linear", ErrorCode::bad_input, "falloff"},
    {"paint density scale 2 at 9 9 9 radius 1", ErrorCode::bad_input, "touches no node"},
    {"paint density scale 2 where z", ErrorCode::bad_input, "wants a condition", "input:1:29"},
    {"paint softness scale 2", ErrorCode::bad_input, "must be one of", "input:1:7"},
    {"peak 0 where z > 0.1", ErrorCode::bad_input, "must lie", "input:1:6"},
    {"peak 0.1 where z > 9", ErrorCode::bad_input, "no faces fit"},
    {"pin", ErrorCode::bad_input, "give its stiffness"},
    {"obstacle floor remove", ErrorCode::not_found, "no obstacle"},
    {"obstacle ball sphere", ErrorCode::bad_input, "radius is missing"},
    {"obstacle ball sphere radius 0", ErrorCode::bad_input, "between", "input:1:29"},
    {"plasticity", ErrorCode::bad_input, "wants a yield stress"},
    {"plasticity yield 0", ErrorCode::bad_input, "above 0"},
    {"pin off stiffness 3", ErrorCode::bad_input, "leave it out"},
    {"pin stiffness 3 where z > 0", ErrorCode::bad_input, "pinned exactly"},
    {"pin where z > 9", ErrorCode::bad_input, "no vertices"},
    {"pin where x*2", ErrorCode::bad_input, "wants a condition", "input:1:11"},
    {"redo", ErrorCode::bad_input, "0 commands to redo"},
    {"redo 1 all", ErrorCode::bad_input, "exclude"},
    {"remove where x < 9", ErrorCode::bad_topology, "no cell"},
    {"remove where x > 9", ErrorCode::bad_input, "no cells fit"},
    {"remove where boundary + 1", ErrorCode::bad_input, "", "input:1:14"},
    {"panels a.jpg \"b.png\"", ErrorCode::bad_input, ".png"},
    {"plot a.svg displacement_z", ErrorCode::bad_input, "nothing has been sampled"},
    {"sample a.csv from 0 0 0 to 0 0 0", ErrorCode::bad_input, "both ends"},
    {"sample a.csv from 9 0 0 to 0 0 0", ErrorCode::bad_input, "not inside the solid"},
    {"render chair.jpg", ErrorCode::bad_input, ".png"},
    {"render a.png range 1 0 field strain", ErrorCode::bad_input, "rises"},
    {"render a.png clip 0 0 0 0 0 0", ErrorCode::bad_input, "normal"},
    {"render a.png from 0 0 0", ErrorCode::bad_input, "direction"},
    {"render a.png net_steps 2", ErrorCode::bad_input, "net CELL"},
    {"render /a.png", ErrorCode::refused, "absolute"},
    {"save block.doc", ErrorCode::unsupported, ".doc"},
    {"save ../block.vtu", ErrorCode::refused, "climbs out"},
    {"save block.vtu level 2", ErrorCode::bad_input, "write `levels 2` first"},
    {"save journal.argil/block.vtu", ErrorCode::bad_input, ""},
    {"select corners", ErrorCode::bad_input, "must be one of", "input:1:8"},
    {"select faces where 3*x", ErrorCode::bad_input, "wants a condition", "input:1:20"},
    {"select faces where density", ErrorCode::bad_input, "wants a condition", "input:1:20"},
    {"select faces angle 30", ErrorCode::bad_input, "asked of edges"},
    {"select faces set nobody", ErrorCode::not_found, "nobody"},
    {"sets forget nobody", ErrorCode::not_found, "nobody"},
    {"select faces ray 0 0 1 0 0 0", ErrorCode::bad_input, "direction"},
    {"select faces set rim", ErrorCode::not_found, "set of faces"},
    {"select faces add", ErrorCode::bad_input, "leave out add"},
    {"select nodes add remove", ErrorCode::bad_input, "exclude"},
    {"select faces any all where z > 0", ErrorCode::bad_input, "exclude"},
    {"select faces any", ErrorCode::bad_input, "where"},
    {"select edges interior", ErrorCode::bad_input, "interior is for faces"},
    {"select faces none where z > 0", ErrorCode::bad_input, "leave out where"},
    {"set density 1/x", ErrorCode::bad_input, "not finite"},
    {"set density -3", ErrorCode::bad_input, "must lie between"},
    {"set density z > 0", ErrorCode::bad_input, "condition"},
    {"set density 3 where z", ErrorCode::bad_input, "wants a condition", "input:1:21"},
    {"set density", ErrorCode::bad_input, "missing", "input:1:12"},
    {"rules doo_sabin", ErrorCode::bad_input, "must be one of", "input:1:7"},
    {"sharpen 10 where x > 0.05 and x < 0.15", ErrorCode::unsupported, "inside the solid"},
    {"sharpen 11 where z > 0.1", ErrorCode::bad_input, "between 0 and 10", "input:1:9"},
    {"sharpen", ErrorCode::bad_input, "edges or vertices"},
    {"solve 3", ErrorCode::bad_input, "not one of its arguments", "input:1:7"},
    {"space quartic", ErrorCode::bad_input, "must be one of", "input:1:7"},
    {"split where z > 9", ErrorCode::bad_input, "no cells fit"},
    {"split times 9 where z > 0", ErrorCode::bad_input, "must lie", "input:1:13"},
    {"step 0", ErrorCode::bad_input, "between 1", "input:1:6"},
    {"step dt 0", ErrorCode::bad_input, "must lie", "input:1:9"},
    {"step 1e7", ErrorCode::limit_exceeded, "--max-steps"},
    {"curve through 0 0 0.1 0.2 0.2 0.2 handle 3 to 0 0 1", ErrorCode::bad_input, "handles 1 to 2"},
    {"stroke from 9 9 9 to 0 0 0 ticks 10", ErrorCode::bad_input, "touches nothing"},
    {"stroke from 0 0 0.1 ticks 10", ErrorCode::bad_input, "to is missing", "input:1:29"},
    {"stroke path 0 0.1 0.1 0.2 9 0.1 0.1 0.3 pressures 1 1.01", ErrorCode::bad_input, "must lie", "input:1:53"},
    {"stroke path 0 0.1 0.1 0.2 9 0.1 0.1 0.3 pressures -0.1 1", ErrorCode::bad_input, "must lie", "input:1:51"},
    {"stroke path 0 0.1 0.1 0.2 9 0.1 0.1 0.3 pressures nan 1", ErrorCode::bad_input, "number", "input:1:51"},
    {"stroke path 0 0.1 0.1 0.2 9 0.1 0.1 0.3 pressures 1", ErrorCode::bad_input, "2 stations"},
    {"stroke path 0 0.1 0.1 0.2 pressures 1 scales colour", ErrorCode::bad_input, "must be one of", "input:1:46"},
    {"stroke path 0 0.1 0.1 0.2 scales radius", ErrorCode::bad_input, "give pressures"},
    {"stroke from 0.1 0.1 0.2 to 0 0 0 ticks 9 pressures 1", ErrorCode::bad_input, "pressures go with `path`"},
    {"stroke from 0.1 0.1 0.2 to 0 0 0 ticks 9 scales radius", ErrorCode::bad_input, "scales go with `path`"},
    {"stroke from 0.1 0.1 0.2 to 0 0 0 ticks 0", ErrorCode::bad_input, "must lie", "input:1:40"},
    {"tool push", ErrorCode::bad_input, "must be one of", "input:1:6"},
    {"tool pull radius -1", ErrorCode::bad_input, "must lie", "input:1:18"},
    {"undo 99", ErrorCode::bad_input, "commands to undo, not 99"},
    {"undo 2 all", ErrorCode::bad_input, "exclude"},
    {"bridge where z > 9", ErrorCode::bad_input, "no faces fit"},
    {"collapse where z > 9", ErrorCode::bad_input, "fit; change the condition"},
    {"duplicate where z > 9", ErrorCode::bad_input, "no cells fit"},
    {"fill where z > 9", ErrorCode::bad_input, "no faces fit"},
    {"join ball", ErrorCode::bad_input, "must be one of", "input:1:6"},
    {"merge with nobody where z > 0.19", ErrorCode::not_found, "select faces as nobody"},
    {"mirror normal 0 0 0", ErrorCode::bad_input, "no normal"},
    {"project nowhere.obj", ErrorCode::not_found, "no such file"},
    {"project", ErrorCode::bad_input, "ball RADIUS"},
    {"smooth where z > 9", ErrorCode::bad_input, "fit; change the condition"},
    {"solidify nowhere.obj", ErrorCode::not_found, "no such file"},
    {"transform scale -1", ErrorCode::bad_input, "mirror"},
    {"transform", ErrorCode::bad_input, "scale, stretch or rotate"},
    {"weld tolerance -1", ErrorCode::bad_input, "must lie", "input:1:16"},
    {"weld tolerance 0.5", ErrorCode::bad_topology, "touch itself"},
    {"sculpt", ErrorCode::not_found, "not a command"},
    {"guard maybe", ErrorCode::bad_input, "must be one of", "input:1:7"},
    {"step 1 step 2", ErrorCode::bad_input, "not one of its arguments", "input:1:8"},
    {"step dt 1 dt 2", ErrorCode::bad_input, "given twice", "input:1:11"},
};

TEST(Session, AFailedCommandSaysWhereAndChangesNothing) {
  for (const Command& command : command_table())
    EXPECT_TRUE(std::any_of(k_bad_lines.begin(), k_bad_lines.end(),
                            [&](const BadLine& bad) { return (bad.line + ' ').starts_with(command.name + ' '); }))
        << "give " << command.name << " a line that fails";
  TestSession session(k_block_in_motion);
  const std::uint64_t before = session.hash();
  const std::size_t depth = session->undo_depth(), steps = session->steps().size();
  const std::string journal = session.folder().text_of("journal.argil");
  for (const BadLine& bad : k_bad_lines) {
    SCOPED_TRACE(bad.line);
    const Error error = session.fault_of(bad.line);
    EXPECT_EQ(error.code(), bad.code) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(bad.message));
    EXPECT_EQ(error.where(), bad.place);
    EXPECT_EQ(session.hash(), before);
    EXPECT_EQ(session->undo_depth(), depth);
    EXPECT_EQ(session->steps().size(), steps);
  }
  EXPECT_THAT(session->failed(), IsEmpty());
  EXPECT_EQ(session.folder().text_of("journal.argil"), journal);
  EXPECT_THAT(subdiv::validate(session.document().solid()), IsEmpty());
  TestSession straight(k_block_in_motion);
  session.run({"step 3"});
  straight.run({"step 3"});
  EXPECT_EQ(session.hash(), straight.hash());
}

TEST(Session, AFailedCommandKeepsWhatCanBeRedone) {
  TestSession session(k_block_in_motion);
  const std::uint64_t after = session.hash();
  session.run({"undo 3"});
  for (const BadLine& bad : k_bad_lines)
    if (!bad.line.starts_with("redo")) {
      try {
        session.run({bad.line});
        session.run({"undo"});  // what is bad for the block in motion may be good for this one
        return;
      } catch (const Error&) {
        ASSERT_EQ(session->redo_depth(), 3U) << bad.line;
      }
    }
  session.run({"redo all"});
  EXPECT_EQ(session.hash(), after);
}

TEST(Session, ExamplesOfTheTableAreOneLineOfTheirCommand) {
  for (const Command& command : command_table()) {
    SCOPED_TRACE(command.example);
    const auto line = io::parse_session_line(command.example, "example", 1);
    ASSERT_FALSE(line.tokens.empty());
    EXPECT_EQ(line.tokens[0].text, command.name);
    EXPECT_NO_THROW((void)bind(command, line));
  }
}

TEST(Session, CommandsThatNeedASolidSaySo) {
  for (const Command& command : command_table()) {
    if (command.name == "new" || command.name == "open" || command.name == "solidify" ||
        command.effect == Effect::history)
      continue;
    SCOPED_TRACE(command.name);
    TestSession session;
    const Error error = session.fault_of(command.example);
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("there is no solid yet"));
    EXPECT_EQ(session->undo_depth(), 0U);
  }
}

TEST(Session, LimitsRefuseBeforeAnythingIsMade) {
  SessionOptions options;
  options.limits.cells = 100;
  options.limits.steps = 10;
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2"}, options);
  const auto refused = [&](const std::string& line, const char* option) {
    const std::uint64_t before = session.hash();
    const Error error = session.fault_of(line);
    EXPECT_EQ(error.code(), ErrorCode::limit_exceeded) << line;
    EXPECT_THAT(error.what(), HasSubstr(option)) << line;
    EXPECT_EQ(session.hash(), before) << line;
  };
  refused("new box 5 5 5", "--max-cells");
  refused("extrude 0.1 steps 24 where z > 0.19", "--max-cells");
  refused("levels 2", "--max-cells");
  session.run({"levels 1"});
  refused("extrude 0.1 steps 2 where z > 0.19", "--max-cells");
  refused("peak 0.1 where z > 0.05", "--max-cells");
  refused("step 11", "--max-steps");
  EXPECT_THAT(session->steps(), IsEmpty());
  session.run({"step 8", "tool pull radius 0.1"});
  refused("stroke from 0.1 0.1 0.2 to 0.1 0.1 0.3 ticks 50", "--max-steps");
  EXPECT_EQ(session->steps().size(), 8U);
  session.run({"step 2"});
  refused("step", "--max-steps");

  options.limits = {};
  options.limits.memory = 1'000'000;
  TestSession small({"new box 4 4 4"}, options);
  EXPECT_THAT(small.fault_of("levels 1").what(), HasSubstr("--max-memory"));
  EXPECT_EQ(small.state().level, 0);
  EXPECT_THAT(small.fault_of("new box 10 10 10").what(), HasSubstr("--max-memory"));
}

TEST(Session, AFileBeyondTheLimitIsRefused) {
  TestSession large({"new box 6 6 6", "save large.vtu"});
  SessionOptions options;
  options.limits.cells = 100;
  TestSession session({"new box"}, options);
  std::filesystem::copy_file(large.folder().path() / "large.vtu", session.folder().path() / "large.vtu");
  EXPECT_EQ(session.fault_of("open large.vtu").code(), ErrorCode::limit_exceeded);
}

TEST(Session, OverridesReplaceLinesAndFollowTheSolid) {
  SessionOptions options;
  options.overrides = {{"levels", "1"}, {"space", "cubic split 0"}};
  TestSession replaced({"new box 2 2 2", "levels 2", "gravity 0 0 -1", "step 2"}, options);
  TestSession direct({"new box 2 2 2", "space cubic split 0", "levels 1", "gravity 0 0 -1", "step 2"});
  EXPECT_EQ(replaced.hash(), direct.hash());
  // The journal holds what was done, and needs no override.
  TestSession again;
  again->run_text(replaced.folder().text_of("journal.argil"), "journal.argil");
  EXPECT_EQ(again.hash(), direct.hash());

  options.overrides = {{"levels", "many"}};
  TestSession wrong({"new box 2 2 2"}, options);
  EXPECT_THAT(wrong.fault_of("levels 2").where(), StartsWith("--set levels:1:"));
}

std::vector<std::string> steps_of_trace(const std::string& trace) {
  std::vector<std::string> steps;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);)
    if (line.find(" step ") != std::string::npos) steps.push_back(line);
  return steps;
}

TEST(Session, UntilStepStopsThere) {
  const std::string text =
      "argil 1\nnew box 2 2 2 size 0.2 0.2 0.2\nlevels 1\npin where z < 0.01\ntool pull radius 0.1\nstep 3\n"
      "stroke from 0.1 0.1 0.2 to 0.1 0.2 0.3 ticks 100\nstep 40\ngravity 0 0 -1\n";
  const auto run = [&](long until) {
    TestFolder folder;
    SessionOptions options;
    options.until_step = until;
    options.hash_trace = folder.path() / "trace";
    State state;
    std::string hash;
    {
      TestSession session({}, options);
      session->run_text(text, "s.argil");
      state = session.state();
      hash = fmt::format("{:016x}", session.hash());
    }
    return std::tuple(folder.text_of("trace"), state, hash);
  };
  const auto [whole_trace, whole, whole_hash] = run(-1);
  for (const std::size_t until : {2U, 5U, 9U, 20U}) {
    const auto [trace, state, hash] = run(static_cast<long>(until));
    auto expected = steps_of_trace(whole_trace);
    const auto found = steps_of_trace(trace);
    ASSERT_GE(found.size(), until);
    // One line a step, and one for a command `step` that ended with it.
    EXPECT_THAT(trace, HasSubstr(" step " + std::to_string(until) + " "));
    EXPECT_THAT(trace, testing::Not(HasSubstr(" step " + std::to_string(until + 1) + " ")));
    EXPECT_DOUBLE_EQ(state.motion->time, static_cast<double>(until) / 60);
    EXPECT_TRUE(state.loads->gravity.isZero());
    expected.resize(std::min(found.size(), until));
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.begin()));
    // It stops in the state that the whole session passes through.
    EXPECT_THAT(whole_trace, HasSubstr(fmt::format(" step {} {}\n", until, hash)));
  }
  EXPECT_FALSE(whole.loads->gravity.isZero());
}

TEST(Session, StrokesCarryTheirFractionsOfAStepOver) {
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2", "levels 1", "tool pull radius 0.1"});
  // 5 × 10 ticks at 1/60 s are 3 steps exactly.
  const std::size_t steps_after[] = {0, 1, 1, 2, 3};
  for (const std::size_t steps : steps_after) {
    session.run({"stroke from 0.1 0.1 0.2 to 0.1 0.1 0.2 ticks 10"});
    EXPECT_EQ(session->steps().size(), steps);
  }
  EXPECT_NEAR(session.state().tick_carry, 0, 1e-9);
  EXPECT_NEAR(session.state().motion->time, 0.05, 1e-15);
  // A step without a device leaves the device's clock alone; a step of another length starts it again.
  session.run({"stroke from 0.1 0.1 0.2 to 0.1 0.1 0.2 ticks 10", "step 2"});
  EXPECT_NEAR(session.state().tick_carry, 10, 1e-9);
  session.run({"step dt 0.004"});
  EXPECT_EQ(session.state().tick_carry, 0);
  const std::size_t before = session->steps().size();
  session.run({"stroke from 0.1 0.1 0.2 to 0.1 0.1 0.2 ticks 10"});
  EXPECT_EQ(session->steps().size(), before + 2);
  EXPECT_NEAR(session.state().tick_carry, 2, 1e-9);
  // Steps shorter than a tick: several a tick.
  session.run({"step dt 0.0001", "stroke from 0.1 0.1 0.2 to 0.1 0.1 0.2 ticks 2"});
  EXPECT_EQ(session->steps().size(), before + 2 + 1 + 20);
}

const std::vector<std::string> k_bent_bar = {"new box 4 1 1 size 0.4 0.1 0.1",
                                             "select edges angle 30",
                                             "sharpen",
                                             "levels 1",
                                             "pin where x < 0.01",
                                             "set damping 12",
                                             "force 0 0 -0.4 where x > 0.39",
                                             "solve"};

TEST(Session, AfterCommitAndReleaseNothingMoves) {
  TestSession session(k_bent_bar);
  EXPECT_GT(session.measure("max_displacement"), 1e-3);
  const double volume = session.measure("volume");
  session.run({"commit", "force clear"});
  EXPECT_EQ(session.measure("max_displacement"), 0);
  EXPECT_NEAR(session.measure("volume"), volume, 1e-12);
  session.run({"step 20"});
  EXPECT_LT(session.measure("max_speed"), 1e-10);
  EXPECT_LT(session.measure("max_displacement"), 1e-10);
}

TEST(Session, WithoutCommitTheShapeReturns) {
  TestSession session(k_bent_bar);
  const double bent = session.measure("max_displacement");
  session.run({"force clear", "step 200 dt 1/60"});
  EXPECT_LT(session.measure("max_displacement"), 1e-3 * bent);
  session.run({"solve"});
  // The solver's tolerance is 1e-8 of the loads.
  EXPECT_LT(session.measure("max_displacement"), 1e-7 * bent);
}

TEST(Session, PinnedControlPointsMoveExactlyZero) {
  TestSession session({"new box 3 2 2 size 0.3 0.2 0.2", "levels 1", "pin where x < 0.01", "gravity 0 0 -9.81",
                       "tool pull radius 0.08 strength 200"});
  const Eigen::Matrix3Xd before = session.document().positions();
  session.run({"step 5", "stroke from 0.3 0.1 0.1 to 0.5 0.2 0.1 ticks 200", "integrator implicit_euler", "step 3",
               "solve"});
  EXPECT_EQ(session.measure("pin_motion"), 0);
  ASSERT_EQ(session.state().pins->control_points.size(), 9U);
  for (const std::uint32_t v : session.state().pins->control_points) {
    EXPECT_EQ(session.document().positions().col(v), before.col(v));
    EXPECT_TRUE(session.state().motion->velocities.col(v).isZero(0));
  }
  EXPECT_GT(session.measure("max_displacement"), 1e-3);
}

TEST(Session, CommitKeepsAPointForceOnItsMatter) {
  TestSession session({"new box 4 1 1 size 0.4 0.1 0.1", "select edges angle 30", "sharpen", "levels 1",
                       "pin where x < 0.01", "force 0 0 -0.5 at 0.39 0.05 0.05", "solve"});
  const double x = session.measure("position_x at 0.39 0.05 0.05"),
               z = session.measure("position_z at 0.39 0.05 0.05");
  ASSERT_LT(z, 0.045);
  session.run({"commit"});
  const Eigen::Vector3d point = session.state().loads->forces.at(0).point;
  EXPECT_NEAR(point.x(), x, 1e-14);
  EXPECT_NEAR(point.z(), z, 1e-14);
  // It bends on from there, as often as one likes: the place stays inside.
  session.run({"solve", "commit", "solve", "commit", "undo all"});
}

TEST(Session, SharpenAndMoveAfterLevelsAreAsBefore) {
  TestSession before({"new box 2 2 2 size 0.2 0.2 0.2", "select edges angle 30", "sharpen",
                      "move 0 0.03 0 where z > 0.19", "levels 2", "set density 500"});
  TestSession after({"new box 2 2 2 size 0.2 0.2 0.2", "levels 2", "set density 500", "select edges angle 30",
                     "sharpen", "move 0 0.03 0 where z > 0.19"});
  EXPECT_EQ(after.document().solid().topology_hash(), before.document().solid().topology_hash());
  EXPECT_EQ(after.measure("volume"), before.measure("volume"));
  EXPECT_NEAR(after.measure("mass"), 500 * 0.2 * 0.2 * 0.2, 1e-12);
  before.run({"select vertices none", "gravity 0 0 -1", "step 2"});
  after.run({"select vertices none", "gravity 0 0 -1", "step 2"});
  EXPECT_EQ(after.hash(), before.hash());
}

// A cube with a vertex in the middle of an edge: on the boundary it has two edges.
void write_cube_with_hanging_vertex(const std::filesystem::path& path) {
  std::ofstream(path) << "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n"
                         "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 0.5 0 0\n"
                         "CELLS 1 34\n33 6 5 3 2 1 8 0 4 4 5 6 7 5 0 8 1 5 4 4 1 2 6 5 4 2 3 7 6 4 3 0 4 7\n"
                         "CELL_TYPES 1\n42\n";
}

TEST(Session, LevelsOfASolidThatCannotBeRefinedRefuseWithTheRemedy) {
  TestSession session({"new box"});
  write_cube_with_hanging_vertex(session.folder().path() / "cube.vtk");
  session.run({"open cube.vtk"});
  const std::uint64_t before = session.hash();
  const Error error = session.fault_of("levels 1");
  EXPECT_EQ(error.code(), ErrorCode::bad_topology);
  EXPECT_THAT(error.what(), HasSubstr("vertex 8"));
  EXPECT_THAT(error.what(), HasSubstr("make it a corner"));
  EXPECT_EQ(error.where(), "input:1:1");
  EXPECT_EQ(session.hash(), before);
  session.run({"select vertices where valence = 2", "sharpen 10"});
  EXPECT_EQ(session.state().selection->ids, std::vector<std::uint32_t>{8});
}

}  // namespace
}  // namespace argil::sculpt
