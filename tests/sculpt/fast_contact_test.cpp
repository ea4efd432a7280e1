// Bodies that are faster than a step can see, and obstacles put over a body.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/obstacles.h"
#include "sessions.h"
#include "sharp_box.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;
using testing::Not;

void throw_at(TestSession& test, const Eigen::Vector3d& velocity) {
  State next = test.state();
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  motion->velocities.colwise() = velocity;
  next.motion = motion;
  test.document().assign(std::move(next));
}

double middle(TestSession& test) {
  return test.measure("position_z at 0.1 0.1 0.05");
}

struct Throw {
  const char* obstacle;
  const char* integrator;
};
class FastBody : public testing::TestWithParam<Throw> {};

// The block starts 0.3 m or so above what is 0.01 m thick, or thin round; at 1/60 s a step takes it as much as 1.7
// m.
TEST_P(FastBody, DoesNotPassThroughWhatIsThin) {
  for (const double speed : {0.5, 2.0, 8.0, 30.0, 100.0}) {
    for (const double young : {1e5, 1e9}) {
      if (young < 1e6 && speed > 8) continue;  // faster than its own sound it would be crushed by any wall
      SCOPED_TRACE(fmt::format("{} m/s, E = {} Pa", speed, young));
      TestSession test(
          heavy_block({GetParam().obstacle, GetParam().integrator, fmt::format("set young_modulus {}", young)}));
      throw_at(test, {0, 0, -speed});
      const int steps = static_cast<int>(std::ceil(1.0 / speed * 60)) + 6;
      double lowest = 1;
      for (int i = 0; i < steps; ++i) {
        test.run({"step"});
        lowest = std::min(lowest, middle(test));
      }
      // A wall of its own width stops it at once. A ball meets a few points, which go as deep as it takes to stop
      // it.
      const bool wide = std::string_view(GetParam().obstacle).find("wall") != std::string_view::npos;
      if (wide) {
        EXPECT_GT(lowest, -0.35) << "the middle stays on its side of what is at −0.3 m";
      }
      EXPECT_GT(middle(test), -0.35) << "it is back on its side";
      EXPECT_GT(test.measure("momentum_z"), -0.05 * 4 * speed) << "it was stopped, or sent back";
      // Nothing is won: at most the energy that it came with. Generalised-α, which damps little, makes some where
      // the step is long for the stiffness of contact, with or without what is tested here.
      const bool ringing = std::string_view(GetParam().integrator).find("alpha") != std::string_view::npos;
      EXPECT_LT(test.measure("kinetic_energy"), (ringing ? 2 : 1.05) * 2 * speed * speed);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(
    Obstacles, FastBody,
    testing::Values(Throw{"obstacle wall box at 0.1 0.1 -0.305 size 1 1 0.01", "integrator bdf2"},
                    Throw{"obstacle wall box at 0.1 0.1 -0.305 size 1 1 0.01", "integrator implicit_euler"},
                    Throw{"obstacle wall box at 0.1 0.1 -0.305 size 1 1 0.01", "integrator generalised_alpha"},
                    Throw{"obstacle wall box at 0.1 0.1 -0.305 size 1 1 0.01 axis 1 0 0 rotate 5",
                          "integrator bdf2"},
                    Throw{"obstacle wall plane at 0 0 -0.3", "integrator bdf2"},
                    Throw{"obstacle wall plane at 0 0 -0.3", "integrator generalised_alpha"},
                    Throw{"obstacle ball sphere at 0.1 0.1 -0.35 radius 0.05", "integrator bdf2"},
                    Throw{"obstacle rod capsule from -0.5 0.1 -0.35 to 0.7 0.1 -0.35 radius 0.05 friction 0.3",
                          "integrator bdf2"}),
    [](const auto& test) { return fmt::format("Case{}", test.index); });

TEST(FastContact, SlowBodiesKeepNoEntries) {
  TestSession test(heavy_block({"obstacle wall box at 0.1 0.1 -0.1 size 1 1 0.1", "gravity 0 0 -9.81", "step 60"}));
  EXPECT_TRUE(test.state().motion->grips.empty());
}

TEST(FastContact, EntriesAreHashedAndUndone) {
  TestSession test(heavy_block({"obstacle wall box at 0.1 0.1 -0.305 size 1 1 0.01"}));
  throw_at(test, {0, 0, -30});
  test.run({"step"});
  ASSERT_FALSE(test.state().motion->grips.empty());
  const std::uint64_t one = test.hash();
  test.run({"step 4"});
  const std::uint64_t five = test.hash();
  test.run({"undo"});
  EXPECT_EQ(test.hash(), one);
  test.run({"step 4"});
  EXPECT_EQ(test.hash(), five);
}

struct Said {
  std::vector<std::string> lines;
  SessionOptions options() {
    SessionOptions result;
    result.print = [this](const std::string& line) { lines.push_back(line); };
    return result;
  }
  std::string all() const { return fmt::format("{}", fmt::join(lines, "\n")); }
};

TEST(Overlap, IsSaidAndPushesOutSlowly) {
  for (const char* obstacle : {"plane at 0 0 0.05", "plane at 0 0 0.05 friction 0.5",
                               "sphere at 0.1 0.1 -0.03 radius 0.05", "box at 0.1 0.1 -0.1 size 1 1 0.24"}) {
    SCOPED_TRACE(obstacle);
    Said said;
    TestSession test(heavy_block({fmt::format("obstacle floor {}", obstacle)}), said.options());
    EXPECT_THAT(said.all(), HasSubstr("the body is in floor already"));
    EXPECT_THAT(said.all(), HasSubstr("over the next 0.5 s"));
    double most = 0;
    for (int i = 0; i < 60; ++i) {
      test.run({"step"});
      most = std::max(most, test.measure("energy") + test.measure("contact_energy"));
    }
    // 0.05 m in 0.5 s: a body of 4 kg at that speed has 0.02 J, at twice it, as a wall that moves may give, 0.08 J,
    // and a little goes into its shape. The force of the depth would make 1000 J of it.
    EXPECT_LT(most, 0.12);
    test.run({"step 30"});
    EXPECT_LT(test.measure("contact_depth"), 0.001);
    for (const fem::ContactGrip& grip : test.state().motion->grips) EXPECT_EQ(grip.allowed, 0);
  }
}

TEST(Overlap, OfABodyUnderItsWeightEndsWithTheBodyOnTop) {
  TestSession test(heavy_block(
      {"gravity 0 0 -9.81", "set damping 20", "obstacle floor plane at 0 0 0.03 friction 0.4", "step 240"}));
  EXPECT_NEAR(test.measure("contact_force_z"), 4 * 9.81, 1e-3);
  EXPECT_NEAR(middle(test), 0.08, 0.003);
}

TEST(Overlap, OfWhatOnlyTouchesIsNotWorthANote) {
  Said said;
  TestSession test(heavy_block({"obstacle floor plane", "gravity 0 0 -9.81", "set damping 20", "step 60",
                                "obstacle floor plane friction 0.4", "step 1"}),
                   said.options());
  EXPECT_THAT(said.all(), Not(HasSubstr("already")));
  EXPECT_GT(test.measure("contact_force_z"), 30) << "it is carried all the time";
}

TEST(Overlap, IsHashedAndUndone) {
  TestSession test(heavy_block({"step 1"}));
  const std::uint64_t before = test.hash();
  test.run({"obstacle floor plane at 0 0 0.05", "step 5"});
  const std::uint64_t after = test.hash();
  test.run({"undo 2"});
  EXPECT_EQ(test.hash(), before);
  EXPECT_TRUE(test.state().motion->grips.empty());
  test.run({"redo 2"});
  EXPECT_EQ(test.hash(), after);
}

}  // namespace
}  // namespace argil::sculpt
