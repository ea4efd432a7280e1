// What somebody meets on the first day, in windows of any size: nothing lies over something else or outside, what
// is typed wrong says so and stays, and what was just said is read.

#include <gtest/gtest.h>

#include <set>

#include "tests/studio/windows.h"
#include "tools/studio/search.h"

namespace argil::studio {
namespace {

struct Size {
  int width, height;
  float scale;
};
constexpr Size k_sizes[] = {{900, 600, 1}, {640, 480, 1}, {1440, 900, 1}, {900, 600, 2}};

Offscreen sized(const char* name, const Size& size, bool card = false) {
  OffscreenOptions options = small_window(name);
  options.width = size.width;
  options.height = size.height;
  options.scale = size.scale;
  options.card = card;
  return Offscreen(options);
}

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.right() - 0.5F && b.x < a.right() - 0.5F && a.y < b.bottom() - 0.5F && b.y < a.bottom() - 0.5F;
}

TEST(FirstDay, MenusLieWithinTheWindowWithAllThatTheyHold) {
  for (const Size& size : k_sizes) {
    Offscreen window = sized("day_menus", size);
    const auto wide = static_cast<float>(size.width) * size.scale,
               high = static_cast<float>(size.height) * size.scale;
    for (const Menu& menu : menus()) {
      std::multiset<std::string> expected;
      for (const ActionInfo& action : action_table())
        if (std::string(menu.name) == action.menu && !std::string(action.word).starts_with("tool_"))
          expected.insert(action.label);
      for (const sculpt::Command& command : sculpt::command_table())
        for (const char* group : menu.groups)
          if (command.group == group) expected.insert(command.name);
      window.click(menu.name);
      window.wait(2);
      std::multiset<std::string> found;
      std::vector<Rect> rows;
      for (const Control& control : window.studio().ui().controls()) {
        if (control.kind != ControlKind::button || control.place.width < 100 * size.scale ||
            !expected.contains(control.name))
          continue;
        EXPECT_LE(control.place.right(), wide) << control.name << " of " << menu.name;
        EXPECT_LE(control.place.bottom(), high) << control.name << " of " << menu.name << " in " << size.width;
        found.insert(control.name);
        rows.push_back(control.place);
      }
      EXPECT_EQ(found, expected) << menu.name;
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(overlap(rows[i], rows[k])) << menu.name;
      window.press("Esc");
      window.wait(2);
    }
  }
}

TEST(FirstDay, TheCardAndTheHintsLieBetweenShelfAndPanel) {
  for (const Size& size : {Size{900, 600, 1}, Size{1440, 900, 1}, Size{1120, 720, 2}})
    for (const bool card : {true, false}) {
      Offscreen window = sized("day_card", size, card);
      window.wait(2);
      if (!card) window.press("C");  // with the longest line of hints
      window.wait(2);
      const Control* found = window.studio().ui().find(card ? "First minute" : "Hints");
      ASSERT_NE(found, nullptr);
      const Layout layout = lay_out(window.studio().desk(), static_cast<int>(size.width * size.scale),
                                    static_cast<int>(size.height * size.scale));
      EXPECT_GE(found->place.x, layout.shelf.right()) << size.width;
      EXPECT_LE(found->place.right(), layout.panel.x) << size.width;
      EXPECT_GE(found->place.y, layout.menu.bottom());
    }
}

TEST(FirstDay, ANumberThatCannotBeStaysAndSaysWhy) {
  Offscreen window(small_window("day_numbers"));
  const double before = window.studio().desk().brush.radius;
  const auto type = [&](const std::string& text) {
    window.click("Radius");
    window.wait(5);
    window.type(text);
    window.press("Enter");
    window.wait(8);
  };
  const sculpt::Picture calm = (window.click("Radius"), window.wait(6), window.picture());
  window.press("Esc");
  window.wait(3);
  EXPECT_FALSE(window.studio().ui().is_editing());
  for (const char* wrong : {"77 km", "two mm", "3 s", "1/0"}) {
    type(wrong);
    EXPECT_TRUE(window.studio().ui().is_editing()) << wrong;
    EXPECT_EQ(window.studio().desk().brush.radius, before) << wrong;
    EXPECT_NE(window.picture().rgba, calm.rgba) << wrong;
    // It has the keyboard still: what is typed now takes its place.
    window.type("2 mm");
    window.press("Enter");
    window.wait(3);
    EXPECT_FALSE(window.studio().ui().is_editing()) << wrong;
    EXPECT_NEAR(window.studio().desk().brush.radius, 2e-3, 1e-15) << wrong;
    window.studio().desk().brush.radius = before;
    window.wait();
  }
  type("1/3");
  EXPECT_NEAR(window.studio().desk().brush.radius, 1.0 / 3, 1e-15);
}

TEST(FirstDay, WhatWasJustSaidIsReadInASmallWindow) {
  Offscreen window = sized("day_said", {900, 600, 1});
  window.workshop().run("levels 77");
  window.wait(2);
  const Control* said = window.studio().ui().find("Message");
  ASSERT_NE(said, nullptr);
  ASSERT_FALSE(window.now().messages.empty());
  const std::string& text = window.now().messages.back().text;
  const float whole = window.studio().ui().width_of(window.studio().ui().fonts().small, text);
  EXPECT_GE(said->place.width, std::min(whole, 700.0F)) << text;
  EXPECT_LE(said->place.right(), 900);
  // And what is cut says so.
  Ui& ui = *window.studio().desk().ui;
  const std::string fitted = ui.fitted(ui.fonts().small, "the quick brown fox of Königsberg", 90);
  EXPECT_TRUE(fitted.ends_with("…")) << fitted;
  EXPECT_LE(ui.width_of(ui.fonts().small, fitted), 90);
  EXPECT_EQ(ui.fitted(ui.fonts().small, "short", 90), "short");
}

TEST(FirstDay, TwoHundredChangesAreAllListedAndWithoutAnyNothingIsUndone) {
  Offscreen window = sized("day_history", {900, 600, 1});
  window.studio().desk().settings.panel = Panel::history;
  std::vector<std::string> lines;
  for (int i = 0; i < 210; ++i) lines.push_back("set damping " + std::to_string(i % 7 + 0.123456789));
  window.workshop().run_together(lines);
  window.wait(3);
  EXPECT_GE(window.now().history->size(), 210U);
  window.move(740, 400);
  for (int i = 0; i < 200; ++i) window.wheel(-3);
  window.wait(2);
  // The first line of all can be scrolled to.
  const std::string last = "History " + std::to_string(window.now().history->size() - 1);
  const Control* row = window.studio().ui().find(last);
  ASSERT_NE(row, nullptr) << last;
  EXPECT_LE(row->place.bottom(), 600);
}

TEST(FirstDay, KeysAreReadInASmallWindow) {
  Offscreen window = sized("day_keys", {640, 480, 1});
  window.press("F1");
  window.wait(3);
  std::set<std::string> seen;
  window.move(320, 240);
  for (int i = 0; i < 40; ++i) {
    for (const Control& control : window.studio().ui().controls()) {
      if (!control.name.starts_with("Key of ")) continue;
      EXPECT_GE(control.place.height, 18) << control.name;
      seen.insert(control.name);
    }
    window.wheel(-1);
  }
  EXPECT_EQ(seen.size(), k_action_count);
}

TEST(FirstDay, SavingOverAnotherFileIsSaidBefore) {
  Offscreen window(small_window("day_saving"));
  const std::filesystem::path other = window.workshop().bench().session().options().out / "theirs.argil";
  io::write_file(other, "argil 1\n");
  const auto typed = [&](const std::string& name) {
    window.press("Ctrl-Shift-S");
    window.wait(2);
    window.press("Ctrl-A");
    window.type(name);
    window.wait(4);
    return window.studio().ui().find("Would replace") != nullptr;
  };
  EXPECT_FALSE(typed((other.parent_path() / "mine.argil").string()));
  window.press("Esc");
  EXPECT_TRUE(typed((other.parent_path() / "theirs").string()));
  EXPECT_EQ(window.now().listing->whole, std::filesystem::canonical(other.parent_path()));
  window.click("Save now");
  window.wait(4);
  EXPECT_TRUE(window.now().saved);
  // The same one again is no other file.
  EXPECT_FALSE(typed(other.string()));
}

TEST(FirstDay, AnOpenMenuExplainsItsOwnLinesAlone) {
  Offscreen window(small_window("day_menu_tips"));
  const auto shot = [&](const std::string& under) {
    // The pointer lies on a control of the panel that the menu covers or not.
    const Control* control = window.studio().ui().find(under);
    EXPECT_NE(control, nullptr);
    window.move(control->place.x + 20, control->place.y + 10);
    window.wait(5);
    const sculpt::Picture at_once = window.picture();
    window.wait(40);
    return window.picture().rgba != at_once.rgba;
  };
  EXPECT_TRUE(shot("Force limit"));
  window.click("File");
  window.wait(3);
  EXPECT_FALSE(shot("Force limit"));
  EXPECT_TRUE(shot("Turntable"));
}

}  // namespace
}  // namespace argil::studio
