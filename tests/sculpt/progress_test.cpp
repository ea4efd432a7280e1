// Whatever takes long tells how far it has got, and can be ended there: then nothing has changed, and what is done
// next gives the bits that it gives without.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

/// What a session told, and at which call it is to be ended.
struct Ear {
  std::vector<double> heard;
  long end_at = -1;  // −1: never

  SessionOptions options() {
    SessionOptions result;
    result.progress = [this](double share, const std::string&) {
      if (static_cast<long>(heard.size()) == end_at) throw Cancelled();
      heard.push_back(share);
    };
    return result;
  }
};

struct Case {
  const char* name;
  std::vector<std::string> before;
  std::string line, next;
};

void PrintTo(const Case& one, std::ostream* out) {
  *out << one.name;
}

const std::vector<std::string> k_body{"new box 3 2 2", "levels 2"};
const std::vector<std::string> k_hanging{"new box 3 2 2", "levels 2", "pin where x < 0.01", "gravity 0 0 -9.81",
                                         "set young_modulus 2e5"};

std::vector<std::string> with(std::vector<std::string> lines, std::initializer_list<const char*> more) {
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

class LongCommand : public testing::TestWithParam<Case> {};

TEST_P(LongCommand, TellsSharesThatDoNotFallAndCanBeEndedAtAnyOfThem) {
  const Case& one = GetParam();
  Ear all;
  std::uint64_t before = 0, after = 0, later = 0;
  std::size_t calls = 0;
  {
    TestSession session(one.before, all.options());
    before = session.hash();
    all.heard.clear();
    session.run({one.line});
    calls = all.heard.size();
    ASSERT_GT(calls, 3U) << "it tells hardly anything";
    double last = 0;
    for (const double share : all.heard) {
      if (share < 0) continue;  // not known
      EXPECT_GE(share, last);
      EXPECT_LE(share, 1);
      last = share;
    }
    EXPECT_GT(last, 0);
    after = session.hash();
    session.run({one.next});
    later = session.hash();
  }
  {
    TestSession silent(one.before);
    silent.run({one.line, one.next});
    EXPECT_EQ(silent.hash(), later) << "that somebody listens changes the bits";
  }
  std::vector<std::size_t> ends{0, calls / 2, calls - 1};
  std::mt19937 random(7);
  for (int i = 0; i < 3; ++i) ends.push_back(random() % calls);
  for (const std::size_t end : ends) {
    Ear ear;
    TestSession session(one.before, ear.options());
    const std::string journal = session.folder().text_of("journal.argil");
    const std::size_t undo = session->undo_depth(), steps = session->steps().size();
    ear.heard.clear();
    ear.end_at = static_cast<long>(end);
    EXPECT_THROW(session.run({one.line}), Cancelled) << "at call " << end << " of " << calls;
    ear.end_at = -1;
    EXPECT_EQ(session.hash(), before) << "ended at call " << end;
    EXPECT_EQ(session.folder().text_of("journal.argil"), journal);
    EXPECT_EQ(session->undo_depth(), undo);
    EXPECT_EQ(session->steps().size(), steps);
    // What was half made must not show.
    session.run({one.line});
    EXPECT_EQ(session.hash(), after) << "ended at call " << end;
    session.run({one.next});
    EXPECT_EQ(session.hash(), later) << "ended at call " << end;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Session, LongCommand,
    testing::Values(
        Case{"levels", {"new box 3 2 2"}, "levels 3", "step 1"}, Case{"levels_down", k_body, "levels 1", "step 1"},
        Case{"rules", k_body, "rules multilinear", "step 1"},
        Case{"extrude", k_body, "extrude 0.3 where z > 0.99", "step 1"},
        Case{"split", k_body, "split where x < 0.3", "step 1"}, Case{"step", k_hanging, "step 3", "step 1"},
        Case{"step_cubic", with(k_hanging, {"space cubic"}), "step 2", "step 1"},
        Case{"step_central", with(k_hanging, {"integrator central_difference"}), "step 4 dt 1e-5", "step 1"},
        Case{"step_alpha", with(k_hanging, {"integrator generalised_alpha"}), "step 2", "step 1"},
        Case{"step_damped", with(k_hanging, {"set stiffness_damping 0.01", "step 1"}), "step 2 dt 1/50", "step 1"},
        Case{"solve", k_hanging, "solve", "step 1"},
        Case{"commit", with(k_hanging, {"step 4"}), "commit", "step 1"},
        Case{"stroke", with(k_hanging, {"tool pull radius 0.5 strength 100"}),
             "stroke from 1 1 1 to 1 1 1.3 ticks 100", "step 1"},
        Case{"save", with(k_hanging, {"step 1"}), "save body.vtu", "step 1"},
        Case{"solidify", {"new sphere around 12", "save ball.obj"}, "solidify ball.obj cells 6", "levels 1"}),
    [](const auto& one) { return std::string(one.param.name); });

// The share is that of the whole file, each of its lines an equal part.
TEST(Progress, OfAFileRisesFromLineToLine) {
  Ear ear;
  TestSession session({}, ear.options());
  session->run_text("argil 1\nnew box 3 2 2\nlevels 2\npin where x < 0.01\ngravity 0 0 -9.81\nstep 5\n", "file");
  EXPECT_TRUE(std::is_sorted(ear.heard.begin(), ear.heard.end()));
  EXPECT_EQ(ear.heard.front(), 0);
  EXPECT_EQ(ear.heard.back(), 1);
  // The last of its five lines takes five steps.
  EXPECT_GE(std::count_if(ear.heard.begin(), ear.heard.end(), [](double share) { return share > 0.8; }), 5);
}

// What a command has changed is done: it is not ended any more, and undo takes back all of it or nothing.
TEST(Progress, EndsNothingThatHasBeenDone) {
  Ear ear;
  TestSession session({"new box 2 2 2", "levels 1"}, ear.options());
  const std::uint64_t before = session.hash();
  ear.heard.clear();
  session.run({"levels 2"});
  const std::uint64_t after = session.hash();
  session.run({"undo"});
  EXPECT_EQ(session.hash(), before);
  ear.end_at = 0;
  ear.heard.clear();
  session.run({"redo"});  // makes nothing anew
  EXPECT_EQ(session.hash(), after);
}

}  // namespace
}  // namespace argil::sculpt
