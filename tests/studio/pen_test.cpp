// A pen in the window, by synthetic input: what its pressure scales, that what it drew replays, and that its
// settings last.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "subdiv/error.h"
#include "tests/studio/windows.h"
#include "tools/studio/script.h"
#include "tools/studio/settings_file.h"

namespace argil::studio {
namespace {

std::string journal_line(Offscreen& window, const std::string& beginning) {
  std::istringstream lines(io::read_file(window.workshop().bench().session().journal_path()));
  std::string last;
  for (std::string each; std::getline(lines, each);)
    if (each.starts_with(beginning)) last = each;
  return last;
}

ScriptResult play(Offscreen& window, const std::string& text) {
  return run_script(text, "script", window, test_folder("pen_script"), [](const std::string&) {});
}

constexpr const char* k_press = "move 430 220\nmove 430 220\npress left\n";
const std::string k_constant =
    std::string(k_press) + "move 433 205\nmove 436 190\nmove 440 170\nwait 20\nrelease left\nwait 2";
const std::string k_short = std::string(k_press) + "move 433 205\nrelease left\nwait 2";
const std::string k_ramp = "pen 0.1\n" + std::string(k_press) +
                           "pen 0.3\nmove 433 205\npen 0.6\nmove 436 190\npen 0.9\nmove 440 170\nwait 20\nrelease "
                           "left\nwait 2";

std::uint64_t hash_of_script(const std::string& name, const std::string& text) {
  Offscreen window(small_window(name));
  play(window, text);
  EXPECT_FALSE(journal_line(window, "stroke").empty());
  return hash(window);
}

TEST(StudioPen, FullPressureIsAsTheMouse) {
  // The frame that the pen comes in moves nothing: the mouse waits as long.
  EXPECT_EQ(hash_of_script("pen_full", "pen 1\n" + k_constant),
            hash_of_script("pen_waits", "wait 1\n" + k_constant));
}

TEST(StudioPen, ThePressureOfEachStepIsInTheLineWhichReplays) {
  Offscreen window(small_window("pen_line"));
  play(window, k_ramp);
  const std::string line = journal_line(window, "stroke");
  const std::size_t at = line.find(" pressures ");
  ASSERT_NE(at, std::string::npos) << line;
  std::istringstream numbers(line.substr(at + 11));
  std::vector<double> pressures;
  for (double each = 0; numbers >> each;) pressures.push_back(each);
  ASSERT_GT(pressures.size(), 5U);
  EXPECT_EQ(pressures.front(), 0.1);
  EXPECT_TRUE(std::is_sorted(pressures.begin(), pressures.end())) << line;
  // It comes near the last one as the device comes near the pointer, in 8 ms: after 0.3 s it is there.
  EXPECT_NEAR(pressures.back(), 0.9, 1e-9);
  EXPECT_EQ(hash(window), hash_of_journal(window, "pen_line_replayed"));
}

TEST(StudioPen, HalfThePressureIsHalfTheForceOfALightPull) {
  const auto force = [](const std::string& name, const std::string& pen) {
    OffscreenOptions options = small_window(name);
    Offscreen window(options);
    play(window, pen + "\nmove 430 220\nmove 430 220\npress left\nmove 432 205");
    return window.now().stroke->force.norm();
  };
  const double whole = force("pen_whole", "pen 1"), half = force("pen_half", "pen 0.5");
  EXPECT_GT(whole, 0);
  // The clay gives way the less, so that the spring is longer: a little more than half.
  EXPECT_GE(half, 0.5 * whole);
  EXPECT_LT(half, 0.7 * whole);
}

TEST(StudioPen, PressureAloneMovesAStroke) {
  Offscreen window(small_window("pen_still"));
  play(window, "pen 1\nmove 430 220\nmove 430 220\npress left\nmove 440 170\nwait 10");
  const double firm = window.now().stroke->force.norm();
  play(window, "pen 0\nwait 6");
  EXPECT_LT(window.now().stroke->force.norm(), 1e-3 * firm);
  play(window, "release left");
}

TEST(StudioPen, TheEraserInverts) {
  Offscreen window(small_window("pen_eraser"));
  play(window, "pen 0.5 eraser\n" + k_short);
  EXPECT_NE(journal_line(window, "stroke").find(" invert"), std::string::npos);
  play(window, "pen 0.5\n" + k_short);
  EXPECT_EQ(journal_line(window, "stroke").find(" invert"), std::string::npos);
}

TEST(StudioPen, WhatPressureScalesIsChosenAndKept) {
  OffscreenOptions options = small_window("pen_choice");
  options.bench.settings = test_folder("pen_settings");
  Offscreen window(options);
  window.wait(2);
  EXPECT_EQ(window.studio().ui().find("Pen"), nullptr) << "there is no pen yet";
  window.pen(0.5);
  window.wait(2);
  ASSERT_NE(window.studio().ui().find("Pen"), nullptr);
  EXPECT_EQ(window.studio().desk().settings.pen, PenScales::strength);
  window.studio().desk().settings.pen = PenScales::nothing;
  play(window, k_short);
  EXPECT_EQ(journal_line(window, "stroke").find("pressures"), std::string::npos);
  window.studio().desk().settings.pen = PenScales::radius;
  play(window, k_short);
  EXPECT_NE(journal_line(window, "stroke").find(" scales radius"), std::string::npos);
  EXPECT_EQ(hash(window), hash_of_journal(window, "pen_choice_replayed"));
  window.click("Pen");
  window.wait(2);
  window.click("off");
  window.wait(2);
  EXPECT_EQ(window.studio().desk().settings.pen, PenScales::nothing);
  EXPECT_EQ(io::read_file(options.bench.settings / "window"), "pen = off\n");
}

TEST(StudioPen, SettingsAreReadAndWhatIsNoneIsRefusedWithItsLine) {
  for (const PenScales each : {PenScales::strength, PenScales::radius, PenScales::nothing}) {
    Settings settings, read;
    settings.pen = each;
    read_settings(read, settings_lines(settings), "window");
    EXPECT_EQ(read.pen, each);
  }
  Settings settings;
  read_settings(settings, "# nothing\n\n  pen = radius  # of the brush\n", "window");
  EXPECT_EQ(settings.pen, PenScales::radius);
  for (const char* wrong : {"\npen = hard", "\npen radius", "\npencil = radius", "\npen = radius off", "\npen ="})
    try {
      read_settings(settings, wrong, "window");
      ADD_FAILURE() << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), "window:2");
      EXPECT_NE(std::string(error.what()).find("pen = strength"), std::string::npos);
    }
}

TEST(StudioPen, LinesOfAScriptThatAreNoneAreRefused) {
  Offscreen window(small_window("pen_lines"));
  for (const char* wrong : {"pen", "pen hard", "pen 1.1", "pen -0.1", "pen nan", "pen 0.5 rubber",
                            "pen 0.5 eraser 1", "pen off eraser"})
    try {
      play(window, wrong);
      ADD_FAILURE() << wrong;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("pen PRESSURE"), std::string::npos) << error.what();
    }
  play(window, "pen 0\npen 1 eraser\npen off");
}

}  // namespace
}  // namespace argil::studio
