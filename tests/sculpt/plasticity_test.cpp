// Plastic flow as a session sees it: bars and twists whose answers are known, what is hashed, undone, refused.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <tbb/global_control.h>

#include <cmath>

#include "sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

/// A bar along x, 0.4 m long, of E = 1e5 and ν = 0.3, in uniaxial strain or stress as it is deformed.
const std::vector<std::string> k_bar{"new box 4 1 1 size 0.4 0.1 0.1",
                                     "select edges angle 30",
                                     "sharpen",
                                     "select vertices where valence = 3",
                                     "sharpen",
                                     "levels 1",
                                     "set young_modulus 1e5"};
constexpr double k_mu = 1e5 / 2.6;

/// Isochoric stretch along x: logarithmic strain (ε, −ε/2, −ε/2), von Mises stress 3 μ ε.
Eigen::Matrix3d stretched(double strain) {
  return Eigen::Vector3d(std::exp(strain), std::exp(-0.5 * strain), std::exp(-0.5 * strain)).asDiagonal();
}

/// The body held in that shape by pins while it flows.
struct Held : TestSession {
  Held(double strain, const std::string& plasticity, const std::vector<std::string>& more = {})
      : TestSession(k_bar) {
    run({plasticity});
    run(more);
    deform(stretched(strain));
    run({"pin where 1 > 0"});
  }
};

double stress(TestSession& test) {
  return test.measure("stress_mean");
}

TEST(Plasticity, NothingFlowsBelowTheYieldStress) {
  Held test(0.01, "plasticity yield 3000");  // the bar has 1154 Pa
  test.run({"step 20"});
  EXPECT_EQ(test.state().flow, nullptr);
  EXPECT_EQ(test.measure("max_plastic_strain"), 0);
}

TEST(Plasticity, AtOnceTheStressFallsToTheYieldStress) {
  for (const char* model : {"corotational", "stable_neo_hookean", "neo_hookean", "st_venant_kirchhoff"}) {
    SCOPED_TRACE(model);
    Held test(0.2, "plasticity yield 2000", {fmt::format("model {}", model)});
    test.run({"step 1"});
    // What is left is yield / 3 μ = 1.7 % of elastic strain; laws differ from Hencky's in its square.
    const double elastic = 2000 / (3 * k_mu);
    EXPECT_NEAR(test.measure("max_plastic_strain"), 0.2 - elastic, 1e-12);
    EXPECT_NEAR(stress(test), 2000, 2000 * 2 * elastic);
    const double once = test.measure("max_plastic_strain");
    test.run({"step 30"});
    EXPECT_NEAR(test.measure("max_plastic_strain"), once, 1e-12) << "it stays at yield";
  }
}

TEST(Plasticity, AReleasedBarKeepsWhatFlowed) {
  Held test(0.2, "plasticity yield 2000");
  test.run({"step 1", "pin off where x > 0.001 or y > 0.001 or z > 0.001", "pin off where 1 > 0", "set damping 50",
            "step 300"});
  const double plastic = 0.2 - 2000 / (3 * k_mu);
  const double length = test.measure("position_x at 0.4 0.05 0.05") - test.measure("position_x at 0 0.05 0.05");
  // At rest without load F_e = 1: the stretch is that of the flow.
  EXPECT_NEAR(length, 0.4 * std::exp(plastic), 1e-6);
  EXPECT_NEAR(test.measure("volume"), 0.004, 1e-9);
  EXPECT_LT(test.measure("elastic_energy"), 1e-9);
}

TEST(Plasticity, AMaxwellBodyRelaxesWithItsTimeAtAnyStep) {
  for (const double step : {0.01, 0.05, 0.1}) {
    SCOPED_TRACE(step);
    Held test(0.05, "plasticity creep 0.25");
    for (double time = step; time < 0.501; time += step) {
      test.run({fmt::format("step 1 dt {}", step)});
      // ε_e = ε exp(−t/τ), exactly, however long the steps are.
      EXPECT_NEAR(0.05 - test.measure("max_plastic_strain"), 0.05 * std::exp(-time / 0.25), 1e-13);
    }
  }
}

TEST(Plasticity, ABinghamBodyRelaxesToItsYieldStress) {
  Held test(0.05, "plasticity yield 1000 creep 0.1");
  const double yield = 1000 / (3 * k_mu);
  test.run({"step 30 dt 0.01"});
  EXPECT_NEAR(0.05 - test.measure("max_plastic_strain"), yield + (0.05 - yield) * std::exp(-3.0), 1e-13);
}

TEST(Plasticity, ATwistThatFlowedKeepsItsVolumeAndItsTurn) {
  TestSession test({"new box 2 2 6 size 0.1 0.1 0.3", "levels 1", "set young_modulus 1e5", "set damping 30",
                    "plasticity yield 1000"});
  const double volume = test.measure("volume");
  State next = test.state();
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  for (Eigen::Index i = 0; i < motion->positions.cols(); ++i) {
    const Eigen::Vector3d x = motion->positions.col(i) - Eigen::Vector3d(0.05, 0.05, 0);
    motion->positions.col(i) =
        Eigen::AngleAxisd(0.5 * M_PI * x.z() / 0.3, Eigen::Vector3d::UnitZ()) * x + Eigen::Vector3d(0.05, 0.05, 0);
  }
  next.motion = motion;
  test.document().assign(std::move(next));
  test.run({"pin where 1 > 0", "step 1", "pin off where 1 > 0", "step 200"});
  EXPECT_LT(test.measure("max_speed"), 1e-4);
  EXPECT_NEAR(test.measure("volume"), volume, 0.002 * volume);
  const auto angle = [&](double z) {
    return std::atan2(test.measure(fmt::format("position_y at 0.08 0.05 {}", z)) - 0.05,
                      test.measure(fmt::format("position_x at 0.08 0.05 {}", z)) - 0.05);
  };
  const double turn = angle(0.25) - angle(0.05);
  EXPECT_GT(turn, 0.7 * M_PI / 3) << "of the 60 degrees between these heights";
  EXPECT_LT(turn, M_PI / 3);
}

TEST(Plasticity, EnergyOnlyFalls) {
  Held test(0.1, "plasticity yield 1000 creep 0.05");
  double last = test.measure("elastic_energy");
  for (int i = 0; i < 20; ++i) {
    test.run({"step 1 dt 0.01"});
    const double now = test.measure("elastic_energy");
    EXPECT_LE(now, last);
    last = now;
  }
}

TEST(Plasticity, ResultsAreOfFirstOrderInTheStep) {
  // A bar that hangs from its upper end and flows under its weight; the answer of a step is compared with that of
  // half of it: the differences halve.
  const auto length = [](int steps) {
    TestSession test({"new box 1 1 4 size 0.1 0.1 0.4", "select edges angle 30", "sharpen",
                      "select vertices where valence = 3", "sharpen", "levels 1", "set young_modulus 1e5",
                      "set damping 30", "pin where z > 0.39", "plasticity creep 0.5", "gravity 0 0 -9.81",
                      "integrator implicit_euler newton 20 tolerance 1e-9",
                      fmt::format("step {} dt {}", steps, 0.2 / steps)});
    return test.measure("position_z at 0.05 0.05 0");
  };
  const double coarse = length(10), middle = length(20), fine = length(40);
  const double ratio = (coarse - middle) / (middle - fine);
  EXPECT_GT(ratio, 1.6);
  EXPECT_LT(ratio, 2.5);
}

TEST(Plasticity, CommitMakesTheFlowedShapeTheRestShape) {
  Held test(0.2, "plasticity yield 2000");
  test.run({"step 1", "commit"});
  EXPECT_EQ(test.state().flow, nullptr);
  EXPECT_TRUE(test.state().plasticity.on);
  EXPECT_NEAR(test.measure("elastic_energy"), 0, 1e-15);
  EXPECT_NEAR(test.measure("max_displacement"), 0, 1e-15);
}

TEST(Plasticity, HashIsThatOfTheStateAtAnyNumberOfThreadsAndAfterUndo) {
  std::uint64_t hash[2];
  for (const std::size_t threads : {1U, 2U}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Held test(0.1, "plasticity yield 1000 creep 0.05");
    test.run({"step 5"});
    hash[threads - 1] = test.hash();
  }
  EXPECT_EQ(hash[0], hash[1]);

  TestSession test(k_bar);
  const std::uint64_t elastic = test.hash();
  test.run({"plasticity yield 1000 creep 0.05"});
  EXPECT_NE(test.hash(), elastic);
  test.run({"pin where x < 0.01", "gravity 0 0 -9.81", "step 20"});
  const std::uint64_t flowed = test.hash();
  ASSERT_NE(test.state().flow, nullptr);
  test.run({"step 20"});
  const std::uint64_t further = test.hash();
  test.run({"undo"});
  EXPECT_EQ(test.hash(), flowed);
  test.run({"step 20"});
  EXPECT_EQ(test.hash(), further) << "the same steps after undo";
  test.run({"undo", "undo", "redo", "step 20"});
  EXPECT_EQ(test.hash(), further) << "and after redo";
  test.run({"undo 5"});
  EXPECT_EQ(test.hash(), elastic);
}

TEST(Plasticity, WhatIsNoLongerTheBodyThatFlowedForgetsItAndSaysSo) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& text) { printed += text + "\n"; };
  TestSession test(k_bar, options);
  test.run({"plasticity yield 500", "pin where x < 0.01", "gravity 0 0 -9.81", "step 20"});
  ASSERT_NE(test.state().flow, nullptr);
  test.run({"set density 1200 where x > 0.2", "set young_modulus 2e5 where x > 0.2"});
  EXPECT_NE(test.state().flow, nullptr) << "fields leave it";
  test.run({"step 2"});
  test.run({"levels 2"});
  EXPECT_EQ(test.state().flow, nullptr);
  EXPECT_THAT(printed, HasSubstr("forgets its flow"));
  test.run({"undo"});
  EXPECT_NE(test.state().flow, nullptr);
  test.run({"extrude 0.1 where x > 0.39"});
  EXPECT_EQ(test.state().flow, nullptr);
  test.run({"step 2"});
}

TEST(Plasticity, MisuseIsRefusedWithARemedy) {
  TestSession test(k_bar);
  EXPECT_THAT(test.fault_of("plasticity").what(), HasSubstr("yield"));
  EXPECT_THAT(test.fault_of("plasticity yield -1").what(), HasSubstr("yield"));
  EXPECT_THAT(test.fault_of("plasticity yield 0 creep 0").what(), HasSubstr("above 0"));
  EXPECT_THAT(test.fault_of("plasticity off yield 1").what(), HasSubstr("leave out"));
  for (const fem::ModelKind& kind : fem::model_table()) {
    if (kind.can_flow) continue;
    SCOPED_TRACE(kind.name);
    TestSession other(k_bar);
    other.run({fmt::format("model {}", kind.name)});
    EXPECT_THAT(other.fault_of("plasticity yield 1000").what(), HasSubstr("corotational"));
    other.run({"model corotational", "plasticity yield 1000"});
    EXPECT_THAT(other.fault_of(fmt::format("model {}", kind.name)).what(), HasSubstr("plasticity off"));
  }
}

}  // namespace
}  // namespace argil::sculpt
