// Loads and pins over time, by what they do to bodies: momentum, places, equilibrium.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "sculpt/document_loads.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const std::vector<std::string> k_bar{"new box 4 1 1 size 0.4 0.1 0.1", "levels 1", "set young_modulus 2e3",
                                     "set density 500"};

std::vector<std::string> bar_and(std::vector<std::string> lines) {
  lines.insert(lines.begin(), k_bar.begin(), k_bar.end());
  return lines;
}

// A push that grows and stops, by straight lines.
double push(double time) {
  return time < 0.1 ? 20 * time : time < 0.2 ? 2 - 20 * (time - 0.1) : 0;
}

struct Quadrature {
  const char* integrator;
  double share;  // of the step, where the force is taken
  double tolerance = 1e-9;
};
class KeyedForce : public testing::TestWithParam<Quadrature> {};

// The momentum of a free body is the sum that the method makes of the force: forces between elements cancel, and so
// they do to Newton's tolerance; the one linear solve of semi_implicit is made to 1e-4 of the force out of balance.
TEST_P(KeyedForce, GivesAFreeBodyItsImpulse) {
  const auto& [integrator, share, tolerance] = GetParam();
  for (const char* how : {"where x > 0.399", "through where x < 0.1", "at 0.2 0.05 0.05"}) {
    TestSession test(bar_and({fmt::format("integrator {}", integrator), fmt::format("force 0 0 0 as push {}", how),
                              "key force push path 0 0 0 0 0.1 0 0 2 0.2 0 0 0 interpolation linear"}));
    const double h = 0.004;
    double impulse = 0;
    for (int step = 0; step < 60; ++step) {
      impulse += h * push((step + share) * h);
      test.run({fmt::format("step 1 dt {}", h)});
      ASSERT_NEAR(test.measure("momentum_z"), impulse, tolerance) << integrator << " " << how << " step " << step;
    }
    EXPECT_NEAR(test.measure("momentum_x"), 0, tolerance);
    EXPECT_NEAR(impulse, 0.2, 0.002);  // ∫ f dt, to the order of the steps
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, KeyedForce,
                         testing::Values(Quadrature{"implicit_euler newton 30 tolerance 1e-12", 1},
                                         Quadrature{"semi_implicit", 1, 1e-4}, Quadrature{"symplectic_euler", 0},
                                         Quadrature{"midpoint", 0.5}, Quadrature{"velocity_verlet", 0.5}),
                         [](const auto& test) {
                           const std::string name = test.param.integrator;
                           return name.substr(0, name.find(' '));
                         });

TEST(Keys, GiveTheFormulaOfTwoStepsItsForceAtTheEndOfEach) {
  TestSession test(bar_and({"integrator bdf2 newton 30 tolerance 1e-12",
                            "key gravity path 0 0 0 0 0.1 0 0 2 0.2 0 0 0 interpolation linear"}));
  const double h = 0.01, mass = test.measure("mass");
  double before = 0, now = h * mass * push(h);  // the first step is one of Euler's method
  test.run({fmt::format("step 1 dt {}", h)});
  for (int step = 1; step < 30; ++step) {
    const double next = (4 * now - before) / 3 + 2 * h / 3 * mass * push((step + 1) * h);
    before = now;
    now = next;
    test.run({"step"});
    ASSERT_NEAR(test.measure("momentum_z"), now, 1e-9 * mass) << step;
  }
}

TEST(Keys, AreTakenAtTheTimeOfEverySubstep) {
  TestSession test(bar_and({"integrator implicit_euler newton 30 tolerance 1e-12 substeps 4",
                            "key gravity path 0 0 0 0 0.1 0 0 2 0.2 0 0 0 interpolation linear"}));
  test.run({"step 2 dt 0.04"});
  double impulse = 0;
  for (int part = 1; part <= 8; ++part) impulse += 0.01 * push(0.01 * part);
  EXPECT_NEAR(test.measure("momentum_z"), impulse * test.measure("mass"), 1e-9);
}

// The second root of BDF2, 1/3, is forgotten in the thirty steps after the kick.
TEST(Keys, LeaveABodyThatIsFreeToMoveAtItsMomentumOnceTheyAreZero) {
  TestSession test(bar_and({"integrator bdf2 newton 30 tolerance 1e-12", "force 0 0 0 as kick where x > 0.399",
                            "key force kick path 0 0 0 0 0.05 1 0 2 0.1 0 0 0", "step 40 dt 0.01"}));
  const double x = test.measure("momentum_x"), z = test.measure("momentum_z"),
               turn = test.measure("angular_momentum_y");
  EXPECT_GT(z, 0.05);
  test.run({"step 50"});
  EXPECT_NEAR(test.measure("momentum_x"), x, 1e-10);
  EXPECT_NEAR(test.measure("momentum_z"), z, 1e-10);
  // Angular momentum is kept to the order of the method.
  EXPECT_NEAR(test.measure("angular_momentum_y"), turn, 0.02 * std::abs(turn));
}

/// Where the keys below take a point of the end, which turns about (0.4, 0.05, 0.05).
Eigen::Vector3d led(const Eigen::Vector3d& point, double time) {
  const double s = std::clamp(time / 0.2, 0.0, 1.0), part = s * s * (3 - 2 * s);
  const Eigen::Vector3d pivot(0.4, 0.05, 0.05);
  return pivot + part * Eigen::Vector3d(0.05, 0, 0.02) +
         Eigen::AngleAxisd(part * std::numbers::pi / 3, Eigen::Vector3d::UnitX()) * (point - pivot);
}

const std::vector<std::string> k_led{"pin where x < 0.01 or x > 0.39", "select vertices as end where x > 0.39",
                                     "key pin end move 0.05 0 0.02 rotate 60 axis 1 0 0 at 0.2"};

class KeyedPin : public testing::TestWithParam<const char*> {};

TEST_P(KeyedPin, FollowsItsPathUnderEveryIntegrator) {
  TestSession test(bar_and(k_led));
  test.run({fmt::format("integrator {}", GetParam()), "set damping 5"});
  const Eigen::Matrix3Xd rest = test.document().rest();
  const auto ends = test.state().sets->at("end").ids;
  for (int step = 0; step < 120; ++step) {
    test.run({"step 1 dt 1/500"});
    const fem::BodyState& motion = *test.state().motion;
    for (const std::uint32_t v : ends) {
      ASSERT_LT((motion.positions.col(v) - led(rest.col(v), motion.time)).norm(), 1e-12) << step;
      // The velocity is that of the path, to the first order of the step: its acceleration is at most 12 m/s².
      const double e = 1e-5;
      const Eigen::Vector3d velocity =
          (led(rest.col(v), motion.time + e) - led(rest.col(v), motion.time - e)) / (2 * e);
      ASSERT_LT((motion.velocities.col(v) - velocity).norm(), 12.0 / 500) << step;
    }
    for (Eigen::Index v = 0; v < rest.cols(); ++v)
      if (rest(0, v) < 0.01) {
        ASSERT_EQ(motion.positions.col(v), rest.col(v));
      }
  }
  // What leads the body does work, which the guard must not take for energy from nowhere.
  for (const StepRecord& record : test->steps()) EXPECT_EQ(record.finding, fem::GuardFinding::none);
  EXPECT_GT(test.measure("elastic_energy"), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Integrators, KeyedPin,
                         testing::Values("bdf2", "implicit_euler", "semi_implicit", "generalised_alpha",
                                         "central_difference", "forward_euler", "symplectic_euler",
                                         "velocity_verlet", "midpoint", "published"),
                         [](const auto& test) { return std::string(test.param); });

// Bodies that are carried, not deformed: what follows a pin by inertia and elasticity alone is at last where the
// pin takes it.
TEST(KeyedPins, ComeToTheEquilibriumOfPinsThatStandThere) {
  TestSession slow(bar_and(k_led));
  slow.run(
      {"integrator implicit_euler newton 50 tolerance 1e-10", "set damping 40", "step 40 dt 0.02", "step 40 dt 1"});

  TestSession still(bar_and({"pin where x < 0.01 or x > 0.39"}));
  State moved = still.state();
  auto motion = std::make_shared<fem::BodyState>(*moved.motion);
  const Eigen::Matrix3Xd rest = still.document().rest();
  for (Eigen::Index v = 0; v < rest.cols(); ++v)
    if (rest(0, v) > 0.39) motion->positions.col(v) = led(rest.col(v), 1);
  moved.motion = motion;
  still.document().assign(std::move(moved));
  still.run({"solve"});
  const double size = 0.05;
  for (Eigen::Index v = 0; v < rest.cols(); ++v)
    EXPECT_LT((slow.document().positions().col(v) - still.document().positions().col(v)).norm(), 1e-6 * size);
  // And solving there finds nothing to do.
  const Eigen::Matrix3Xd before = slow.document().positions();
  slow.run({"solve"});
  EXPECT_LT((slow.document().positions() - before).cwiseAbs().maxCoeff(), 1e-6 * size);
}

TEST(KeyedPins, CarryAWholeBodyAtItsSpeed) {
  TestSession test(bar_and({"pin where x < 0.01", "select vertices as hand where x < 0.01", "set young_modulus 1e5",
                            "key pin hand move 0 0 0 at 0 interpolation linear", "key pin hand move 2 0 0 at 2",
                            "set damping 0", "set stiffness_damping 0.01", "step 60 dt 1/60"}));
  // At 1 m/s, once what the start made it swing is gone.
  EXPECT_NEAR(test.measure("momentum_x"), test.measure("mass"), 0.01 * test.measure("mass"));
  EXPECT_NEAR(test.measure("position_x at 0.39 0.05 0.05"), 1.39, 0.002);
  test.run({"step 120"});
  EXPECT_NEAR(test.measure("position_x at 0.39 0.05 0.05"), 2.39, 0.002);
  EXPECT_NEAR(test.measure("momentum_x"), 0, 0.01 * test.measure("mass"));
}

TEST(KeyedPins, GoTwiceRound) {
  TestSession test({"new box 2 2 2 size 0.1 0.1 0.1", "levels 1", "pin where z < 0.01",
                    "select vertices as table where z < 0.01", "set stiffness_damping 0.02",
                    "key pin table rotate 720 about 0.05 0.05 0 at 2 interpolation linear", "step 30 dt 1/60"});
  const Eigen::Vector3d corner = test.document().positions().col(0);  // at 180°
  EXPECT_LT((corner - Eigen::Vector3d(0.1, 0.1, 0)).norm(), 1e-12);
  test.run({"step 120"});
  EXPECT_LT((Eigen::Vector3d(test.document().positions().col(0)) - Eigen::Vector3d(0, 0, 0)).norm(), 1e-12);
}

TEST(KeyedPins, TakeTheTargetsOfSoftOnesAlong) {
  TestSession test(bar_and({"select nodes as soft where x > 0.39", "pin stiffness 1e3", "pin where x < 0.01",
                            "select nodes set soft", "key pin soft move 0 0 0.05 at 0.1 interpolation linear"}));
  const auto first = test.document().loads_at(0).springs, half = test.document().loads_at(0.05).springs;
  ASSERT_FALSE(first.empty());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_LT((half[i].target - first[i].target - Eigen::Vector3d(0, 0, 0.025)).norm(), 1e-15);
  test.run({"step 100 dt 0.05"});
  const double held = test.measure("displacement_z at 0.395 0.05 0.05");
  EXPECT_GT(held, 0.045);
  // Taking the keys away leaves the targets where they are.
  test.run({"key pin soft remove", "step"});
  EXPECT_NEAR(test.measure("displacement_z at 0.395 0.05 0.05"), held, 1e-4);
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_LT((test.document().loads().springs[i].target - first[i].target - Eigen::Vector3d(0, 0, 0.05)).norm(),
              1e-15);
}

TEST(KeyedPins, StayWhereTheyAreWhenTheirKeysGo) {
  TestSession test(bar_and(k_led));
  test.run({"step 10 dt 0.01"});
  const Eigen::Matrix3Xd there = test.document().positions();
  test.run({"key pin end remove", "step 10"});
  for (const std::uint32_t v : test.state().sets->at("end").ids)
    EXPECT_EQ(test.document().positions().col(v), there.col(v));
}

TEST(KeyedPins, FollowTheSolidThroughEdits) {
  TestSession test({"new box 2 1 1 size 0.2 0.1 0.1", "pin where x > 0.19", "select vertices as end where x > 0.19",
                    "key pin end move 0 0 0.1 at 1", "extrude 0.1 where z > 0.09 and x > 0.1"});
  ASSERT_EQ(test.state().pins->motions.size(), 1U);
  const std::size_t members = test.state().pins->motions[0].members.ids.size();
  test.run({"levels 1", "step 5 dt 1/60"});
  EXPECT_EQ(test.state().pins->motions[0].members.ids.size(), members);
  EXPECT_GT(test.measure("max_speed"), 0);
}

TEST(Keys, BeginWithWhatIsNowWhereTheFirstLiesAhead) {
  TestSession test(bar_and({"gravity 0 0 -1", "key gravity 0 0 -3 at 2 interpolation linear"}));
  EXPECT_EQ(test.state().loads->gravity_track.times, (std::vector<double>{0, 2}));
  EXPECT_NEAR(gravity_at(*test.state().loads, 1).z(), -2, 1e-15);
  test.run({"step 60 dt 1/60", "key gravity remove"});  // it stays what it is then
  EXPECT_NEAR(test.state().loads->gravity.z(), -2, 1e-12);
  test.run({"key gravity 0 0 0 at 5", "gravity 0 0 -9.81"});
  EXPECT_TRUE(test.state().loads->gravity_track.empty());
}

TEST(Keys, AreUndoneHashedAndReplayed) {
  const std::string text =
      "argil 1\nnew box 4 1 1 size 0.4 0.1 0.1\nlevels 1\npin where x < 0.01 or x > 0.39\n"
      "select vertices as \"the end\" where x > 0.39\nforce 0 0 0 as push through where x > 0.1 and x < 0.2\n"
      "key force push path 0 0 0 0 0.1 0 0 5 interpolation linear\nkey pin \"the end\" move 0.02 0 0 at 0.3\n"
      "key gravity 0 0 -2 at 0.2\nkey gravity 0 0 -1 at 0.1\nstep 12 dt 1/60\nkey gravity remove at 0.1\nstep "
      "5\nkeys\n";
  TestSession live, again;
  live->run_text(text, "live");
  again->run_text(live.folder().text_of("journal.argil"), "journal");
  EXPECT_EQ(live.hash(), again.hash());
  std::vector<std::uint64_t> hashes;
  const std::uint64_t last = live.hash();
  for (int i = 0; i < 7; ++i) {
    live.run({"undo"});
    hashes.push_back(live.hash());
  }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());  // every line changes the state
  live.run({"redo all"});
  EXPECT_EQ(live.hash(), last);
}

TEST(Keys, LeaveTheHashOfWhatHasNoneAlone) {
  TestSession plain(bar_and({"gravity 0 0 -1", "pin where x < 0.01"}));
  TestSession keyed(bar_and({"gravity 0 0 -1", "pin where x < 0.01", "key gravity 0 0 -2 at 1"}));
  EXPECT_NE(plain.hash(), keyed.hash());
  keyed.run({"key gravity remove"});
  EXPECT_EQ(plain.hash(), keyed.hash());
}

TEST(Keys, MoveToAnotherTimeAsTheyAre) {
  // As if they had been set there: the same hash, for each kind of what has keys.
  const auto value = [](const std::string& of, bool first) {
    if (of.starts_with("pr")) return first ? "amount 0.3" : "amount 0.7";
    if (of.starts_with("pin") || of.starts_with("obs"))
      return first ? "move 0.1 0.2 0.3 rotate 77 axis 1 2 3" : "move 0.3 0.1 0.7";
    return first ? "0.1 0.2 0.3" : "0.3 0.1 0.7";
  };
  const auto with = [&](const std::string& at, const std::string& of) {
    return bar_and({"pin where x < 0.01", "select vertices as foot where x < 0.01",
                    "force 0 0 0 as push where x > 0.39", "pressure 0 as bag where x > 0.39", "set prestress 50",
                    "obstacle floor plane", fmt::format("key {} {} at 0.1", of, value(of, true)),
                    fmt::format("key {} {} at {} interpolation linear", of, value(of, false), at)});
  };
  for (const std::string of :
       {"gravity", "force push", "pressure bag", "prestress", "pin foot", "obstacle floor"}) {
    TestSession moved(with("0.5", of)), there(with("0.8", of));
    const std::uint64_t before = moved.hash();
    moved.run({"key " + of + " at 0.5 to 0.8"});
    EXPECT_EQ(moved.hash(), there.hash()) << of;
    moved.run({"undo"});
    EXPECT_EQ(moved.hash(), before) << of;
    EXPECT_THAT(moved.fault_of("key " + of + " at 0.5 to 0.1").what(), HasSubstr("a key at 0.1 s already")) << of;
    EXPECT_THAT(moved.fault_of("key " + of + " at 0.4 to 0.6").what(), HasSubstr("there are keys at")) << of;
    EXPECT_EQ(moved.hash(), before) << of;
  }
  // The only one as well, and over others.
  TestSession one(bar_and({"key gravity 0 0 -1 at 0"}));
  one.run({"key gravity 0 0 -2 at 1", "key gravity at 0 to 2"});
  EXPECT_EQ(one.state().loads->gravity_track.times, (std::vector<double>{1, 2}));
  EXPECT_EQ(one.state().loads->gravity_track.values(2, 1), -1);
  one.run({"key gravity remove at 2", "key gravity at 1 to 0.25"});
  EXPECT_EQ(one.state().loads->gravity_track.times, (std::vector<double>{0.25}));
}

TEST(Keys, SayWhatIsWrong) {
  TestSession test(bar_and({"pin where x < 0.01", "select vertices as wide where x < 0.11",
                            "select vertices as foot where x < 0.01", "force 0 0 0 as push where x > 0.39"}));
  const std::uint64_t hash = test.hash();
  for (const auto& [line, message] : std::initializer_list<std::pair<const char*, const char*>>{
           {"key force 0 0 1 at 1", "which force"},
           {"key force pusj 0 0 1 at 1", "did you mean `push`"},
           {"key gravity push 0 0 1", "gravity has no name"},
           {"key gravity", "wants a value"},
           {"key gravity at 1", "wants a value"},
           {"key gravity interpolation linear", "has no keys yet"},
           {"key gravity remove", "has no keys"},
           {"key gravity at 1 to 2", "has no keys"},
           {"key gravity to 2", "which key is to be moved"},
           {"key gravity 0 0 1 at 1 to 2", "leave out value"},
           {"key gravity 0 0 1 at -1", "must lie between"},
           {"key gravity path -1 0 0 1", "time begins at 0"},
           {"key gravity path 0 0 0", "groups of 4"},
           {"key gravity 0 0 1 path 0 0 0 1", "a path has its own times"},
           {"key gravity move 0 0 1", "pins move and turn"},
           {"key pin foot 0 0 1 at 1", "a pin moves"},
           {"key pin foot", "wants a value"},
           {"key pin fot move 0 0 1", "did you mean `foot`"},
           {"key pin wide move 0 0 1", "not pinned"},
           {"key pin foot remove", "no pin named"},
           {"key pin foot axis 0 0 1", "an axis is that of a turn"},
           {"key pin foot rotate 10 axis 0 0 0", "no length"},
           {"key gravity 0 0 1 interpolation cubic", "must be one of"},
           {"key colour 0 0 1", "must be one of"},
           {"force clear as pusch", "did you mean `push`"},
           {"force 0 0 1 at 0.1 0.05 0.05 through", "leave out"},
       }) {
    EXPECT_THAT(test.fault_of(line).what(), HasSubstr(message)) << line;
    EXPECT_EQ(test.hash(), hash) << line;
  }
  test.run({"key pin foot move 0 0 1 at 1", "pin where x < 0.11"});
  EXPECT_THAT(test.fault_of("key pin wide move 0 0 1 at 1").what(), HasSubstr("led by 'foot' already"));
  EXPECT_THAT(test.fault_of("key pin foot move 0 0 1 about 0 0 0").what(), HasSubstr("goes with its first key"));
  EXPECT_THAT(test.fault_of("key pin foot remove at 0.4").what(), HasSubstr("there are keys at 0, 1 s"));
}

TEST(BodyForces, AreSpreadByVolumeInEverySpace) {
  for (const char* space : {"default", "cubic"}) {
    TestSession test({"new box 4 4 4 size 0.4 0.4 0.4", "levels 1", fmt::format("space {}", space),
                      "select edges angle 45", "sharpen", "select cells as half where x < 0.2",
                      "force 1 2 3 through"});
    const Eigen::Matrix3Xd forces = test.document().loads().forces;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < forces.cols(); ++i) {
      const Eigen::Vector3d at = test.document().rest().col(i), force = forces.col(i);
      sum += force;
      moment += at.cross(force);
    }
    EXPECT_LT((sum - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12) << space;
    // The moment is that of the whole force in the middle of the half: shape functions hold rigid motions.
    EXPECT_LT((moment - Eigen::Vector3d(0.1, 0.2, 0.2).cross(Eigen::Vector3d(1, 2, 3))).norm(), 1e-3) << space;
  }
}

}  // namespace
}  // namespace argil::sculpt
