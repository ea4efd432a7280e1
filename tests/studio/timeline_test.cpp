// Keys of the timeline under the hand: set, dragged, removed; each one change, each a line of the session.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/studio/windows.h"
#include "tools/studio/keyed.h"

namespace argil::studio {
namespace {

const Control& control(Offscreen& window, const std::string& name) {
  const Control* found = window.studio().ui().find(name);
  static const Control k_none{};
  EXPECT_NE(found, nullptr) << name;
  return found != nullptr ? *found : k_none;
}

Eigen::Vector2d middle(const Rect& place) {
  return {place.x + 0.5 * place.width, place.y + 0.5 * place.height};
}

const sculpt::Track& gravity(Offscreen& window) {
  return document(window).state().loads->gravity_track;
}

TEST(Timeline, AKeyIsDraggedAsOneLineThatUndoTakesBack) {
  Offscreen window(small_window("timeline_drag"));
  window.workshop().run_together({"key gravity 0 0 -1 at 0.5 interpolation linear", "key gravity 0 0 -9.81 at 1"});
  window.wait(2);
  ASSERT_EQ(gravity(window).times, (std::vector<double>{0, 0.5, 1}));
  const std::uint64_t before = hash(window);
  const std::size_t lines = window.now().journal_lines, depth = window.now().undo_depth;
  const Eigen::Vector2d from = middle(control(window, "Key at 0.5 s").place);
  // Half a second is as far as from the first key to this one.
  const double half = from.x() - middle(control(window, "Key at 0 s").place).x();
  window.drag(from.x(), from.y(), from.x() + 0.5 * half, from.y(), 8);
  window.wait(3);
  EXPECT_EQ(window.now().journal_lines, lines + 1);
  EXPECT_EQ(window.now().undo_depth, depth + 1);
  ASSERT_EQ(gravity(window).times.size(), 3U);
  EXPECT_NEAR(gravity(window).times[1], 0.75, 1.1 * 0.5 / half);  // to a pixel
  EXPECT_EQ(gravity(window).values(2, 1), -1);
  EXPECT_EQ(gravity(window).interpolation, sculpt::Interpolation::linear);
  EXPECT_EQ(hash(window), hash_of_journal(window, "timeline_drag_replayed"));
  window.press("Ctrl-Z");
  window.wait(2);
  EXPECT_EQ(hash(window), before);

  // Esc lets go of it where it was.
  window.move(from.x(), from.y());
  window.wait();
  window.button(0, true);
  for (int i = 1; i <= 6; ++i) window.move(from.x() + 10 * i, from.y());
  EXPECT_TRUE(window.studio().desk().key_mark.held);
  window.press("Esc");
  window.move(from.x() + 90, from.y());
  window.button(0, false);
  window.wait(2);
  EXPECT_EQ(hash(window), before);
  // A press alone moves nothing.
  window.click(from.x(), from.y());
  window.wait(2);
  EXPECT_EQ(hash(window), before);
}

TEST(Timeline, PressuresAndPrestressAreKeysLikeOthers) {
  Offscreen window(small_window("timeline_pressure"));
  window.workshop().run_together({"pressure 100 as bag where z > 0.49", "key pressure bag amount 200 at 0.5",
                                  "set prestress 50", "key prestress amount 0.25 at 0.5"});
  window.wait(2);
  const sculpt::State& state = document(window).state();
  EXPECT_EQ(key_times(state), (std::vector<double>{0, 0.5}));
  const std::string said = control(window, "Key at 0.5 s").tooltip;
  EXPECT_NE(said.find("pressure bag amount 200 Pa"), said.npos) << said;
  EXPECT_NE(said.find("prestress amount 0.25"), said.npos) << said;
  // What is offered to be keyed, and what moves or sets a key, are lines that run.
  std::vector<std::string> lines = lines_to_move_keys(state, 0.5, 0.75);
  EXPECT_EQ(lines.size(), 2U);
  int offered = 0;
  for (const Keyable& one : keyable(state))
    if (one.label.starts_with("pressure") || one.label.starts_with("prestress")) {
      ++offered;
      lines.insert(lines.end(), one.lines.begin(), one.lines.end());
    }
  EXPECT_EQ(offered, 2);
  for (const Keyed& one : keyed(state)) lines.push_back(line_to_set_key(one, 0.25));
  window.workshop().run_together(lines);
  window.wait(2);
  EXPECT_TRUE(window.now().messages.empty() || window.now().messages.back().kind != MessageKind::error)
      << window.now().messages.back().text;
  EXPECT_EQ(key_times(document(window).state()), (std::vector<double>{0, 0.25, 0.75}));
  EXPECT_EQ(hash(window), hash_of_journal(window, "timeline_pressure_replayed"));
}

TEST(Timeline, AMarkStandsForAllKeysOfItsTime) {
  Offscreen window(small_window("timeline_all"));
  window.workshop().run_together({"key gravity 0 0 -1 at 0.5", "force 0 0 0 as gust where z > 0.49",
                                  "key force gust 0 0 3 at 0.5", "obstacle floor plane",
                                  "key obstacle floor move 0 0 0.1 rotate 30 at 0.75"});
  window.wait(2);
  const auto times = [&] { return key_times(document(window).state()); };
  EXPECT_EQ(times(), (std::vector<double>{0, 0.5, 0.75}));
  const std::string said = control(window, "Key at 0.5 s").tooltip;
  EXPECT_NE(said.find("gravity 0 0 -1 m/s²"), said.npos) << said;
  EXPECT_NE(said.find("force gust 0 0 3 N"), said.npos) << said;
  const std::size_t depth = window.now().undo_depth;
  const Eigen::Vector2d at = middle(control(window, "Key at 0.5 s").place);
  window.move(at.x(), at.y());
  window.wait(2);
  const std::size_t cells = window.now().control_cells;
  window.press("Del");
  window.wait(3);
  EXPECT_EQ(times(), (std::vector<double>{0, 0.75}));
  EXPECT_EQ(window.now().control_cells, cells);  // Del was for the key, not for clay
  EXPECT_EQ(window.now().undo_depth, depth + 2);
  window.press("Ctrl-Z");  // both of them
  window.wait(2);
  EXPECT_EQ(window.now().undo_depth, depth);
  EXPECT_EQ(times(), (std::vector<double>{0, 0.5, 0.75}));

  // The right button asks which of them.
  window.move(at.x(), at.y());
  window.wait(2);
  window.button(1, true);
  window.button(1, false);
  window.wait(2);
  window.click("Remove key of force gust");
  window.wait(3);
  EXPECT_FALSE(document(window).state().loads->forces.front().track.has_key(0.5));
  EXPECT_TRUE(gravity(window).has_key(0.5));
  EXPECT_EQ(hash(window), hash_of_journal(window, "timeline_all_replayed"));
}

TEST(Timeline, TheMenuOfAKeySaysHowItGoesOn) {
  Offscreen window(small_window("timeline_ways"));
  window.workshop().run("key gravity 0 0 -1 at 0.5");
  window.wait(2);
  const Eigen::Vector2d at = middle(control(window, "Key at 0.5 s").place);
  window.move(at.x(), at.y());
  window.wait(2);
  window.button(1, true);
  window.button(1, false);
  window.wait(2);
  window.click("    step");
  window.wait(3);
  EXPECT_EQ(gravity(window).interpolation, sculpt::Interpolation::step);
  // Its value is a line that one goes on writing at.
  window.move(at.x(), at.y());
  window.wait(2);
  window.button(1, true);
  window.button(1, false);
  window.wait(2);
  window.click("Value of gravity…");
  window.wait(4);
  EXPECT_EQ(window.studio().desk().typed, "key gravity 0 0 -1 at 0.5");
  for (int i = 0; i < 3; ++i) {
    window.press("Backspace");
    window.wait();
  }
  window.type("0.25");
  window.press("Enter");
  window.wait(3);
  EXPECT_EQ(gravity(window).times, (std::vector<double>{0, 0.25, 0.5}));
}

TEST(Timeline, IKeysWhatIsChosenAsItIsNow) {
  Offscreen window(small_window("timeline_set"));
  window.workshop().run_together({"gravity 0 0 -3", "step 4 dt 1/60"});
  window.wait(2);
  const double now = document(window).state().motion->time;
  ASSERT_GT(now, 0);
  window.press("I");
  window.wait(2);
  window.click("gravity");
  window.wait(3);
  ASSERT_EQ(gravity(window).times.size(), 1U);
  EXPECT_EQ(gravity(window).times[0], now);
  EXPECT_EQ(gravity(window).values(2, 0), -3);

  // The panel then sets keys, and throws none away.
  window.workshop().run("step 4 dt 1/60");
  window.studio().desk().settings.panel = Panel::physics;
  window.wait(3);
  window.click("Gravity z");
  window.wait(4);
  window.type("-5");
  window.press("Enter");
  window.wait(3);
  ASSERT_EQ(gravity(window).times.size(), 2U);
  EXPECT_EQ(gravity(window).values(2, 1), -5);

  // What is selected is held, and can be led from here.
  window.workshop().run("select vertices where z > 0.49");
  window.wait(2);
  const std::size_t depth = window.now().undo_depth;
  window.click("Set a key");
  window.wait(2);
  window.click("the selection (16 vertices)");
  window.wait(3);
  ASSERT_EQ(document(window).state().pins->motions.size(), 1U);
  EXPECT_EQ(document(window).state().pins->motions[0].members.ids.size(), 16U);
  EXPECT_EQ(window.now().undo_depth, depth + 3);
  EXPECT_EQ(hash(window), hash_of_journal(window, "timeline_set_replayed"));
  // Once it is led, it is offered by its name alone.
  const auto offered = keyable(document(window).state());
  EXPECT_EQ(std::count_if(offered.begin(), offered.end(),
                          [](const Keyable& one) { return one.label.starts_with("the selection"); }),
            0);
  EXPECT_EQ(offered.back().label, "pin held_1");
  window.press("Ctrl-Z");  // all three lines at once
  window.wait(2);
  EXPECT_TRUE(document(window).state().pins->motions.empty());
  EXPECT_EQ(window.now().undo_depth, depth);
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
}

}  // namespace
}  // namespace argil::studio
