// Random sessions on small solids: each line succeeds or is an Error that leaves the hash as it was; the solid is
// valid after every line; undoing everything ends where it began, and redoing it where it was. ARGIL_FUZZ_SESSIONS
// asks for more.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "sessions.h"
#include "subdiv/validate.h"

namespace argil::sculpt {
namespace {

using testing::IsEmpty;

class RandomLines {
 public:
  explicit RandomLines(std::uint32_t seed) : engine_(seed) {}

  std::string next() {
    // Most of what can be tried wants elements, and a tool that reaches the surface.
    if (++count_ == 1) return start();
    if (count_ == 2) return "levels 1";
    if (count_ == 3) return "tool pull radius 0.4 strength 30";
    switch (pick(24)) {
      case 0:
        return pick(4) ? edit() : start();
      case 1:
      case 2:
      case 3:
        return select();
      case 4:
      case 5:
      case 6:
      case 7:
        return edit();
      case 8:
        return fmt::format("move {} {} {}{}", number(-0.2, 0.2), number(-0.2, 0.2), number(-0.2, 0.2),
                           maybe(where()));
      case 9:
      case 10:
        return fmt::format("levels {}", pick(8) == 0 ? 2 : pick(2));
      case 11:
        return fmt::format("space {}{}", pick(2) ? "cubic" : "default", maybe(fmt::format(" split {}", pick(2))));
      case 12:
        return fmt::format("set {} {}{}", field(), formula(), maybe(where()));
      case 13:
        return fmt::format("paint {} {} {}{}{}", field(), pick(2) ? "scale" : "value", number(0, 4),
                           maybe(fmt::format(" at {} radius {}", point(), number(0.05, 0.6))), maybe(where()));
      case 14:
        return fmt::format("pin{}{}", maybe(pick(2) ? " off" : " stiffness 50"), maybe(where()));
      case 15:
        return pick(4) ? fmt::format("force 0 {} 1 {}", number(-2, 2), pick(2) ? "at " + point() : where())
                       : "force clear";
      case 16:
        return fmt::format("gravity 0 0 {}", number(-9.81, 0));
      case 17:
      case 18:
        return fmt::format("step {}{}", 1 + pick(2), maybe(fmt::format(" dt {}", pick(2) ? "1/60" : "0.005")));
      case 19:
        return fmt::format("stroke from {} to {} ticks {}{}", point(), point(), 1 + pick(40),
                           maybe(" device hand"));
      case 20:
        return pick(3) ? "commit" : "solve";
      case 21:
        return pick(2) ? fmt::format("tool pull radius {} strength {}", number(0.05, 1), number(1, 100))
                       : "model linear";
      case 22:
        return maybe("undo", fmt::format("undo {}", 1 + pick(4)));
      default:
        return maybe("redo", fmt::format("redo {}", 1 + pick(3)));
    }
  }

 private:
  std::string start() {
    static const char* const shapes[] = {"box 2 2 1", "box 3 1 1",   "box 1 1 1", "wedge",
                                         "pyramid",   "tetrahedron", "box 2 2 2"};
    return fmt::format("new {} size {} 0.5 0.5", shapes[pick(7)], number(0.3, 1));
  }
  std::uint32_t pick(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }
  std::string number(double low, double high) {
    return fmt::format("{:.3f}", low + (high - low) * static_cast<double>(engine_()) / 4294967295.0);
  }
  std::string point() { return number(-0.1, 1) + " " + number(-0.1, 0.6) + " " + number(-0.1, 0.6); }
  std::string maybe(const std::string& text) { return pick(2) ? text : ""; }
  std::string maybe(const std::string& a, const std::string& b) { return pick(2) ? a : b; }
  std::string field() {
    static const char* const names[] = {"young_modulus", "poisson_ratio", "density", "damping", "mask", "colour"};
    return names[pick(12) == 0 ? 5 : pick(5)];
  }
  std::string formula() {
    static const char* const formulas[] = {"300 + 100*z", "0.3",       "1/x", "1e4*(1 + abs(sin(90*px)))",
                                           "valence",     "density/2", "0"};
    return formulas[pick(7)];
  }
  std::string where() {
    static const char* const names[] = {"x", "y", "z", "px", "pz", "valence"};
    std::string text = fmt::format(" where {} {} {}", names[pick(6)], pick(2) ? "<" : ">", number(-0.1, 1));
    if (pick(4) == 0) text += pick(2) ? " and boundary" : " or density > 500";
    if (pick(16) == 0) text = " where z";
    return text;
  }
  std::string select() {
    static const char* const types[] = {"vertices", "edges", "faces", "cells", "nodes"};
    const std::string type = types[pick(5)];
    std::string text = "select " + type;
    if (pick(6) == 0) text += pick(2) ? " add" : " remove";
    if (pick(6) == 0) text += " as kept";
    if (pick(6) == 0) text += " set kept";
    if (type == "edges" && pick(2)) text += " angle 30";
    if (type == "faces" && pick(5) == 0) text += " interior";
    return pick(3) ? text + (pick(4) ? "" : " any") + where() : text;
  }
  std::string edit() {
    switch (pick(6)) {
      case 0:
      case 1:
        return fmt::format("extrude {}{}{}{}", number(-0.1, 0.4), maybe(" steps 2"), maybe(" scale 0.8"),
                           maybe(where()));
      case 2:
        return fmt::format("peak {}{}", number(0.02, 0.3), maybe(where()));
      case 3:
        return "remove" + maybe(where());
      default:
        return fmt::format("sharpen{}{}", pick(3) ? (pick(2) ? "" : " 1.3") : " 0", maybe(where()));
    }
  }

  std::mt19937 engine_;
  int count_ = 0;
};

TEST(SessionFuzz, EveryLineSucceedsOrChangesNothing) {
  const char* wanted = std::getenv("ARGIL_FUZZ_SESSIONS");
  const int sessions = wanted ? std::atoi(wanted) : 150;
  int passed = 0, failed = 0;
  for (int seed = 0; seed < sessions; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    SessionOptions options;
    options.limits.cells = 600;  // small solids: what grows beyond is refused, which is tried as well
    options.write_journal = false;
    TestSession session({}, options);
    const std::uint64_t empty = session.hash();
    RandomLines lines(static_cast<std::uint32_t>(seed));
    for (int i = 0; i < 40; ++i) {
      const std::string line = lines.next();
      SCOPED_TRACE(fmt::format("line {}: {}", i, line));
      const std::uint64_t before = session.hash();
      const std::size_t undo_depth = session->undo_depth(), redo_depth = session->redo_depth();
      try {
        session.run({line});
        ++passed;
      } catch (const Error& error) {
        ++failed;
        EXPECT_EQ(session.hash(), before) << error.what();
        EXPECT_EQ(session->undo_depth(), undo_depth);
        EXPECT_EQ(session->redo_depth(), redo_depth);
        EXPECT_THAT(error.where(), testing::StartsWith("input:1:"));
      }
      ASSERT_THAT(subdiv::validate(session.document().solid()), IsEmpty());
      ASSERT_TRUE(session.document().positions().allFinite());
    }
    const std::uint64_t last = session.hash();
    const std::size_t depth = session->undo_depth();
    session.run({"undo all"});
    ASSERT_EQ(session.hash(), empty);
    if (depth > 0) session.run({fmt::format("redo {}", depth)});
    ASSERT_EQ(session.hash(), last);
  }
  // A generator whose lines all failed, or all passed, would try little.
  EXPECT_GT(passed, failed / 2);
  EXPECT_GT(failed, passed / 20);
  if (wanted) fmt::print("{} lines passed, {} were refused\n", passed, failed);
}

}  // namespace
}  // namespace argil::sculpt
