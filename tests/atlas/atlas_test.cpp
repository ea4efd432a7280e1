// The atlas against what is known: the limit of explicit methods on a linear body, synthetic lines, and its own
// rows after a kill.

#include "tools/atlas/atlas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <pugixml.hpp>

#include "fem/spectrum/pencil.h"
#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tools/atlas/map.h"
#include "tools/atlas/page.h"

namespace argil::atlas {
namespace {

using testing::HasSubstr;

/// v += Δt M̃⁻¹ f(p), p += Δt v: stable iff Δt < 2/ω_max on a linear body. `gain` multiplies the velocity each step,
/// to break it on purpose.
class SymplecticEuler final : public Stepper {
 public:
  SymplecticEuler(const fem::System& system, double gain)
      : system_(system), mass_(*system.mass, fem::moving_control_points(system)), gain_(gain) {}
  void step(const fem::Loads& loads, fem::BodyState& state, double time_step) override {
    Eigen::Matrix3Xd node_forces, acceleration;
    system_.model->forces(fem::nodes(system_, state.positions), node_forces);
    Eigen::Matrix3Xd forces = fem::generalised_forces(system_, node_forces);
    if (loads.forces.cols() > 0) forces += loads.forces;
    mass_.solve(forces, acceleration);
    state.velocities = gain_ * (state.velocities + time_step * acceleration);
    state.positions += time_step * state.velocities;
    state.time += time_step;
  }

 private:
  fem::System system_;
  fem::InverseMass mass_;
  double gain_;
};

Integration symplectic_euler(double gain = 1) {
  return {gain == 1 ? "test_symplectic" : "test_wrong", false,
          [gain](const fem::System& system) { return std::make_unique<SymplecticEuler>(system, gain); }};
}

Integration by_name(const std::string& name) {
  for (const Integration& integration : integrations())
    if (integration.name == name) return integration;
  throw std::runtime_error(name);
}

Sweep sweep_by_name(const std::string& name) {
  for (const Sweep& sweep : sweep_table())
    if (sweep.name == name) return sweep;
  throw std::runtime_error(name);
}

std::filesystem::path new_folder(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("atlas_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

TEST(SearchLine, FindsEveryChangeBetweenNeighbours) {
  const LineGrid grid{.coarse = 4, .depth = 5};
  int asked = 0;
  const auto points = search_line(grid, [&](int position) {
    ++asked;
    return position < 37 ? Outcome::stable : position < 41 ? Outcome::inaccurate : Outcome::diverged;
  });
  EXPECT_LE(asked, 5 + 2 * 5);  // coarse points, and a bisection for each change
  const auto found = stretches(grid, points);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].outcome, Outcome::stable);
  EXPECT_EQ(found[0].begin, 0);
  EXPECT_EQ(found[0].end, 36.5);
  EXPECT_EQ(found[1].begin, 36.5);
  EXPECT_EQ(found[1].end, 40.5);
  EXPECT_EQ(found[2].outcome, Outcome::diverged);
  EXPECT_EQ(found[2].end, 128);
}

TEST(SearchLine, AsksOnlyTheCoarsePointsWhereNothingChanges) {
  const LineGrid grid{.coarse = 6, .depth = 5};
  const auto points = search_line(grid, [](int) { return Outcome::diverged; });
  EXPECT_EQ(points.size(), 7U);
  const auto found = stretches(grid, points);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].begin, 0);
  EXPECT_EQ(found[0].end, grid.last());
}

TEST(SearchLine, FindsAnIslandThatACoarsePointHits) {
  const LineGrid grid{.coarse = 4, .depth = 3};
  const auto found = stretches(grid, search_line(grid, [](int position) {
                                 return position > 12 && position < 20 ? Outcome::inaccurate : Outcome::stable;
                               }));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[1].begin, 12.5);
  EXPECT_EQ(found[1].end, 19.5);
}

TEST(Axis, GivesValuesThatFilesRepeatAndTheirShares) {
  const Axis axis{&Scene::time_step, 1e-4, 1, true};
  EXPECT_EQ(axis.at(0), 1e-4);
  EXPECT_EQ(axis.at(1), 1);
  EXPECT_NEAR(axis.share_of(axis.at(0.3)), 0.3, 1e-9);
  const Axis falling{&Scene::poisson_gap, 0.5, 1e-4, true};
  EXPECT_NEAR(falling.share_of(falling.at(0.7)), 0.7, 1e-9);
}

// METHODS §5: with a linear model and no damping the boundary is 2/ω_max, whatever the stiffness. A point of the
// grid is 10^(1/128), 1.8 %, so that the middle between two is within 0.9 % of the change, and 120 steps see an
// instability 0.5 % beyond it.
TEST(Atlas, ExplicitMethodOnALinearBodyFailsAtItsLimitWithinTwoPerCent) {
  Sweep sweep = sweep_by_name("time_step");
  sweep.searched.first = 1e-4;
  AtlasOptions options;
  options.grid = {.coarse = 4, .depth = 7};
  options.lines = 3;
  options.line_depth = 0;
  options.criteria.reference_steps = 80;
  const auto folder = new_folder("limit");
  ProbeStore store(folder / "probes.csv");
  const auto panels = run_sweep(sweep, {{{.name = "linear"}, symplectic_euler()}}, options, store);
  ASSERT_EQ(panels.size(), 1U);
  ASSERT_EQ(panels[0].lines.size(), 3U);
  double last = 1e300;
  for (const MapLine& line : panels[0].lines) {
    const auto diverged = std::find_if(line.stretches.begin(), line.stretches.end(),
                                       [](const Stretch& s) { return s.outcome == Outcome::diverged; });
    ASSERT_NE(diverged, line.stretches.end());
    EXPECT_EQ(diverged + 1, line.stretches.end());
    EXPECT_EQ(line.stretches.front().outcome, Outcome::stable);
    const double boundary = searched_value(sweep, options.grid, diverged->begin);
    const double limit = line.probes.front().result.largest_stable_step;
    EXPECT_NEAR(boundary / limit, 1, 0.02);
    EXPECT_NEAR(sweep.searched.at(limit_share(sweep, line)) / limit, 1, 1e-6);
    EXPECT_LT(limit, last);  // stiffer bodies want smaller steps
    last = limit;
  }
  EXPECT_NEAR(panels[0].lines[0].probes[0].result.largest_stable_step /
                  panels[0].lines[2].probes[0].result.largest_stable_step,
              100, 1e-3);  // 1e4 times the stiffness
  EXPECT_THAT(statement(sweep, options.grid, panels[0]), HasSubstr("of 2/ω_max"));
}

TEST(Atlas, TellsWrongFromCoarseFromGood) {
  const Sweep sweep = sweep_by_name("time_step");
  Criteria criteria;
  criteria.reference_steps = 200;
  Workbench bench(criteria);
  Scene scene = sweep.scene;
  const fem::ModelChoice linear{.name = "linear"};
  scene.time_step = 2e-4;
  const ProbeResult good = bench.run(scene, linear, by_name("bdf2"));
  EXPECT_EQ(good.outcome, Outcome::stable) << good.note;
  EXPECT_LT(good.error, 0.03);          // 0.0215: the front of the wave that is let go, which has all frequencies
  EXPECT_LE(good.energy_ratio, 1.001);  // BDF2 takes energy away
  // A method of first order is worse at the same step, and the worse the longer.
  const ProbeResult damped = bench.run(scene, linear, by_name("implicit_euler"));
  EXPECT_GT(damped.error, 3 * good.error);
  scene.time_step = 2e-2;
  const ProbeResult coarse = bench.run(scene, linear, by_name("implicit_euler"));
  EXPECT_EQ(coarse.outcome, Outcome::inaccurate) << coarse.note;
  EXPECT_GT(coarse.error, 0.1);
  // A velocity that grows by 10 % each step is found out.
  scene.time_step = 2e-4;
  EXPECT_EQ(bench.run(scene, linear, symplectic_euler()).outcome, Outcome::stable);
  const ProbeResult wrong = bench.run(scene, linear, symplectic_euler(1.1));
  EXPECT_EQ(wrong.outcome, Outcome::diverged) << wrong.note;
  // What has no meaning is refused, not drawn as a failure.
  scene.time_step = 1;
  EXPECT_EQ(bench.run(scene, linear, by_name("bdf2")).outcome, Outcome::inaccurate);
}

// A linear model turns a rotation into a swelling, so a free body loses its way at small angles already.
TEST(Atlas, LinearModelFailsUnderRotationWhereTheCorotationalOneDoesNot) {
  const Sweep sweep = sweep_by_name("rotation");
  Criteria criteria;
  criteria.reference_steps = 100;
  Workbench bench(criteria);
  Scene scene = sweep.scene;
  scene.young_modulus = 1e6;
  scene.rotation = 0.05;
  EXPECT_EQ(bench.run(scene, {.name = "corotational"}, by_name("bdf2"), "corotational").outcome, Outcome::stable);
  const ProbeResult linear = bench.run(scene, {.name = "linear"}, by_name("bdf2"), "corotational");
  EXPECT_NE(linear.outcome, Outcome::stable);
}

TEST(Atlas, EveryScenesBodyCanBeMadeAndHasAPeriodAndALimit) {
  for (const Sweep& sweep : sweep_table())
    for (const double swept : {0.0, 1.0}) {
      SCOPED_TRACE(sweep.name);
      const Body body(scene_at(sweep, swept, 0.5), {});
      EXPECT_GT(body.duration(), 0);
      EXPECT_GT(body.largest_frequency(), 0);
      EXPECT_LT(2 / body.largest_frequency(), body.duration());
      const bool inverted = sweep.scene.motion == Motion::invert && swept > 0.5;
      EXPECT_EQ(body.is_inverted(body.start().positions), inverted);
      EXPECT_FALSE(body.is_inverted(body.rest()));
    }
}

AtlasOptions small_options() {
  AtlasOptions options;
  options.grid = {.coarse = 2, .depth = 1};
  options.lines = 2;
  options.line_depth = 1;
  options.criteria.least_steps = 20;
  options.criteria.most_steps = 60;
  options.criteria.reference_steps = 20;
  return options;
}

std::vector<AtlasMethod> small_methods() {
  return {{{.name = "linear"}, symplectic_euler()}, {{.name = "corotational"}, by_name("bdf2")}};
}

TEST(Atlas, GoesOnAfterAKillAndEndsWithTheSameFileForAnyNumberOfThreads) {
  const Sweep sweep = sweep_by_name("young_modulus");
  AtlasOptions options = small_options();
  const auto folder = new_folder("resume");
  const auto whole = folder / "probes.csv";
  std::string first;
  std::size_t rows = 0;
  {
    ProbeStore store(whole);
    options.threads = 1;
    static_cast<void>(run_sweep(sweep, small_methods(), options, store));
    store.sort_file();
    first = io::read_file(whole);
    rows = store.made();
    EXPECT_EQ(store.taken_over(), 0U);
  }
  EXPECT_EQ(read_rows(first).size(), rows);
  EXPECT_GE(rows, 2U * 2U * 3U);  // methods, lines, points
  // Killed in the middle of a row.
  const std::size_t cut = first.find('\n', first.size() / 2) + 30;
  std::ofstream(whole, std::ios::trunc) << first.substr(0, cut);
  {
    ProbeStore store(whole);
    options.threads = 3;
    static_cast<void>(run_sweep(sweep, small_methods(), options, store));
    EXPECT_GT(store.taken_over(), rows / 3);
    EXPECT_EQ(store.taken_over() + store.made(), rows);
    store.sort_file();
  }
  EXPECT_EQ(io::read_file(whole), first);
  {
    ProbeStore store(whole);
    static_cast<void>(run_sweep(sweep, small_methods(), options, store));
    EXPECT_EQ(store.made(), 0U);
  }
  // Another file is not overwritten.
  std::ofstream(folder / "other.csv") << "price,of,eggs\n";
  EXPECT_THROW(ProbeStore(folder / "other.csv"), Error);
  EXPECT_EQ(io::read_file(folder / "other.csv"), "price,of,eggs\n");
}

TEST(Atlas, KeyChangesWithEverythingThatIsRun) {
  const Sweep sweep = sweep_by_name("pull");
  const AtlasMethod method{{.name = "linear"}, by_name("bdf2")};
  const Scene scene = scene_at(sweep, 0.5, 0.5);
  const Criteria criteria;
  const std::uint64_t key = probe_key(sweep, scene, method, criteria);
  for (const ParameterInfo& info : parameter_table()) {
    Scene other = scene;
    other.*info.value += 0.125;
    EXPECT_NE(probe_key(sweep, other, method, criteria), key) << info.name;
  }
  EXPECT_NE(probe_key(sweep, scene, {{.name = "corotational"}, by_name("bdf2")}, criteria), key);
  EXPECT_NE(probe_key(sweep, scene, {{.name = "linear"}, by_name("implicit_euler")}, criteria), key);
  Criteria other = criteria;
  other.error = 0.2;
  EXPECT_NE(probe_key(sweep, scene, method, other), key);
}

TEST(Records, RowsSurviveTheFile) {
  ProbeRow row{.key = 0xfedcba9876543210,
               .sweep = "pull",
               .model = "linear",
               .integrator = "bdf2",
               .swept = 1.0 / 3,
               .searched = 1e-5,
               .time_step = 1e-5,
               .result = {.outcome = Outcome::diverged,
                          .energy_ratio = std::numeric_limits<double>::infinity(),
                          .steps = 17,
                          .largest_stable_step = 0.1,
                          .note = "not finite after 17 steps"}};
  const auto rows = read_rows(csv_header() + csv_line(row) + csv_line(row).substr(0, 50));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(csv_line(rows[0]), csv_line(row));
  EXPECT_TRUE(std::isnan(rows[0].result.error));
}

/// Lines with what a map may have to show, without a run.
std::vector<Panel> drawn_panels(const Sweep& sweep, const LineGrid& grid) {
  std::vector<Panel> panels{{"linear", "bdf2", true, {}}, {"a < b & \"c\"", "leapfrog", false, {}}};
  for (Panel& panel : panels)
    for (const double swept : {0.0, 0.5, 1.0}) {
      MapLine line{.swept = swept, .probes = {}, .stretches = {}};
      const double last = grid.last(), at = last * (0.3 + 0.4 * swept);
      if (panel.is_implicit)
        line.stretches = {{0, last, Outcome::stable}};
      else
        line.stretches = {{0, at, Outcome::stable}, {at, last, Outcome::diverged}};
      for (const int position : {0, grid.last()}) {
        ProbeRow row;
        row.searched = searched_value(sweep, grid, position);
        row.time_step = row.searched;
        row.result.largest_stable_step = searched_value(sweep, grid, at);
        row.result.note = position > 0 && !panel.is_implicit ? "1e9 times the energy & more" : "";
        line.probes.push_back(row);
      }
      panel.lines.push_back(line);
    }
  return panels;
}

TEST(Map, IsWellFormedAndShowsEveryPanelItsBoundariesAndTheLimit) {
  AtlasOptions options;
  for (const Sweep& sweep : sweep_table()) {
    if (sweep.searched.value != &Scene::time_step) continue;
    const auto panels = drawn_panels(sweep, options.grid);
    const std::string svg = map_svg(sweep, options, panels);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg.c_str())) << svg;
    const pugi::xml_node root = document.child("svg");
    EXPECT_STREQ(root.child("title").text().get(), sweep.title.c_str());
    EXPECT_EQ(document.select_nodes("//polygon").size(), 3U * 4 - 4 + 4);  // 4 halves a panel; one or two stretches
    for (const pugi::xpath_node node : document.select_nodes("//polygon"))
      EXPECT_THAT(node.node().child("title").text().get(), HasSubstr("time_step"));
    EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; &quot;c&quot;"));
    EXPECT_THAT(svg, HasSubstr("leapfrog"));
    EXPECT_THAT(svg, HasSubstr("url(#diverged)"));
    EXPECT_EQ(svg.find("nan"), svg.npos);
    EXPECT_EQ(svg.find("inf"), svg.npos);
    // The dashed limit lies on the boundary that the panels were given: y of the first line in the panel's height.
    EXPECT_NEAR(limit_share(sweep, panels[1].lines[0]), 0.3, 1e-6);
  }
}

TEST(Page, SaysWhatTheLinesSay) {
  const LineGrid grid;
  const Sweep sweep = sweep_by_name("contrast");
  const auto panels = drawn_panels(sweep, grid);
  EXPECT_EQ(statement(sweep, grid, panels[0]), "Nowhere diverged. Accurate everywhere on 3 of 3 lines.");
  EXPECT_THAT(statement(sweep, grid, panels[1]), HasSubstr("which is 1 of 2/ω_max"));
  AtlasOptions options;
  const std::string html = page_html({{sweep, panels}}, options);
  pugi::xml_document document;
  const std::string body = html.substr(html.find("<html"));
  ASSERT_TRUE(document.load_string(body.c_str()));
  EXPECT_EQ(document.select_nodes("//table/tr").size(), 3U);
}

}  // namespace
}  // namespace argil::atlas
