// Obstacles as a session sees them: bodies come to rest on them, slide, are pushed; what is refused, hashed,
// undone.

#include "sculpt/obstacles.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "sculpt/document_loads.h"
#include "sculpt/picture.h"
#include "sessions.h"
#include "sharp_box.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

constexpr double k_mass = 4, k_gravity = 9.81;

TEST(SessionObstacles, ABodyComesToRestOnAPlaneThatCarriesItsWeight) {
  TestSession test(
      heavy_block({"obstacle floor plane friction 0.5", "gravity 0 0 -9.81", "set damping 20", "step 240"}));
  EXPECT_NEAR(test.measure("contact_force_z"), k_mass * k_gravity, 1e-6);
  EXPECT_NEAR(test.measure("contact_force_x"), 0, 1e-6);
  EXPECT_LT(test.measure("max_speed"), 1e-7) << "jitter";
  // By the rule the mean depth is the weight's pressure over 10 E / w, w = 0.05 m; corners carry more.
  const double mean = k_mass * k_gravity / 0.04 / (10 * 1e5 / 0.05);
  const double depth = test.measure("contact_depth");
  EXPECT_GT(depth, 0.5 * mean);
  EXPECT_LT(depth, 4 * mean);
  EXPECT_LT(depth, 0.005 * 0.1) << "it would sink visibly";
  for (const StepRecord& step : test->steps()) EXPECT_EQ(step.remedy, fem::GuardRemedy::none);
  // The static solver finds the same place.
  const double before = test.measure("position_z at 0.1 0.1 0.1");
  test.run({"solve"});
  EXPECT_NEAR(test.measure("position_z at 0.1 0.1 0.1"), before, 1e-8);
  EXPECT_NEAR(test.measure("contact_force_z"), k_mass * k_gravity, 1e-6);
}

/// Gravity as on a slope of that tangent, the plane staying level.
std::string gravity_on_slope(double tangent) {
  const double angle = std::atan(tangent);
  return fmt::format("gravity {} 0 {}", k_gravity * std::sin(angle), -k_gravity * std::cos(angle));
}

TEST(SessionObstacles, BelowTheAngleOfFrictionABlockSticksAndDoesNotCreep) {
  TestSession test(
      heavy_block({"obstacle slope plane friction 0.6", gravity_on_slope(0.5), "set damping 20", "step 240"}));
  const double before = test.measure("position_x at 0.1 0.1 0");
  EXPECT_LT(std::abs(before - 0.1), 1e-3) << "until friction had taken up the load";
  test.run({"step 300"});
  EXPECT_NEAR(test.measure("position_x at 0.1 0.1 0"), before, 1e-9) << "creep in 5 s";
  const double angle = std::atan(0.5);
  EXPECT_NEAR(test.measure("contact_force_x"), -k_mass * k_gravity * std::sin(angle), 1e-6);
  EXPECT_NEAR(test.measure("contact_force_z"), k_mass * k_gravity * std::cos(angle), 1e-6);
}

TEST(SessionObstacles, AboveItTheBlockSlidesWithGravityLessFriction) {
  TestSession test(heavy_block({"obstacle slope plane friction 0.3", gravity_on_slope(0.5), "step 60"}));
  const double first = test.measure("momentum_x"), begin = test.measure("time");
  test.run({"step 60"});
  const double found = (test.measure("momentum_x") - first) / k_mass / (test.measure("time") - begin);
  const double angle = std::atan(0.5), expected = k_gravity * (std::sin(angle) - 0.3 * std::cos(angle));
  EXPECT_NEAR(found, expected, 1e-3 * expected);  // it still swings a little after its landing
  // No force beyond the cone at any moment.
  EXPECT_NEAR(-test.measure("contact_force_x") / test.measure("contact_force_z"), 0.3, 1e-6);
}

TEST(SessionObstacles, EnergyNeverGrowsInADrop) {
  for (const char* integrator : {"implicit_euler newton 20 tolerance 1e-8", "bdf2 newton 20 tolerance 1e-8"}) {
    SCOPED_TRACE(integrator);
    TestSession test(heavy_block({"obstacle floor plane at 0 0 -0.05 friction 0.4", "gravity 1 0 -9.81",
                                  fmt::format("integrator {}", integrator)}));
    const bool bdf2 = std::string_view(integrator).starts_with("bdf2");
    double last = 0, lowest = 0;
    for (int i = 0; i < 60; ++i) {
      test.run({"step 1 dt 1/120"});
      // What contact stores counts: a point at depth d holds ½ k a d².
      const auto contact = contact_at(test.document(), test.state().motion->time);
      fem::ContactStep step(*contact, *test.state().motion, test.state().motion->time);
      step.set_state(test.document().positions());
      double stored = 0;
      for (const fem::Touch& t : step.touches())
        stored += 0.5 * t.stiffness * (t.depth * t.depth + t.stretch.squaredNorm());
      const double total = test.measure("energy") + test.measure("load_energy") + stored;
      // 2 J are at stake. BDF2 remembers the velocities of before the impact and gives back some per cent of what
      // it had taken too much.
      EXPECT_LE(total, last + (bdf2 ? 0.04 : 1e-9)) << "step " << i;
      last = total;
      lowest = std::min(lowest, test.measure("position_z at 0.1 0.1 0"));
    }
    EXPECT_LT(last, -1.5) << "it lies";
    EXPECT_LT(lowest, -0.05);
    EXPECT_GT(lowest, -0.06);
  }
}

TEST(SessionObstacles, WhatAMovingObstacleGivesIsWhatTheBodyGains) {
  TestSession test(heavy_block());
  Document& document = test.document();
  auto contact = std::make_shared<fem::Contact>();
  contact->surface = document.contact_surface();
  fem::Obstacle ram{.id = 1, .shape = fem::ObstacleShape::box, .size = {0.1, 0.2, 0.2}};
  ram.position = {-0.11, 0.1, 0.05};
  ram.velocity = {1, 0, 0};
  ram.friction = 0.5;
  contact->obstacles = {ram};
  fem::Loads loads = document.loads();
  loads.contact = contact;
  fem::BodyState state = *document.state().motion;
  fem::StepOptions options;
  options.method = fem::Method::implicit_euler;
  options.newton_cap = 50;
  options.newton_tolerance = 1e-10;
  constexpr double k_step = 0.002;
  const fem::System system = document.system();
  double impulse = 0;
  for (int i = 0; i < 100; ++i) {
    (void)document.integrator().step(loads, state, k_step, options);
    impulse += k_step * fem::contact_wrench(*contact, state).force.x();
    ASSERT_NEAR(fem::momentum(system, state).linear.x(), impulse, 1e-6 * (1 + impulse)) << "step " << i;
  }
  // It runs ahead of the ram: implicit Euler takes the rebound's energy, but never all of it.
  const double velocity = impulse / k_mass;
  EXPECT_GT(velocity, 0.99);
  EXPECT_LT(velocity, 2.0);
}

TEST(SessionObstacles, AMovingPlaneCarriesWhatRestsOnIt) {
  TestSession test(
      heavy_block({"obstacle floor plane friction 0.8", "gravity 0 0 -9.81", "set damping 5", "step 120"}));
  Document& document = test.document();
  fem::BodyState state = *document.state().motion;
  fem::Obstacle floor = moving_obstacles(test.state(), state.time)[0];
  auto contact = std::make_shared<fem::Contact>();
  contact->surface = document.contact_surface();
  floor.velocity = {0.2, 0, 0};
  contact->obstacles = {floor};
  fem::Loads loads = document.loads();
  loads.contact = contact;
  const double from = fem::position(material_point(document, {0.1, 0.1, 0}).stencil, state.positions).x();
  for (int i = 0; i < 120; ++i) (void)document.integrator().step(loads, state, 1.0 / 60, {});
  const double to = fem::position(material_point(document, {0.1, 0.1, 0}).stencil, state.positions).x();
  // 2 s at 0.2 m/s, less what the field of damping (air, as it were) holds back: 20 N/(m/s) over the shear spring.
  EXPECT_NEAR(to - from, 0.4, 0.004);
}

TEST(SessionObstacles, EveryShapeCatchesABall) {
  for (const char* shape : {"plane at 0 0 -0.02 normal 0.1 0 1", "sphere at 0.1 0.1 -0.32 radius 0.3",
                            "box at 0.1 0.1 -0.1 size 1 1 0.15 axis 0 1 0 rotate 3",
                            "capsule from -1 0.1 -0.12 to 1 0.1 -0.12 radius 0.1"}) {
    SCOPED_TRACE(shape);
    TestSession test({"new box 2 2 2 size 0.2 0.2 0.2", "levels 1", "set damping 2",
                      fmt::format("obstacle thing {} friction 5", shape), "gravity 0 0 -9.81", "step 90"});
    const double depth = test.measure("contact_depth");
    EXPECT_GT(depth, 0);
    EXPECT_LT(depth, 0.005);
    EXPECT_GT(test.measure("contact_force_z"), 0);
  }
}

TEST(SessionObstacles, EveryIntegratorTakesThemOrSaysWhyNot) {
  for (const fem::MethodKind& kind : fem::method_table()) {
    SCOPED_TRACE(kind.name);
    TestSession test(heavy_block({"obstacle floor plane friction 0.5", "gravity 0 0 -9.81", "set damping 20",
                                  fmt::format("integrator {}", kind.name)}));
    if (kind.of_published_method) {
      EXPECT_THAT(test.fault_of("step 1").what(), HasSubstr("obstacles"));
      continue;
    }
    // Explicit ones want steps below 2 over the highest frequency, which the contact raises.
    const double step = kind.is_implicit ? 1.0 / 120 : 1e-4;
    test.run({fmt::format("step {} dt {}", kind.is_implicit ? 60 : 1000, step)});
    EXPECT_NEAR(test.measure("contact_force_z"), k_mass * k_gravity, 0.7 * k_mass * k_gravity);
    EXPECT_LT(test.measure("contact_depth"), 0.002);
    EXPECT_GT(test.measure("position_z at 0.1 0.1 0.1"), 0.09);
  }
}

TEST(SessionObstacles, EveryForceModelTakesThem) {
  for (const fem::ModelKind& kind : fem::model_table()) {
    SCOPED_TRACE(kind.name);
    TestSession test(heavy_block({fmt::format("model {}", kind.name), "obstacle floor plane friction 0.5",
                                  "gravity 0 0 -9.81", "set damping 20", "step 30"}));
    EXPECT_LT(test.measure("contact_depth"), 0.002);
    EXPECT_GT(test.measure("contact_force_z"), 0.3 * k_mass * k_gravity);
  }
}

TEST(SessionObstacles, HashIsThatOfTheStateAtAnyNumberOfThreadsAndAfterUndo) {
  const auto lines = heavy_block({"obstacle floor plane at 0 0 -0.01 friction 0.5",
                                  "obstacle ball sphere at 0.1 0.1 -0.2 radius 0.21", "gravity 0.5 0 -9.81"});
  std::uint64_t hash[2];
  for (const std::size_t threads : {1U, 2U}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    TestSession test(lines);
    test.run({"step 30"});
    hash[threads - 1] = test.hash();
  }
  EXPECT_EQ(hash[0], hash[1]);

  TestSession test(heavy_block());
  const std::uint64_t without = test.hash();
  test.run({"obstacle floor plane friction 0.5"});
  const std::uint64_t with = test.hash();
  EXPECT_NE(with, without);
  test.run({"gravity 0.5 0 -9.81", "step 10"});
  const std::uint64_t stepped = test.hash();
  EXPECT_FALSE(test.state().motion->grips.empty());
  test.run({"step 10"});
  const std::uint64_t further = test.hash();
  test.run({"undo"});
  EXPECT_EQ(test.hash(), stepped);
  test.run({"step 10"});
  EXPECT_EQ(test.hash(), further) << "grips are part of the state";
  test.run({"obstacle floor remove"});
  EXPECT_TRUE(test.state().motion->grips.empty());
  test.run({"undo 5"});
  EXPECT_EQ(test.hash(), without);
  test.run({"redo"});
  EXPECT_EQ(test.hash(), with);
}

TEST(SessionObstacles, AnEditLetsGoOfWhatFrictionHoldsAndIsUndone) {
  for (const char* level : {"levels 0", "levels 1"}) {
    SCOPED_TRACE(level);
    TestSession test({"new box 2 2 1 size 0.2 0.2 0.1", level, "set density 1000",
                      "obstacle floor plane friction 0.5", "gravity 1 0 -9.81", "step 20"});
    ASSERT_FALSE(test.state().motion->grips.empty());
    const std::uint64_t before = test.hash();
    test.run({"extrude 0.1 where z > 0.09"});
    EXPECT_TRUE(test.state().motion->grips.empty());
    const std::uint64_t edited = test.hash();
    test.run({"undo"});
    EXPECT_EQ(test.hash(), before);
    test.run({"redo"});
    EXPECT_EQ(test.hash(), edited);
    test.run({"step 5", "undo 2", "step 5", "undo"});
    EXPECT_EQ(test.hash(), before);
    test.run({"commit"});
    EXPECT_FALSE(test.state().motion->grips.empty()) << "the body stays where it lies";
  }
}

TEST(SessionObstacles, ABoxCatchesWhatFallsHoweverThinItIs) {
  // Falling at 6 m/s through steps of 1/60 s: 0.1 m a step.
  const auto fall = [](double thickness) {
    TestSession test(
        heavy_block({fmt::format("obstacle shelf box at 0.1 0.1 {} size 1 1 {}", -0.5 - 0.5 * thickness, thickness),
                     "gravity 0 0 -40", "step 24"}));
    return test.measure("position_z at 0.1 0.1 0.1");
  };
  EXPECT_GT(fall(0.3), -0.5);
  EXPECT_GT(fall(0.02), -0.5);
  EXPECT_GT(fall(0.001), -0.5);
}

TEST(SessionObstacles, MisuseIsRefusedWithARemedy) {
  TestSession test(heavy_block());
  const std::uint64_t before = test.hash();
  const std::pair<const char*, const char*> cases[] = {
      {"obstacle a sphere at 0 0 0 radius -1", "radius"},
      {"obstacle a sphere at 0 0 0", "radius"},
      {"obstacle a sphere radius 1 normal 0 0 1", "normal"},
      {"obstacle a box size 1 0 1", "size"},
      {"obstacle a box size 1 1 1 rotate 20", "axis"},
      {"obstacle a box size 1 1 1 axis 0 0 0 rotate 20", "direction"},
      {"obstacle a capsule from 0 0 0 to 0 0 0 radius 1", "direction"},
      {"obstacle a capsule radius 1", "from"},
      {"obstacle a plane normal 0 0 0", "direction"},
      {"obstacle a plane friction -0.1", "friction"},
      {"obstacle a plane stiffness 0", "stiffness"},
      {"obstacle a cone", "plane"},
      {"obstacle a remove", "no obstacle"},
      {"obstacle a", "shape"},
      {"obstacle", "name"},
  };
  for (const auto& [line, word] : cases) EXPECT_THAT(test.fault_of(line).what(), HasSubstr(word)) << line;
  EXPECT_EQ(test.hash(), before);
  test.run({"obstacle floor plane"});
  EXPECT_THAT(test.fault_of("obstacle flor remove").what(), HasSubstr("floor"));
  EXPECT_THAT(test.fault_of("obstacle floor remove friction 1").what(), HasSubstr("leave"));
}

TEST(SessionObstacles, AreDrawnOutsideWhatIsPicked) {
  TestSession test(heavy_block({"obstacle floor plane", "obstacle ball sphere at 0.1 0.1 -0.2 radius 0.2",
                                "obstacle bar capsule from 0 0 -1 to 0.2 0 -1 radius 0.05",
                                "obstacle shelf box at 0 0 -2 size 1 1 0.1"}));
  const Scene scene = make_scene(test.document(), {});
  ASSERT_EQ(scene.obstacles.size(), 4U);
  EXPECT_TRUE(scene.obstacles[0].is_ground);
  const auto contact = contact_at(test.document(), 0);
  for (std::size_t o = 0; o < 4; ++o) {
    const fem::ObstaclePose pose = fem::pose_at(contact->obstacles[o], 0);
    const SceneSurface& surface = scene.obstacles[o].surface;
    for (const Eigen::Vector3f& x : surface.positions)
      EXPECT_NEAR(fem::signed_distance(contact->obstacles[o], pose.own(x.cast<double>())).distance, 0, 1e-6);
    // Faces look outwards.
    for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f) {
      const auto at = [&](std::size_t c) -> Eigen::Vector3d {
        return surface.positions[surface.corners[surface.offsets[f] + c]].cast<double>();
      };
      const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0));
      const Eigen::Vector3d middle = (at(0) + at(1) + at(2)) / 3;
      const Eigen::Vector3d out =
          pose.rotation * fem::signed_distance(contact->obstacles[o], pose.own(middle)).normal;
      EXPECT_GE(normal.dot(out), 0) << "obstacle " << o << " face " << f;
    }
  }
}

}  // namespace
}  // namespace argil::sculpt
