// Pressure that follows the surface and prestress that comes and goes, by keys: against what a box under uniform
// stress does, whose corners stay where a homogeneous stretch takes them.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/document_loads.h"
#include "tests/sculpt/sessions.h"
#include "tests/sculpt/sharp_box.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

constexpr double k_young = 1e5, k_poisson = 0.3,
                 k_bulk = k_young / (1 - 2 * k_poisson);  // stress a stretch, all round

std::vector<std::string> box(const std::vector<std::string>& more) {
  std::vector<std::string> lines =
      sharp_box("2 2 2 size 0.1 0.1 0.1", {"set poisson_ratio 0.3", "set density 1000"});
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

/// Stretch less 1 of a box under pressure on the area of the moment, by the corotational law: K e = −p (1 + e)².
double stretch_under(double pressure) {
  double e = 0;
  for (int i = 0; i < 200; ++i) e = -pressure / k_bulk * (1 + e) * (1 + e);
  return e;
}
/// Under a prestress S the stress (1 + e) S + K e of the box that is free vanishes.
double stretch_by_prestress(double prestress) {
  return -prestress / (k_bulk + prestress);
}

double volume(double stretch) {
  return 1e-3 * std::pow(1 + stretch, 3);
}

TEST(Pressure, OnTheEndOfAPinnedBarShortensItAsHookeSays) {
  for (const double pressure : {2000.0, -2000.0, 20000.0}) {
    SCOPED_TRACE(pressure);
    TestSession test(box({"set poisson_ratio 0", "pin where z < 0.001",
                          fmt::format("pressure {} where z > 0.0999", pressure), "solve"}));
    // Without lateral strain the area stays, and E e = −p.
    EXPECT_NEAR(test.measure("displacement_z at 0.05 0.05 0.1"), -0.1 * pressure / k_young, 1e-8);
    EXPECT_NEAR(test.measure("reaction_z"), pressure * 0.01, 1e-6);
  }
}

// A pressure that pulls a bar bent by gravity follows its end: what is found must be an equilibrium with the
// surface as it is there, which another `solve` leaves alone and time does too.
TEST(Pressure, IsSolvedForWhereTheSurfaceComesToLie) {
  TestSession test({"new box 6 1 1 size 0.6 0.1 0.1", "levels 1", "set young_modulus 1e6", "pin where x < 0.001",
                    "gravity 0 0 -4", "pressure 500 where z > 0.0999", "solve"});
  const double z = test.measure("displacement_z at 0.59 0.05 0.05");
  EXPECT_LT(z, -0.1) << "it bends far";
  test.run({"solve"});
  EXPECT_NEAR(test.measure("displacement_z at 0.59 0.05 0.05"), z, 1e-8);
  test.run({"set damping 30", "step 120"});
  EXPECT_NEAR(test.measure("displacement_z at 0.59 0.05 0.05"), z, 1e-4);
}

TEST(Pressure, KeyedSlowlyFindsTheEquilibriumOfEveryInstant) {
  TestSession test(box({"integrator implicit_euler newton 20 tolerance 1e-9", "pressure 0 as squeeze where 1 > 0",
                        "key pressure squeeze course 0 0 2 10000 4 -5000 interpolation linear"}));
  for (int i = 0; i < 20; ++i) {
    test.run({"step 10 dt 0.02"});
    const double time = test.measure("time");
    const double pressure = time < 2 ? 5000 * time : 10000 - 7500 * (time - 2);
    // The box swings within 0.01 s: what remains of inertia is of the order of (0.01 / 2)².
    EXPECT_NEAR(test.measure("volume"), volume(stretch_under(pressure)), 1e-3 * 1e-4) << time;
  }
  for (const StepRecord& step : test->steps()) EXPECT_EQ(step.finding, fem::GuardFinding::none);
}

class KeyedPressure : public testing::TestWithParam<const char*> {};

TEST_P(KeyedPressure, OfAClosedSurfaceMovesABodyNowhere) {
  TestSession test(box({fmt::format("integrator {}", GetParam()), "set young_modulus 2e3",
                        "pressure 0 as squeeze where 1 > 0", "key pressure squeeze course 0 0 0.1 100 0.2 -100"}));
  for (int i = 0; i < 50; ++i) {
    test.run({"step 1 dt 0.002"});
    for (const char* axis : {"x", "y", "z"}) {
      // ∮ n dA = 0 and ∮ x × n dA = 0 on any surface; of semi_implicit to its one linear solve.
      ASSERT_NEAR(test.measure(fmt::format("momentum_{}", axis)), 0, 1e-7) << i;
      ASSERT_NEAR(test.measure(fmt::format("angular_momentum_{}", axis)), 0, 1e-8) << i;
    }
  }
  EXPECT_GT(std::abs(test.measure("volume") - 1e-3), 1e-6) << "something happened";
}

TEST_P(KeyedPressure, OnOneSideGivesTheImpulseOfItsArea) {
  TestSession test(box({fmt::format("integrator {}", GetParam()), "set young_modulus 2e3",
                        "pressure 0.02 as push where z > 0.0999", "key pressure push course 0 0.02 1 0.02"}));
  test.run({"step 50 dt 0.002"});
  // The area changes by the strain, 1e-5. BDF2's first step is one of Euler's method: the momentum of a steady
  // force is exact all the same.
  EXPECT_NEAR(test.measure("momentum_z"), -0.02 * 0.01 * 0.1, 1e-3 * 2e-5);
  EXPECT_NEAR(test.measure("momentum_x"), 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Methods, KeyedPressure,
                         testing::Values("bdf2 newton 30 tolerance 1e-12",
                                         "implicit_euler newton 30 tolerance 1e-12", "semi_implicit",
                                         "generalised_alpha newton 30 tolerance 1e-12", "central_difference",
                                         "forward_euler", "symplectic_euler", "velocity_verlet", "midpoint"),
                         [](const auto& test) {
                           const std::string name = test.param;
                           return name.substr(0, name.find(' '));
                         });

TEST(Pressure, DoesTheWorkOfItsChangeOfVolume) {
  TestSession test(box({"integrator velocity_verlet", "pressure 0 as squeeze where 1 > 0",
                        "key pressure squeeze course 0 0 0.05 4000 0.1 1000"}));
  double work = 0, last = test.measure("volume");
  const Track track = test.state().loads->pressures.at(0).track;
  for (int i = 0; i < 500; ++i) {
    test.run({"step 1 dt 0.0002"});
    const double now = test.measure("volume");
    work -= value_at(track, (i + 0.5) * 0.0002)[0] * (now - last);
    last = now;
  }
  const double energy = test.measure("energy");
  EXPECT_GT(energy, 1e-3);
  EXPECT_NEAR(energy, work, 0.01 * energy);  // of second order in the step, but for the surface drawn on
}

TEST(Pressure, FollowsASurfaceThatTurns) {
  TestSession test(box({"pressure 100 where z > 0.0999"}));
  Eigen::Matrix3d turn;
  turn << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // z to x
  test.deform(turn);
  const Eigen::Vector3d force = test.document().loads().forces.rowwise().sum();
  EXPECT_NEAR(force.x(), -1, 1e-12);
  EXPECT_NEAR(force.y(), 0, 1e-12);
  EXPECT_NEAR(force.z(), 0, 1e-12);
}

TEST(Prestress, KeyedIsTheShareOfTheFieldThatActs) {
  TestSession test(box({"integrator implicit_euler newton 20 tolerance 1e-9", "set prestress 20000",
                        "key prestress course 0 0 2 1 interpolation linear"}));
  for (int i = 0; i < 12; ++i) {
    test.run({"step 10 dt 0.02"});
    const double share = std::min(1.0, test.measure("time") / 2);
    EXPECT_NEAR(test.measure("volume"), volume(stretch_by_prestress(share * 20000)), 1e-3 * 1e-4) << share;
  }
  test.run({"solve"});
  EXPECT_NEAR(test.measure("volume"), volume(stretch_by_prestress(20000)), 1e-8 * 1e-3);
  // What the model shows as stress is with the share too: none in a free body.
  EXPECT_NEAR(test.measure("pressure_max"), 0, 1);
}

class KeyedPrestress : public testing::TestWithParam<const char*> {};

TEST_P(KeyedPrestress, IsInnerForceUnderEveryIntegrator) {
  TestSession test(box({fmt::format("integrator {}", GetParam()), "set young_modulus 2e3", "set prestress 200",
                        "key prestress course 0 0 0.1 1 0.2 0"}));
  for (int i = 0; i < 50; ++i) test.run({"step 1 dt 0.002"});
  for (const char* axis : {"x", "y", "z"}) {
    EXPECT_NEAR(test.measure(fmt::format("momentum_{}", axis)), 0, 1e-7);
    EXPECT_NEAR(test.measure(fmt::format("angular_momentum_{}", axis)), 0, 1e-8);
  }
  EXPECT_LT(test.measure("volume"), 0.97e-3);
  if (std::string_view(GetParam()) == "forward_euler") return;  // gains energy at any step, and the guard says so
  for (const StepRecord& step : test->steps()) EXPECT_EQ(step.finding, fem::GuardFinding::none);
}
INSTANTIATE_TEST_SUITE_P(Methods, KeyedPrestress,
                         testing::Values("bdf2 newton 30 tolerance 1e-12",
                                         "implicit_euler newton 30 tolerance 1e-12", "semi_implicit",
                                         "generalised_alpha newton 30 tolerance 1e-12", "central_difference",
                                         "forward_euler", "symplectic_euler", "velocity_verlet", "midpoint"),
                         [](const auto& test) {
                           const std::string name = test.param;
                           return name.substr(0, name.find(' '));
                         });

TEST(Pressure, AndPrestressAreHashedUndoneAndTheSameBitsAgain) {
  const std::vector<std::string> lines =
      box({"pressure 500 as bag where z > 0.0999", "set prestress 1000", "plasticity yield 500"});
  TestSession plain(lines), keyed(lines);
  EXPECT_EQ(plain.hash(), keyed.hash());
  const std::uint64_t before = keyed.hash();
  keyed.run({"key pressure bag amount 2000 at 0.2"});
  EXPECT_NE(keyed.hash(), before);
  const std::uint64_t one = keyed.hash();
  keyed.run({"key prestress amount 0.2 at 0.1"});
  EXPECT_NE(keyed.hash(), one);
  keyed.run({"step 8 dt 0.02"});
  const std::uint64_t moved = keyed.hash();
  keyed.run({"undo", "step 8 dt 0.02"});
  EXPECT_EQ(keyed.hash(), moved) << "the preconditioner must not remember the share";
  keyed.run({"undo 3"});
  EXPECT_EQ(keyed.hash(), before);
  TestSession again(lines);
  again.run({"key pressure bag amount 2000 at 0.2", "key prestress amount 0.2 at 0.1", "step 8 dt 0.02"});
  EXPECT_EQ(again.hash(), moved);
}

TEST(Pressure, KeysAreListedAndTakenAway) {
  std::vector<std::string> said;
  SessionOptions options;
  options.print = [&](const std::string& line) { said.push_back(line); };
  TestSession test(box({"pressure 0 as bag where 1 > 0", "key pressure bag course 0 0 1 500", "set prestress 100",
                        "key prestress course 0 1 1 0.5", "step 1 dt 1", "keys"}),
                   options);
  const std::string all = fmt::format("{}", fmt::join(said, "\n"));
  EXPECT_THAT(all, HasSubstr("pressure bag [Pa], smooth:\n  0 s: 0\n  1 s: 500"));
  EXPECT_THAT(all, HasSubstr("prestress, the share that acts, smooth:\n  0 s: 1\n  1 s: 0.5"));
  test.run({"key pressure bag remove", "key prestress remove"});
  EXPECT_EQ(test.state().loads->pressures.at(0).pressure, 500) << "it stays what it is now";
  EXPECT_EQ((*test.state().fields)[FieldName::prestress].maxCoeff(), 50);
  test.run({"pressure clear as bag"});
  EXPECT_TRUE(test.state().loads->pressures.empty());
}

TEST(Pressure, SaysWhatIsWrong) {
  TestSession test(box({"pressure 5 as bag where z > 0.0999"}));
  EXPECT_THAT(test.fault_of("key pressure sack amount 5 at 1").what(), HasSubstr("no pressure named 'sack'"));
  EXPECT_THAT(test.fault_of("key pressure bag path 0 0 0 0").what(), HasSubstr("one number"));
  EXPECT_THAT(test.fault_of("key gravity amount 5 at 1").what(), HasSubstr("three components"));
  EXPECT_THAT(test.fault_of("key pressure bag at 1 to 2").what(), HasSubstr("has no keys"));
  EXPECT_THAT(test.fault_of("key prestress arm amount 5 at 1").what(), HasSubstr("no name"));
  EXPECT_THAT(test.fault_of("key pressure bag course -1 5").what(), HasSubstr("time begins at 0 s"));
  EXPECT_THAT(test.fault_of("pressure as bag where z > 0.0999").what(), HasSubstr("wants its size"));
  EXPECT_THAT(test.fault_of("pressure clear as sack").what(), HasSubstr("no pressure named 'sack'"));
}

TEST(Pressure, FollowsItsFacesThroughEdits) {
  TestSession test({"new box 2 1 1 size 0.2 0.1 0.1", "levels 1", "pressure 5 as bag where x > 0.199",
                    "pressure 7 as lost where x < 0.001", "select faces where x > 0.199", "extrude 0.1"});
  for (const AppliedPressure& pressure : test.state().loads->pressures)
    for (const std::uint32_t face : pressure.faces)
      EXPECT_TRUE(test.document().solid().is_boundary(subdiv::FaceId{face}));
  test.run({"step"});  // whatever became of them, the document holds together
}

}  // namespace
}  // namespace argil::sculpt
