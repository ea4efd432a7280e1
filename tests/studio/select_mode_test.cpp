// Selecting and editing by pointing, as a hand does it: what is done is in the journal and replays to the same
// bits, undo takes it back, and no line runs in a frame.

#include "tools/studio/select_mode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <random>
#include <set>
#include <thread>

#include "tests/studio/windows.h"

namespace argil::studio {
namespace {

using sculpt::ElementType;
using testing::HasSubstr;

const sculpt::Selection& selection(Offscreen& window) {
  return *document(window).state().selection;
}

const Desk& desk(Offscreen& window) {
  return window.studio().desk();
}

// A place on the surface that a control element shows at, and that the pointer meets.
std::optional<Eigen::Vector3d> visible_place(Offscreen& window, ElementType type, std::size_t skip = 0) {
  const Snapshot& now = window.now();
  const OrbitCamera& camera = window.studio().viewport().camera();
  const sculpt::SceneSurface& surface = now.scene->surface;
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t c = surface.offsets[f]; c < surface.offsets[f + 1]; ++c)
      middle += surface.positions[surface.corners[c]].cast<double>();
    middle /= static_cast<double>(surface.offsets[f + 1] - surface.offsets[f]);
    const Eigen::Vector2d at = camera.pixel(middle);
    if (at.x() < 100 || at.x() > 600 || at.y() < 80 || at.y() > 480) continue;
    const auto hit = pick(surface, camera.ray(at.x(), at.y()));
    if (!hit || hit->face != f || !element_at(*now.selectable, surface, type, *hit)) continue;
    if (skip-- == 0) return middle;
  }
  return std::nullopt;
}

std::uint32_t pointed_at(Offscreen& window, ElementType type, const Eigen::Vector3d& place) {
  const Eigen::Vector2d at = pixel(window, place);
  const auto hit = pick(window.now().scene->surface, window.studio().viewport().camera().ray(at.x(), at.y()));
  return *element_at(*window.now().selectable, window.now().scene->surface, type, *hit);
}

const Eigen::Vector3d k_top(0, 0, 0.5);  // of the block, in the middle of the top face of nine

class OnModels : public testing::TestWithParam<const char*> {
 public:
  static std::filesystem::path file() {
    const std::string name = GetParam();
    return name.empty() ? std::filesystem::path{} : std::filesystem::path(ARGIL_SAMPLES_DIR) / name;
  }
  static std::string name() { return GetParam()[0] == '\0' ? "block" : std::filesystem::path(GetParam()).stem(); }
};
INSTANTIATE_TEST_SUITE_P(Window, OnModels, testing::Values("", "models/soccer_player.argil"));

TEST_P(OnModels, ClicksSelectAddAndTakeAwayWhatLiesUnderThePointer) {
  Offscreen window(small_window("select_" + name()), file());
  const std::uint64_t before = hash(window);
  for (const ElementType type :
       {ElementType::faces, ElementType::edges, ElementType::vertices, ElementType::cells}) {
    window.press("Tab");
    window.wait(2);
    ASSERT_EQ(desk(window).settings.choosing, type);
    ASSERT_TRUE(window.now().selectable);
    const auto first = visible_place(window, type);
    ASSERT_TRUE(first);
    const std::uint32_t id = pointed_at(window, type, *first);
    click_at(window, *first);
    EXPECT_EQ(desk(window).pointed, id);
    EXPECT_EQ(selection(window).type, type);
    EXPECT_EQ(selection(window).ids, std::vector{id});
    // Another one beside it.
    std::optional<Eigen::Vector3d> other;
    for (std::size_t skip = 1; skip < 2000 && !other; ++skip) {
      const auto place = visible_place(window, type, skip);
      if (!place) break;
      if (pointed_at(window, type, *place) != id) other = place;
    }
    ASSERT_TRUE(other);
    window.wait(30);
    window.key(key::left_control, true);
    click_at(window, *other);
    EXPECT_EQ(selection(window).ids.size(), 2U);
    window.wait(30);
    click_at(window, *other);
    window.key(key::left_control, false);
    EXPECT_EQ(selection(window).ids, std::vector{id});
  }
  window.press("Tab");
  window.wait(2);
  EXPECT_FALSE(desk(window).settings.choosing);
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
  EXPECT_EQ(hash_of_journal(window, "select_replayed_" + name()), hash(window));
  for (int i = 0; i < 12; ++i) window.press("Ctrl-Z");
  window.wait(3);
  EXPECT_EQ(hash(window), before);
}

TEST_P(OnModels, ADraggedFaceShowsAGhostAndIsExtrudedOnEnter) {
  Offscreen window(small_window("extrude_" + name()), file());
  window.press("Tab");
  window.wait(2);
  const auto place = visible_place(window, ElementType::faces, 3);
  ASSERT_TRUE(place);
  click_at(window, *place);
  const std::uint64_t before = hash(window);
  const std::size_t depth = window.now().undo_depth, cells = document(window).solid().cell_count();
  const Eigen::Vector2d at = pixel(window, *place);
  window.press("E");
  window.wait(2);
  ASSERT_NE(desk(window).pending.tool, nullptr);
  // Along the normal of what is selected, on the screen.
  const Eigen::Vector3d normal = desk(window).pending.aim.normal;
  const double length = 0.1 * (window.now().high - window.now().low).norm();
  const Eigen::Vector2d way = pixel(window, *place + length * normal) - at;
  for (int i = 1; i <= 8; ++i) window.move(at.x() + way.x() * i / 8, at.y() + way.y() * i / 8);
  window.wait(2);
  // A perspective of some depth lies between the way of the pointer and that of the face.
  EXPECT_NEAR(desk(window).pending.amount, length, 0.3 * length);
  ASSERT_TRUE(window.now().ghost);
  EXPECT_EQ(window.now().ghost->fault, "");
  EXPECT_EQ(window.now().ghost->cells_made, 1U);
  EXPECT_EQ(window.now().ghost->cells_removed, 0U);
  EXPECT_EQ(window.now().ghost->faces_made, 5U);
  EXPECT_EQ(window.now().ghost->faces_removed, 1U);
  EXPECT_FALSE(window.now().ghost->corners.empty());
  // The face that is drawn out goes, and what is far from it stays.
  const auto& gone = window.now().ghost->gone;
  EXPECT_EQ(*std::max_element(gone.begin(), gone.end()), 1);
  EXPECT_EQ(*std::min_element(gone.begin(), gone.end()), 0);
  EXPECT_EQ(hash(window), before);  // only a ghost
  window.press("Enter");
  window.wait(2);
  EXPECT_EQ(document(window).solid().cell_count(), cells + 1);
  EXPECT_FALSE(window.now().ghost);
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
  const std::uint64_t after = hash(window);
  EXPECT_EQ(hash_of_journal(window, "extrude_replayed_" + name()), after);
  window.press("Ctrl-Z");
  window.wait(2);
  EXPECT_EQ(hash(window), before);
  EXPECT_EQ(window.now().undo_depth, depth);
  window.press("Ctrl-Shift-Z");
  window.wait(2);
  EXPECT_EQ(hash(window), after);
  const std::filesystem::path saved = window.workshop().bench().session().options().out / "mine.argil";
  window.workshop().post([saved](Bench& bench) { bench.save(saved); });
  window.wait(2);
  Offscreen again(small_window("extrude_reopened_" + name()), saved);
  EXPECT_EQ(hash(again), after);
}

TEST_P(OnModels, TheShelfsExtrudeDrawsThePointedFaceOutInOneDrag) {
  Offscreen window(small_window("shelf_extrude_" + name()), file());
  window.click("Extrude");
  window.wait(2);
  const auto place = visible_place(window, ElementType::faces, 3);
  ASSERT_TRUE(place);
  const std::uint32_t face = pointed_at(window, ElementType::faces, *place);
  const std::uint64_t before = hash(window);
  const std::size_t cells = document(window).solid().cell_count();
  click_at(window, *place);  // without a way it does nothing
  EXPECT_EQ(hash(window), before);
  EXPECT_EQ(desk(window).pending.tool, nullptr);
  const Eigen::Vector2d at = pixel(window, *place);
  window.move(at.x(), at.y());
  EXPECT_EQ(desk(window).pointed, face);
  window.button(0, true);
  const Eigen::Vector3d normal = desk(window).pending.aim.normal;
  const double length = 0.08 * (window.now().high - window.now().low).norm();
  const Eigen::Vector2d way = pixel(window, *place + length * normal) - at;
  for (int i = 1; i <= 6; ++i) window.move(at.x() + way.x() * i / 6, at.y() + way.y() * i / 6);
  window.wait(2);
  ASSERT_TRUE(window.now().ghost);
  EXPECT_EQ(window.now().ghost->cells_made, 1U);
  window.button(0, false);
  window.wait(2);
  EXPECT_EQ(document(window).solid().cell_count(), cells + 1);
  const auto& history = *window.now().history;
  EXPECT_EQ(history[history.size() - 2].line, fmt::format("select faces ids {}", face));
  EXPECT_EQ(hash_of_journal(window, "shelf_extrude_replayed_" + name()), hash(window));
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
  window.press("Ctrl-Z");  // both lines at once
  window.wait(2);
  EXPECT_EQ(hash(window), before);
}

TEST(SelectMode, AToolOfTheShelfEndsIt) {
  Offscreen window(small_window("shelf"));
  window.press("Tab");
  window.wait(2);
  click_at(window, k_top);
  window.press("E");
  window.wait(2);
  window.press("2");
  window.wait(2);
  EXPECT_FALSE(desk(window).settings.choosing);
  EXPECT_EQ(desk(window).pending.tool, nullptr);
  EXPECT_FALSE(window.now().ghost);
  EXPECT_EQ(desk(window).brush.name, "grab");
}

// Whatever keys and gestures come, nothing crashes, no line runs in a frame, and the journal gives the same bits.
// ARGIL_FUZZ_HANDS=1000 tries so many hands.
TEST(SelectMode, RandomHandsSlow) {
  const char* const asked = std::getenv("ARGIL_FUZZ_HANDS");
  const std::uint32_t hands = asked != nullptr ? static_cast<std::uint32_t>(std::atoi(asked)) : 2;
  for (std::uint32_t seed = 1; seed <= hands; ++seed) {
    SCOPED_TRACE(seed);
    OffscreenOptions few = small_window("monkey");
    few.bench.limits.cells = 20'000;
    few.bench.limits.steps = 400;
    Offscreen window(few);
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t end) { return static_cast<int>(random() % end); };
    std::vector<std::string> keys;
    for (const ActionInfo& action : action_table()) {
      using enum Action;
      const bool leaves = action.action == quit || action.action == save || action.action == save_as ||
                          action.action == open || action.action == finer || action.action == screenshot;
      if (!leaves && *action.keys != '\0') keys.emplace_back(action.keys);
      // Those of select mode come twice as often.
      if (action.action >= confirm && *action.keys != '\0') keys.emplace_back(action.keys);
    }
    for (int i = 0; i < 150; ++i) {
      const double x = 80 + below(560), y = 60 + below(460);
      switch (below(8)) {
        case 0:
          window.drag(x, y, x + below(160) - 80, y + below(160) - 80, 1 + below(5), below(8) == 0 ? 1 : 0);
          break;
        case 1:
        case 2:
          window.key(key::left_control, below(3) == 0);
          window.click(x, y);
          window.key(key::left_control, false);
          break;
        case 3:
          window.wheel(below(2) == 0 ? 1 : -1);
          break;
        default:
          window.move(x, y);
          window.press(keys[static_cast<std::size_t>(below(static_cast<std::uint32_t>(keys.size())))]);
      }
    }
    window.press("Shift-Esc");
    window.wait(3);
    EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
    EXPECT_EQ(hash_of_journal(window, "monkey_replayed"), hash(window));
  }
}

TEST(SelectMode, EscDropsTheGhostThenTheSelectionThenTheMode) {
  Offscreen window(small_window("esc"));
  window.press("Tab");
  window.wait(2);
  click_at(window, k_top);
  EXPECT_EQ(selection(window).ids.size(), 1U);
  const std::uint64_t before = hash(window);
  window.press("E");
  window.wait(2);
  EXPECT_TRUE(window.now().ghost);
  window.press("Esc");
  window.wait(2);
  EXPECT_FALSE(window.now().ghost);
  EXPECT_EQ(hash(window), before);
  window.press("Esc");
  window.wait(2);
  EXPECT_TRUE(selection(window).ids.empty());
  window.press("Esc");
  window.wait(2);
  EXPECT_FALSE(desk(window).settings.choosing);
}

TEST(SelectMode, ABoxSelectsWhatIsSeenAndWithShiftAllWithinIt) {
  Offscreen window(small_window("box"));
  window.press("Tab");
  window.wait(2);
  window.drag(110, 60, 620, 500, 4);
  window.wait(2);
  const std::size_t seen = selection(window).ids.size();
  // Three sides of six are seen, of nine faces each.
  EXPECT_EQ(seen, 27U);
  window.key(key::left_shift, true);
  window.drag(110, 60, 620, 500, 4);
  window.key(key::left_shift, false);
  window.wait(2);
  EXPECT_EQ(selection(window).ids.size(), 54U);
  window.drag(110, 60, 112, 62, 1);  // a click beside the clay
  window.wait(2);
  EXPECT_TRUE(selection(window).ids.empty());
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
}

TEST(SelectMode, ADoubleClickTakesTheLoopAndWithShiftTheRing) {
  for (const bool ring : {false, true}) {
    Offscreen window(small_window(ring ? "ring" : "loop"));
    window.press("Tab");
    window.press("Tab");
    window.wait(2);
    // The edge between the middle face of the front and the one above.
    const auto edge_place = [&] {
      for (const Selectable::Line& line : window.now().selectable->lines) {
        const auto& p = window.now().scene->surface.positions;
        const Eigen::Vector3d a = p[line.ends[0]].cast<double>(), b = p[line.ends[1]].cast<double>();
        if (a.y() < -0.2 && b.y() < -0.2 && std::abs(a.z() - b.z()) < 1e-6 && a.z() > 0.25 && a.z() < 0.4 &&
            std::abs(a.x() + b.x()) < 0.1 && a.x() * b.x() <= 0)
          return Eigen::Vector3d(0.5 * (a + b));
      }
      return Eigen::Vector3d(0, 0, 0);
    }();
    const Eigen::Vector2d at = pixel(window, edge_place);
    window.key(key::left_shift, ring);
    window.click(at.x(), at.y());
    window.click(at.x(), at.y());
    window.key(key::left_shift, false);
    window.wait(2);
    // A loop runs round the block at one height; a ring over it, in one column of its faces.
    EXPECT_EQ(selection(window).ids.size(), 12U);
    std::set<long> heights, columns;
    for (const std::uint32_t e : selection(window).ids)
      for (const subdiv::VertexId v : document(window).solid().edge_vertices(subdiv::EdgeId{e})) {
        const Eigen::Vector3d p = document(window).rest().col(static_cast<Eigen::Index>(v.index()));
        heights.insert(std::lround(1e3 * p.z()));
        columns.insert(std::lround(1e3 * p.x()));
      }
    EXPECT_EQ(heights.size(), ring ? 4U : 1U);
    EXPECT_EQ(columns.size(), ring ? 2U : 4U);
    EXPECT_EQ(hash_of_journal(window, "loop_replayed"), hash(window));
  }
}

TEST(SelectMode, GrowShrinkInvertSetsAndMaskByKeys) {
  OffscreenOptions tall = small_window("grow");  // so that the panel shows the sets without scrolling
  tall.height = 900;
  Offscreen window(tall);
  window.press("Tab");
  window.wait(2);
  click_at(window, k_top);
  window.press("Ctrl-=");
  window.wait(2);
  EXPECT_EQ(selection(window).ids.size(), 9U);
  window.press("Ctrl--");
  window.wait(2);
  EXPECT_EQ(selection(window).ids.size(), 1U);
  window.press("Ctrl-G");
  window.wait(2);
  window.type("top");
  window.press("Enter");
  window.wait(2);
  ASSERT_TRUE(document(window).state().sets->contains("top"));
  window.press("Ctrl-I");
  window.wait(2);
  EXPECT_EQ(selection(window).ids.size(), 53U);
  window.click("top");
  window.wait(2);
  EXPECT_EQ(selection(window).ids.size(), 1U);
  window.press("Shift-K");
  window.wait(2);
  ASSERT_FALSE(window.now().mask.empty());
  EXPECT_EQ(*std::max_element(window.now().mask.begin(), window.now().mask.end()), 1);
  EXPECT_EQ(hash_of_journal(window, "grow_replayed"), hash(window));
}

TEST(SelectMode, EveryToolShowsWhatItMakesOrWhyItCannot) {
  struct Case {
    const char* keys;  // that take it
    ElementType type;
    std::vector<Eigen::Vector3d> at;
    std::size_t made, removed;  // cells
    const char* fault;
  };
  const Eigen::Vector3d front(0, -0.25, 0.25), right(0.25, 0, 0.25);
  const std::vector<Case> cases{
      {"Alt-E", ElementType::faces, {k_top}, 1, 0, ""},
      {"S", ElementType::cells, {k_top}, 8, 1, ""},
      {"Del", ElementType::cells, {k_top}, 0, 1, ""},
      {"Shift-C", ElementType::cells, {k_top}, 2, 1, ""},
      {"Shift-S", ElementType::vertices, {Eigen::Vector3d(0.08, -0.25, 0.16)}, 0, 0, ""},
      {"Shift-D", ElementType::cells, {k_top}, 1, 0, ""},
      {"B", ElementType::faces, {front, k_top}, 0, 0, "?"},
      {"M", ElementType::faces, {k_top}, 0, 0, "?"},
      {"Del", ElementType::faces, {k_top}, 0, 0, "cells"},
      {"E", ElementType::cells, {k_top}, 0, 0, "faces"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.keys);
    Offscreen window(small_window("tools"));
    do {
      window.press("Tab");
      window.wait(2);
    } while (desk(window).settings.choosing != one.type);
    for (const Eigen::Vector3d& place : one.at) {
      window.key(key::left_control, true);
      click_at(window, place);
      window.wait(30);
      window.key(key::left_control, false);
    }
    ASSERT_EQ(selection(window).ids.size(), one.at.size());
    const std::uint64_t before = hash(window);
    const std::size_t cells = document(window).solid().cell_count();
    window.press(one.keys);
    window.wait(2);
    ASSERT_NE(desk(window).pending.tool, nullptr);
    ASSERT_TRUE(window.now().ghost);
    EXPECT_EQ(hash(window), before);
    if (*one.fault != '\0') {
      EXPECT_NE(window.now().ghost->fault, "");
      if (*one.fault != '?') {
        EXPECT_THAT(window.now().ghost->fault, HasSubstr(one.fault));
      }
      window.press("Enter");  // is not done, and goes on to say why
      window.wait(2);
      EXPECT_EQ(hash(window), before);
      EXPECT_NE(desk(window).pending.tool, nullptr);
      continue;
    }
    EXPECT_EQ(window.now().ghost->fault, "");
    EXPECT_EQ(window.now().ghost->cells_made, one.made);
    EXPECT_EQ(window.now().ghost->cells_removed, one.removed);
    window.press("Enter");
    window.wait(2);
    EXPECT_EQ(document(window).solid().cell_count(), cells + one.made - one.removed);
    EXPECT_EQ(hash_of_journal(window, "tools_replayed"), hash(window));
    window.press("Ctrl-Z");
    window.wait(2);
    EXPECT_EQ(hash(window), before);
    EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
  }
}

// Tools that join and shape, each where it has something to do: the example of its command.
TEST(SelectMode, WhatIsSelectedByALineIsJoinedCutAndShapedByKeys) {
  struct Case {
    const char* keys;
    std::vector<std::string> before;
    long cells;  // more than before
    const char* line;
  };
  const std::vector<Case> cases{
      {"B",
       {"new box 3 1 1 size 3 1 1", "remove where x > 1 and x < 2", "select faces where x > 0.9 and x < 2.1"},
       2,
       "bridge steps 2"},
      {"M",
       {"new box 3 1 1 size 3 1 1", "remove where x > 1 and x < 2", "select faces where x > 0.9 and x < 2.1"},
       0,
       "merge"},
      {"Alt-F",
       {"new box 3 1 2 size 3 1 2", "remove where x > 1 and x < 2 and z > 1",
        "select faces where x >= 1 and x <= 2 and z > 0.9"},
       1,
       "fill"},
      {"Shift-M",
       {"new box 3 1 1 size 6 2 2", "remove where x > 2 and x < 4", "select vertices where x > 3", "move -2 0 0"},
       0,
       "weld"},
      {"Alt-M",
       {"new box 2 1 1 size 2 1 1", "select edges where x > 1.9 and y > 0.9 and z > 0.1 and z < 0.9"},
       0,
       "collapse"},
      {"Ctrl-R",
       {"new box 2 2 2", "select edges where x < 0.01 and y < 0.01 and z > 0.5"},
       4,
       "cut ring fraction 0.5"},
      {"Shift-E", {"new box 2 2 2", "levels 1", "select edges angle 30"}, 0, "sharpen 10"},
      {"R", {"new box 2 2 2", "select faces where z > 0.9"}, 0, "transform rotate 0"},
      {"T", {"new box 2 2 2", "select faces where z > 0.9"}, 0, "move"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.keys);
    Offscreen window(small_window("joined"));
    window.workshop().run_together(one.before);
    window.wait(2);
    const auto cells = static_cast<long>(document(window).solid().cell_count());
    const std::uint64_t before = hash(window);
    window.move(300, 300);
    // From sculpting: the mode comes with the tool, for it is what is selected that is acted on.
    window.press(one.keys);
    window.wait(3);
    ASSERT_NE(desk(window).pending.tool, nullptr);
    EXPECT_TRUE(desk(window).settings.choosing);
    if (one.line == std::string("bridge steps 2")) window.wheel(1);
    window.wait(2);
    EXPECT_THAT(desk(window).pending.lines().back(), testing::StartsWith(one.line));
    ASSERT_TRUE(window.now().ghost);
    ASSERT_EQ(window.now().ghost->fault, "");
    window.press("Enter");
    window.wait(2);
    EXPECT_EQ(static_cast<long>(document(window).solid().cell_count()), cells + one.cells);
    EXPECT_EQ(window.now().messages.back().kind == MessageKind::error, false);
    if (one.line != std::string("transform rotate 0")) {
      EXPECT_NE(hash(window), before);
    }
    EXPECT_EQ(hash_of_journal(window, "joined_replayed"), hash(window));
    window.press("Ctrl-Z");
    window.wait(2);
    EXPECT_EQ(hash(window), before);
    EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
  }
}

TEST(SelectMode, TheNumberBesideTheGhostSetsTheAmount) {
  Offscreen window(small_window("amount"));
  window.press("Tab");
  window.wait(2);
  click_at(window, k_top);
  window.press("E");
  window.wait(2);
  window.click("Distance");
  window.wait(3);
  window.type("12 cm");
  window.press("Enter");
  window.wait(3);
  EXPECT_NEAR(desk(window).pending.amount, 0.12, 1e-12);
  const Eigen::Vector2d at = pixel(window, k_top);
  window.move(at.x() + 40, at.y());  // it no longer follows the pointer
  EXPECT_NEAR(desk(window).pending.amount, 0.12, 1e-12);
  window.click("Do it");
  window.wait(3);
  EXPECT_EQ(window.now().history->back().line, "extrude 0.12");
}

TEST(SelectMode, AClickDoesWhatTheGhostShowsAndTheRightButtonDropsIt) {
  Offscreen window(small_window("click_commits"));
  window.press("Tab");
  window.wait(2);
  click_at(window, k_top);
  const Eigen::Vector2d at = pixel(window, k_top);
  for (const bool right : {true, false}) {
    const std::uint64_t before = hash(window);
    window.move(at.x(), at.y());
    window.press("E");
    window.move(at.x(), at.y() - 20);
    window.move(at.x(), at.y() - 40);
    window.wait(2);
    ASSERT_TRUE(window.now().ghost);
    window.button(right ? 1 : 0, true);
    window.button(right ? 1 : 0, false);
    window.wait(2);
    EXPECT_EQ(desk(window).pending.tool, nullptr);
    EXPECT_FALSE(window.now().ghost);
    EXPECT_EQ(hash(window) == before, right);
    EXPECT_EQ(desk(window).context_menu_at[0], -1);
  }
  EXPECT_EQ(document(window).solid().cell_count(), 28U);
  EXPECT_GT(window.now().high.z(), 0.52);
}

TEST(SelectMode, WhatIsPointedAtIsLitAndAGhostShows) {
  Offscreen window(small_window("lit"));
  window.press("Tab");
  window.wait(2);
  window.move(20, 500);
  window.wait(2);
  const sculpt::Picture plain = window.picture();
  const Eigen::Vector2d at = pixel(window, k_top);
  window.move(at.x(), at.y());
  window.wait(2);
  const sculpt::Picture lit = window.picture();
  const auto differs = [&](const sculpt::Picture& other, int x, int y) {
    const std::size_t i =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(plain.width) + static_cast<std::size_t>(x));
    return !std::equal(plain.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                       plain.rgba.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                       other.rgba.begin() + static_cast<std::ptrdiff_t>(i));
  };
  EXPECT_TRUE(differs(lit, static_cast<int>(at.x()), static_cast<int>(at.y()) + 8));
  const Eigen::Vector2d front = pixel(window, {0, -0.25, 0.2});
  EXPECT_FALSE(differs(lit, static_cast<int>(front.x()), static_cast<int>(front.y())));
  window.press("E");
  window.move(at.x(), at.y() - 60);
  window.wait(2);
  ASSERT_TRUE(window.now().ghost);
  ASSERT_EQ(window.now().ghost->fault, "");
  const Eigen::Vector2d above = pixel(window, {0, 0, 0.5 + 0.7 * desk(window).pending.amount});
  EXPECT_TRUE(differs(window.picture(), static_cast<int>(above.x()), static_cast<int>(above.y())));
}

// On the control solid itself edits add to arrays in place: a ghost must not touch those of the document.
TEST(Ghost, LeavesTheDocumentAloneAndOnlyTheLastIsMade) {
  for (const int level : {0, 1}) {
    BenchOptions bench;
    bench.out = test_folder("ghost");
    Workshop workshop(bench);
    workshop.run_together({"new box 3 3 2", "select faces where z > 0.9"});
    if (level > 0) workshop.run("levels 1");
    workshop.advance(0);
    const auto& session = workshop.bench().session();
    const std::uint64_t before = session.document().state_hash();
    for (int i = 1; i <= 20; ++i) workshop.preview({fmt::format("extrude {}", 0.01 * i)});
    workshop.advance(0);
    ASSERT_TRUE(workshop.latest()->ghost);
    EXPECT_EQ(workshop.latest()->ghost->lines.front(), "extrude 0.2");
    EXPECT_EQ(workshop.latest()->ghost->fault, "");
    EXPECT_EQ(workshop.latest()->ghost->cells_made, 9U);
    EXPECT_EQ(session.document().state_hash(), before);
    workshop.preview({"extrude 0.1", "select faces none", "split"});
    workshop.advance(0);
    EXPECT_THAT(workshop.latest()->ghost->fault, HasSubstr("split"));
    for (const char* line : {"undo", "save x.vtu", "nonsense"}) {
      workshop.preview({line});
      workshop.advance(0);
      EXPECT_NE(workshop.latest()->ghost->fault, "") << line;
    }
    EXPECT_EQ(session.document().state_hash(), before);
    workshop.run("extrude 0.2");
    workshop.advance(0);
    EXPECT_FALSE(workshop.latest()->ghost);
    const std::uint64_t after = session.document().state_hash();
    workshop.run_together({"undo"});
    workshop.advance(0);
    EXPECT_EQ(session.document().state_hash(), before);
    workshop.run_together({"redo"});
    workshop.advance(0);
    EXPECT_EQ(session.document().state_hash(), after);
  }
}

TEST(Ghost, IsMadeByTheWorkshopsThreadWhileFramesGoOn) {
  BenchOptions bench;
  bench.out = test_folder("ghost_thread");
  Workshop workshop(bench);
  workshop.start();
  workshop.frame_begins();
  workshop.run_together({"new box 2 2 2", "levels 1", "select faces where z > 0.9"});
  workshop.preview({"extrude 0.3"});
  // As many looks as it takes: no clock is read, and a workshop that does nothing fails by the test's time limit.
  while (!workshop.latest()->ghost) std::this_thread::yield();
  workshop.frame_ends();
  EXPECT_EQ(workshop.latest()->ghost->cells_made, 4U);
  EXPECT_EQ(workshop.lines_run_in_frames(), 0);
}

TEST(SelectMode, TheContextMenuListsWhatCanBeDoneAndDoesIt) {
  Offscreen window(small_window("context"));
  window.press("Tab");
  window.wait(2);
  click_at(window, k_top);
  const Eigen::Vector2d at = pixel(window, k_top);
  window.move(at.x(), at.y());
  window.button(1, true);
  window.button(1, false);
  window.wait(2);
  ASSERT_NE(window.studio().ui().find("Let go"), nullptr);
  std::size_t rows = 0;
  for (const Control& control : window.studio().ui().controls()) rows += control.name == "Extrude";
  EXPECT_GE(rows, 2U);  // in the panel and in the menu
  window.press("Esc");
  window.wait(2);
  EXPECT_EQ(selection(window).ids.size(), 1U);  // Esc only closed the menu
}

TEST(SelectMode, TheCutLaysCellsOpenToSelect) {
  Offscreen window(small_window("cut_cells"));
  window.press("Numpad 1");
  window.wait(60);
  window.press("C");
  for (int i = 0; i < 4; ++i) window.press("Tab");
  window.wait(2);
  ASSERT_EQ(desk(window).settings.choosing, ElementType::cells);
  // The middle cell of 27 has no boundary face; the plane through the middle of the block lays it open.
  click_at(window, {0.05, 0, 0.22});
  ASSERT_EQ(selection(window).ids.size(), 1U);
  const auto uses = document(window).solid().cell_face_uses(subdiv::CellId{selection(window).ids[0]});
  for (const auto use : uses) EXPECT_FALSE(document(window).solid().is_boundary(subdiv::face_of(use)));
}

TEST(Peel, TheWheelPeelsDeeperAndToolsWorkOnWhatIsLaidOpen) {
  Offscreen window(small_window("peel"));
  const std::size_t faces = window.now().scene->surface.cell_from_face.size();
  window.press("P");
  window.wait(2);
  EXPECT_EQ(desk(window).settings.peel, 1);
  EXPECT_EQ(window.now().layers, 5);  // twelve finest cells across
  const std::size_t peeled = window.now().scene->surface.cell_from_face.size();
  EXPECT_EQ(peeled, 600U);  // six sides of ten by ten
  EXPECT_LT(peeled, faces);
  const Eigen::Vector2d at = pixel(window, {0, -0.2, 0.25});
  window.move(at.x(), at.y());
  window.wheel(1);
  window.wheel(1);
  window.wait(2);
  EXPECT_EQ(desk(window).settings.peel, 3);
  EXPECT_EQ(window.now().scene->surface.cell_from_face.size(), 6U * 36);
  // Stiffness is painted inside, and the line of the session says so.
  const std::uint64_t before = hash(window);
  window.click("Paint stiffness");
  window.wait(2);
  window.drag(at.x(), at.y(), at.x() + 20, at.y(), 6);
  window.wait(2);
  EXPECT_NE(hash(window), before);
  EXPECT_THAT(window.now().history->back().line, HasSubstr("inside"));
  EXPECT_EQ(hash_of_journal(window, "peel_replayed"), hash(window));
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
}

TEST(MaskBrush, PaintsAVeilThatPullsRespect) {
  Offscreen window(small_window("mask"));
  const std::uint64_t before = hash(window);
  window.click("Mask");
  window.wait(2);
  const Eigen::Vector2d at = pixel(window, k_top);
  window.move(at.x(), at.y());
  window.move(at.x(), at.y());
  window.button(0, true);
  window.move(at.x() + 10, at.y());
  window.wait(4);
  EXPECT_FALSE(window.now().mask.empty()) << "the veil shows while it is painted";
  window.button(0, false);
  window.wait(2);
  const std::uint64_t masked = hash(window);
  EXPECT_NE(masked, before);
  // Where all is masked, a pull is refused and says so at the cursor.
  window.workshop().run("set mask 1");
  window.wait(2);
  window.click("Pull");
  window.drag(at.x(), at.y(), at.x(), at.y() - 40, 5);
  window.wait(2);
  ASSERT_FALSE(window.now().messages.empty());
  EXPECT_THAT(window.now().messages.back().text, HasSubstr("masked"));
  window.press("Ctrl-Z");
  window.wait(2);
  EXPECT_EQ(hash(window), masked);
  window.press("Ctrl-Z");
  window.wait(2);
  EXPECT_EQ(hash(window), before);
  EXPECT_EQ(hash_of_journal(window, "mask_replayed"), hash(window));
}

TEST_P(OnModels, ACurveIsLaidByClicksAndItsHandlesDrawTheClay) {
  Offscreen window(small_window("curve_" + name()), file());
  window.click("Curve");
  window.wait(2);
  // Three places in a row that are seen.
  std::vector<Eigen::Vector2d> places;
  const Eigen::Vector2d middle = pixel(window, 0.5 * (window.now().low + window.now().high));
  for (int i = -40; i <= 40 && places.size() < 3; ++i) {
    const Eigen::Vector2d at = middle + Eigen::Vector2d(4.0 * i, 0);
    const auto hit = pick(window.now().scene->surface, window.studio().viewport().camera().ray(at.x(), at.y()));
    if (hit && (places.empty() || (at - places.back()).norm() > 30)) places.push_back(at);
  }
  ASSERT_EQ(places.size(), 3U);
  for (const Eigen::Vector2d& at : places) window.click(at.x(), at.y());
  window.click(middle.x() + 10, middle.y() + 14);
  window.wait(2);
  const std::size_t laid = desk(window).curve.points.size();
  EXPECT_GE(laid, 3U);
  window.press("Backspace");
  window.wait(2);
  EXPECT_EQ(desk(window).curve.points.size(), laid - 1);
  while (desk(window).curve.points.size() > 3) window.press("Backspace");
  ASSERT_TRUE(window.now().curve);
  EXPECT_GT(window.now().curve->line.size(), 10U);
  const std::uint64_t before = hash(window);
  const std::size_t depth = window.now().undo_depth;
  window.press("Enter");
  EXPECT_TRUE(desk(window).curve.finished);
  window.wait(2);
  const Eigen::Vector3d handle = window.now().curve->handles[1];
  const Eigen::Vector2d grip = pixel(window, handle);
  window.drag(grip.x(), grip.y(), grip.x(), grip.y() - 30, 10);
  window.wait(2);
  EXPECT_NE(hash(window), before);
  const auto& history = *window.now().history;
  EXPECT_TRUE(std::any_of(history.begin(), history.end(),
                          [](const HistoryEntry& entry) { return entry.line.starts_with("curve through"); }));
  EXPECT_GT((window.now().curve->handles[1] - handle).norm(), 0);
  EXPECT_EQ(hash_of_journal(window, "curve_replayed_" + name()), hash(window));
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);
  window.press("Ctrl-Z");
  window.wait(2);
  EXPECT_EQ(hash(window), before);
  EXPECT_EQ(window.now().undo_depth, depth);
  window.press("Esc");
  window.wait(2);
  EXPECT_TRUE(desk(window).curve.points.empty());
  EXPECT_FALSE(window.now().curve);
}

}  // namespace
}  // namespace argil::studio
