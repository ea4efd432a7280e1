// The guard as a session sees it: what it prints and counts, that its state is hashed and undone, that replay takes
// the same decisions, that a frozen body is thawed, and that the samples never need it.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "sculpt/summary.h"
#include "sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const std::vector<std::string> k_stiff_bar{"new box 3 1 1 size 0.3 0.1 0.1", "levels 1", "set young_modulus 1e7",
                                           "pin where x < 0.01", "gravity 0 0 -9.81"};

TEST(SessionIntegrators, EveryMethodIsChosenHashedAndUndone) {
  TestSession test(k_stiff_bar);
  const std::uint64_t before = test.hash();
  for (const fem::MethodKind& kind : fem::method_table()) {
    SCOPED_TRACE(kind.name);
    test.run({fmt::format("integrator {}", kind.name), "step 3 dt 1e-5"});
    EXPECT_EQ(test.state().method, kind.method);
    EXPECT_LT(test.measure("energy"), 1e-3);
    EXPECT_EQ(test->steps().back().remedy, fem::GuardRemedy::none);
    test.run({"undo 2"});
    EXPECT_EQ(test.hash(), before);
  }
  test.run({"integrator generalised_alpha tolerance 1e-6 line_search off spectral_radius 0.5 substeps 4"});
  EXPECT_EQ(test.state().newton_tolerance, 1e-6);
  EXPECT_FALSE(test.state().line_search);
  EXPECT_EQ(test.state().spectral_radius, 0.5);
  EXPECT_EQ(test.state().substeps, 4);
  const std::uint64_t chosen = test.hash();
  EXPECT_NE(chosen, before);
  test.run({"step 2 dt 1/60"});
  EXPECT_EQ(test.state().motion->accelerations.cols(), test.state().motion->positions.cols());
  EXPECT_NEAR(test.state().motion->time, 2.0 / 60, 1e-12);
  test.run({"undo"});
  EXPECT_EQ(test.hash(), chosen);
}

TEST(SessionIntegrators, SubstepsAreShorterSteps) {
  TestSession parts(k_stiff_bar), steps(k_stiff_bar);
  parts.run({"integrator implicit_euler substeps 4", "step 5 dt 0.02"});
  steps.run({"integrator implicit_euler", "step 20 dt 0.005"});
  EXPECT_EQ(parts.document().positions(), steps.document().positions());
}

TEST(SessionGuard, SavesAnExplicitMethodAndSaysHow) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& text) { printed += text + "\n"; };
  TestSession test(k_stiff_bar, options);
  test.run({"integrator central_difference", "step 60 dt 1/60"});
  EXPECT_THAT(printed, HasSubstr("guard: "));
  EXPECT_THAT(printed, HasSubstr("energy that came from nowhere"));
  EXPECT_TRUE(test.document().positions().allFinite());
  EXPECT_FALSE(test.state().guard.frozen);
  // The bar hangs 1.2 mm down.
  EXPECT_LT((test.document().positions() - test.document().rest()).cwiseAbs().maxCoeff(), 4e-3);
  const auto json = nlohmann::json::parse(summary_json(test.session(), "test", 1));
  EXPECT_TRUE(json["guard"]["on"].get<bool>());
  EXPECT_GT(json["guard"]["found"]["energy"].get<int>() + json["guard"]["found"]["not_finite"].get<int>(), 0);
  EXPECT_GT(json["guard"]["steps"]["substeps"].get<int>() + json["guard"]["steps"]["implicit_euler"].get<int>(), 0);
  EXPECT_EQ(json["guard"]["steps"]["frozen"].get<int>(), 0);
  EXPECT_THAT(json["linear_solver"]["rule"].get<std::string>(), HasSubstr("3000 unknowns"));
}

TEST(SessionGuard, ReplayTakesTheSameDecisionsAndUndoTakesThemBack) {
  const std::vector<std::string> lines{"integrator midpoint", "step 30 dt 1e-4"};
  TestSession once(k_stiff_bar), again(k_stiff_bar);
  const std::uint64_t before = once.hash();
  once.run(lines);
  again.run(lines);
  EXPECT_EQ(once.hash(), again.hash());
  EXPECT_NE(once.state().guard, fem::GuardState{});  // energy came from nowhere and is remembered
  once.run({"step 5"});
  once.run({"undo", "redo", "undo"});
  EXPECT_EQ(once.hash(), again.hash());
  EXPECT_EQ(once.state().guard, again.state().guard);
  once.run({"undo 2"});
  EXPECT_EQ(once.hash(), before);
}

TEST(SessionGuard, SaysThatAToolWasEased) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& text) { printed += text + "\n"; };
  // The tool is a hundred times as stiff as the wedge, which it would pull through itself in one step.
  TestSession test({"new wedge size 0.2 0.2 0.2", "levels 1", "set young_modulus 1000", "set density 2600",
                    "space cubic", "pin where x < 0.02", "model st_venant_kirchhoff", "integrator midpoint",
                    "tool pull radius 0.08 strength 7e4", "step 1 dt 0.015",
                    "stroke from 0.1 0.1 0 to -0.09 0.28 0.36 ticks 200", "step 20"},
                   options);
  EXPECT_THAT(printed, HasSubstr("eased: as little as"));
  EXPECT_FALSE(test.state().guard.frozen);
  const auto json = nlohmann::json::parse(summary_json(test.session(), "test", 1));
  EXPECT_GT(json["guard"]["steps"]["eased"].get<int>() + json["guard"]["steps"]["eased_from_rest"].get<int>(), 0);
}

TEST(SessionGuard, AFrozenBodyMovesAgainByItselfWhenThePullIsGone) {
  std::string printed;
  SessionOptions options;
  options.print = [&](const std::string& text) { printed += text + "\n"; };
  TestSession test(k_stiff_bar, options);
  State frozen = test.state();
  frozen.guard = {0, 3, true, fem::GuardFinding::inversion};
  test->change(frozen);
  const std::uint64_t without = test.hash();
  frozen.guard.pull = 100;
  test->change(std::move(frozen));
  const std::uint64_t cold = test.hash();
  EXPECT_NE(cold, without);
  const Eigen::Matrix3Xd positions = test.document().positions();
  test.run({"step 3 dt 1e-4"});
  EXPECT_THAT(printed, HasSubstr("the body moves again from 0 s on"));
  EXPECT_FALSE(test.state().guard.frozen);
  EXPECT_NE(test.document().positions(), positions);
  EXPECT_EQ(test->steps().front().remedy, fem::GuardRemedy::none);
  test.run({"undo"});
  EXPECT_EQ(test.hash(), cold);
}

TEST(SessionGuard, OffLetsTheStepFailAndThawIsUndone) {
  TestSession test(k_stiff_bar);
  const std::uint64_t on = test.hash();
  test.run({"guard off", "integrator velocity_verlet"});
  EXPECT_NE(test.hash(), on);
  const std::uint64_t before = test.hash();
  EXPECT_EQ(test.fault_of("step 400 dt 1/60").code(), ErrorCode::not_converged);
  EXPECT_EQ(test.hash(), before);

  State frozen = test.state();
  frozen.guard_on = true;
  frozen.guard = {0, 3, true, fem::GuardFinding::energy};
  test->change(std::move(frozen));
  const std::uint64_t cold = test.hash();
  const Eigen::Matrix3Xd positions = test.document().positions();
  test.run({"step 3 dt 1e-5"});
  EXPECT_EQ(test.document().positions(), positions);
  EXPECT_EQ(test->steps().back().remedy, fem::GuardRemedy::frozen);
  test.run({"undo"});
  EXPECT_EQ(test.hash(), cold);
  test.run({"guard thaw", "step 3 dt 1e-5"});
  EXPECT_NE(test.document().positions(), positions);
  test.run({"undo 2"});
  EXPECT_EQ(test.hash(), cold);
}

}  // namespace
}  // namespace argil::sculpt
