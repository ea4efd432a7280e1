// The whole window, driven off the screen as a hand would: what the document is afterwards, that what was done is a
// session which gives it again, and that no frame runs a command.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include "io/file_bytes.h"
#include "sculpt/session.h"
#include "tools/studio/offscreen.h"

namespace argil::studio {
namespace {

std::filesystem::path folder(const char* name) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "studio" / name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

OffscreenOptions options(const char* name) {
  OffscreenOptions result;
  result.width = 960;
  result.height = 640;
  result.card = false;
  result.bench.out = folder(name);
  return result;
}

std::uint64_t hash(Offscreen& window) {
  return window.workshop().bench().session().document().state_hash();
}

std::uint64_t hash_of_replay(const std::filesystem::path& file, const char* name) {
  sculpt::SessionOptions replay;
  replay.out = folder(name);
  sculpt::Session session(replay);
  session.run_text(io::read_file(file), file.string());
  return session.document().state_hash();
}

// A place on the block, as the camera sees it.
Eigen::Vector2d on_block(Offscreen& window) {
  const Snapshot& now = window.now();
  const Eigen::Vector3d top(0.5 * (now.low.x() + now.high.x()), 0.5 * (now.low.y() + now.high.y()), now.high.z());
  return window.studio().viewport().camera().pixel(top);
}

TEST(Window, PullUndoRedoSaveReopenAndReplayGiveOneHash) {
  Offscreen window(options("pull"));
  ASSERT_TRUE(window.now().scene);
  EXPECT_EQ(window.now().state.level, 2);
  const Eigen::Vector2d at = on_block(window);
  window.move(at.x(), at.y());
  window.wait(2);
  EXPECT_TRUE(window.studio().desk().reading.there);
  EXPECT_NEAR(window.studio().desk().reading.young_modulus, 2e4, 1);

  const std::uint64_t before = hash(window);
  const std::size_t depth = window.now().undo_depth;
  const double top = window.now().high.z();
  window.button(0, true);
  for (int i = 1; i <= 12; ++i) window.move(at.x(), at.y() - 6 * i);
  ASSERT_TRUE(window.now().stroke);
  EXPECT_GT(window.now().stroke->force.z(), 0);
  EXPECT_GT(window.now().high.z(), top);  // it follows while the pointer moves
  window.button(0, false);
  window.wait(2);
  EXPECT_FALSE(window.now().stroke);
  const std::uint64_t pulled = hash(window);
  EXPECT_NE(pulled, before);
  EXPECT_GT(window.now().undo_depth, depth);
  const auto& rest = window.workshop().bench().session().document();
  EXPECT_EQ(rest.rest(), rest.positions());  // the shape was kept

  window.press("Ctrl-Z");  // the whole stroke, with what belongs to it
  window.wait();
  EXPECT_EQ(hash(window), before);
  EXPECT_EQ(window.now().undo_depth, depth);
  // Turning the view loses no redo.
  window.drag(at.x() + 330, 560, at.x() + 250, 520, 5, 2);
  window.press("Ctrl-Shift-Z");
  window.wait();
  EXPECT_EQ(hash(window), pulled);

  const std::filesystem::path file = window.workshop().bench().session().options().out / "mine.argil";
  window.press("Ctrl-S");
  window.wait(2);
  window.press("Ctrl-A");
  window.type(file.string());
  window.press("Enter");
  window.wait(3);
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_TRUE(window.now().saved);
  EXPECT_EQ(hash_of_replay(file, "pull_replayed"), pulled);
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);

  Offscreen again(options("reopened"), file);
  EXPECT_EQ(hash(again), pulled);
  EXPECT_EQ(again.now().file, file.string());
}

TEST(Window, EscTakesAStrokeBack) {
  Offscreen window(options("cancel"));
  const Eigen::Vector2d at = on_block(window);
  const std::uint64_t before = hash(window);
  window.move(at.x(), at.y());
  window.move(at.x(), at.y());
  window.button(0, true);
  for (int i = 1; i <= 6; ++i) window.move(at.x() + 5 * i, at.y() - 5 * i);
  EXPECT_NE(hash(window), before);
  window.press("Esc");
  window.wait();
  EXPECT_EQ(hash(window), before);
  window.button(0, false);
  window.wait(2);
  EXPECT_EQ(hash(window), before);
}

TEST(Window, AChordWithinOneFrameKeepsItsModifiers) {
  Offscreen window(options("chord"));
  window.workshop().run("levels 1");
  window.wait();
  ASSERT_EQ(window.now().state.level, 1);
  window.together({{key::left_control, true}, {'Z', true}, {'Z', false}, {key::left_control, false}});
  window.wait();
  EXPECT_EQ(window.now().state.level, 2);
  // In a text field as well.
  window.press("F3");
  window.wait(2);
  window.type("levels 9");
  window.together({{key::backspace, true}, {key::backspace, false}});
  window.type("1");
  window.together({{key::enter, true}, {key::enter, false}});
  window.wait(2);
  EXPECT_EQ(window.now().state.level, 1);
}

TEST(Window, ShiftEscSwitchesAllForceOff) {
  Offscreen window(options("off"));
  window.workshop().run_together({"force 0 0 5 where z > 0.49", "gravity 0 0 -9.81"});
  window.press("Space");
  window.wait(4);
  EXPECT_TRUE(window.now().playing);
  EXPECT_GT(window.now().steps, 0);
  window.press("Shift-Esc");
  window.wait(2);
  EXPECT_FALSE(window.now().playing);
  EXPECT_TRUE(window.now().state.loads->forces.empty());
  EXPECT_TRUE(window.now().state.loads->gravity.isZero());
  const long steps = window.now().steps;
  window.wait(4);
  EXPECT_EQ(window.now().steps, steps);
}

TEST(Window, DragBesideOrbitsAndTheWheelZooms) {
  Offscreen window(options("view"));
  const std::uint64_t before = hash(window);
  const Eigen::Vector3d eye = window.studio().viewport().camera().eye();
  window.drag(120, 520, 220, 500, 6);
  const Eigen::Vector3d turned = window.studio().viewport().camera().eye();
  EXPECT_GT((turned - eye).norm(), 0.1 * eye.norm());
  window.move(300, 500);
  window.wheel(3);
  const OrbitCamera& camera = window.studio().viewport().camera();
  EXPECT_LT((camera.eye() - camera.pivot()).norm(), 0.75 * (turned - camera.pivot()).norm());
  EXPECT_EQ(hash(window), before);
  window.press("Numpad 7");
  window.wait(60);
  EXPECT_NEAR(camera.towards_eye().z(), 1, 1e-6);
}

TEST(Window, KeysSizeTheBrushAndShowFieldsCutAndCage) {
  Offscreen window(options("keys"));
  const Desk& desk = window.studio().desk();
  const Eigen::Vector2d at = on_block(window);
  const double radius = desk.brush.radius;
  window.press("]");
  EXPECT_NEAR(desk.brush.radius, 1.1 * radius, 1e-12);
  window.press("[");
  window.move(at.x(), at.y());
  window.press("F");
  for (int i = 1; i <= 5; ++i) window.move(at.x() + 8 * i, at.y());
  window.button(0, true);
  window.button(0, false);
  EXPECT_GT(desk.brush.radius, 1.2 * radius);
  EXPECT_FALSE(window.now().stroke);

  window.press("V");
  window.wait();
  ASSERT_TRUE(window.now().scene->legend);
  EXPECT_EQ(window.now().scene->legend->title, "strain");
  const std::uint64_t layout = window.now().layout;
  window.press("C");
  window.wait();
  const auto& cut = window.now().scene->surface.cut_faces;
  EXPECT_GT(std::count(cut.begin(), cut.end(), 1), 0);
  EXPECT_NE(window.now().layout, layout);
  const Eigen::Vector3d plane = desk.settings.cut_point;
  window.wheel(2);
  EXPECT_GT((desk.settings.cut_point - plane).norm(), 0.01);
  window.press("C");
  window.press("G");
  window.wait();
  EXPECT_FALSE(window.now().scene->cage_points.empty());
  window.press("W");
  EXPECT_FALSE(desk.settings.wireframe);
}

TEST(Window, TheSearchRunsLinesAndNumbersTakeUnits) {
  Offscreen window(options("search"));
  window.press("F3");
  window.wait(2);
  window.type("levels 1");
  window.press("Enter");
  window.wait(2);
  EXPECT_EQ(window.now().state.level, 1);
  EXPECT_EQ(window.studio().desk().dialogue, Dialogue::none);

  window.click("Material");
  window.wait(2);
  window.click("Young's modulus");
  window.wait(3);
  window.type("3/100 MPa");
  window.press("Enter");
  window.wait(3);
  EXPECT_NEAR(window.now().materials[0].mean, 3e4, 1e-6);
  window.press("Ctrl-Z");
  window.wait(2);
  EXPECT_NEAR(window.now().materials[0].mean, 2e4, 1e-6);
}

TEST(Window, ThePhysicsPanelLetsClayFlowAndPlotsEnergy) {
  Offscreen window(options("flow"));
  // Of the two controls named Physics the first is the menu.
  window.studio().desk().settings.panel = Panel::physics;
  window.wait(2);
  window.click("Flows");
  window.wait(3);
  EXPECT_TRUE(window.now().state.plasticity.on);
  EXPECT_NEAR(window.now().state.plasticity.law.yield, 1000, 1e-9);
  window.press("Ctrl-Z");
  window.wait(2);
  EXPECT_FALSE(window.now().state.plasticity.on);
  window.workshop().run("gravity 0 0 -9.81");
  window.press("Space");
  window.wait(20);
  window.press("Space");
  window.wait(2);
  EXPECT_GT(window.studio().desk().energy_plot.size(), 5U);
  EXPECT_GT(window.now().energy, 0);
}

TEST(Window, EveryControlHasATooltipAndEveryNumberItsUnit) {
  Offscreen window(options("controls"));
  std::size_t seen = 0;
  const auto check = [&] {
    for (const Control& control : window.studio().ui().controls()) {
      ++seen;
      EXPECT_FALSE(control.name.empty());
      EXPECT_GT(control.tooltip.size(), 3U) << control.name;
      // Numbers without a unit are counts, shares and factors, which say so.
      static const std::set<std::string> k_pure{"Factor",   "Level",    "Poisson's ratio",
                                                "Normal x", "Normal y", "Normal z"};
      if (control.kind == ControlKind::number && !k_pure.contains(control.name)) {
        EXPECT_FALSE(control.unit.empty()) << control.name;
      }
    }
  };
  for (const char* panel : k_panel_names) {
    window.click(panel);
    window.wait(2);
    check();
  }
  window.press("C");
  window.click("Fields");
  window.wait(2);
  check();
  for (std::size_t tool = 0; tool < shelf_tools().size(); ++tool) {
    window.click(shelf_tools()[tool].label);
    window.wait(2);
    check();
  }
  for (const char* keys : {"F3", "Esc", "F1", "Esc", "Ctrl-O", "Esc"}) {
    window.press(keys);
    window.wait(2);
    check();
  }
  for (const char* menu : {"File", "Edit", "Select", "Solid", "Tool", "Physics", "View", "Help"}) {
    window.click(menu);
    window.wait(2);
    check();
    window.press("Esc");
  }
  EXPECT_GT(seen, 400U);
}

TEST(Window, TheSameScriptGivesTheSamePicture) {
  const auto picture = [](const char* name) {
    OffscreenOptions small = options(name);
    small.width = 640;
    small.height = 400;
    Offscreen window(small);
    const Eigen::Vector2d at = on_block(window);
    window.drag(at.x(), at.y(), at.x() + 20, at.y() - 30, 8);
    window.wait(2);
    return window.picture();
  };
  const sculpt::Picture first = picture("picture_1"), second = picture("picture_2");
  EXPECT_EQ(first.rgba, second.rgba);
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i + 3 < first.rgba.size(); i += 4)
    colours.insert(static_cast<std::uint32_t>(first.rgba[i] | first.rgba[i + 1] << 8 | first.rgba[i + 2] << 16));
  EXPECT_GT(colours.size(), 500U);  // something is drawn
}

TEST(Window, WithoutADisplayTheProgramSaysSo) {
  const std::filesystem::path said = folder("no_display") / "said.txt";
  const std::string command = "env -u DISPLAY -u WAYLAND_DISPLAY " ARGIL_PROGRAM " 2> " + said.string();
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(io::read_file(said).find("expected a display"), std::string::npos);
}

// With its thread a workshop does orders while frames go on; the snapshot is there at any time.
TEST(Window, AThreadDoesWhatFramesOrder) {
  BenchOptions bench;
  bench.out = folder("thread");
  Workshop workshop(bench);
  workshop.start();
  workshop.frame_begins();
  workshop.run_together({"new box 2 2 2", "levels 1"});
  // As many looks as it takes: no clock is read, and a workshop that does nothing fails by the test's time limit.
  while (!workshop.latest()->scene) std::this_thread::yield();
  workshop.frame_ends();
  EXPECT_EQ(workshop.lines_run_in_frames(), 0);
  EXPECT_EQ(workshop.latest()->state.level, 1);
}

}  // namespace
}  // namespace argil::studio
