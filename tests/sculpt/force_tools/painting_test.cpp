#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sculpt/document_loads.h"
#include "sculpt/stroke.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

std::vector<std::string> block() {
  return {"new box 3 3 2 size 0.3 0.3 0.2",
          "select edges angle 30",
          "sharpen",
          "levels 1",
          "pin where z < 0.01",
          "gravity 0 0 -10",
          "step 3"};
}

const Eigen::VectorXd& field(const TestSession& session, FieldName name) {
  return (*session.state().fields)[name];
}

TEST(PaintStroke, WithoutAStepPositionAndVelocityStay) {
  for (const char* tool : {"paint_stiffness scale 3", "paint_mass scale 3", "paint_damping value 5"}) {
    TestSession session(block());
    const auto motion = session.state().motion;
    const std::uint64_t before = session.hash();
    session.run({std::string("tool ") + tool + " radius 0.1", "stroke path 0 0.15 0.15 0.2 9 0.2 0.15 0.2"});
    EXPECT_NE(session.hash(), before);
    EXPECT_EQ(session.state().motion, motion) << "the very same arrays";
  }
}

TEST(PaintStroke, GivesTheFieldItsFalloffFromTheWay) {
  TestSession session(block());
  session.run({"gravity 0 0 0", "undo 3", "tool paint_stiffness scale 4 radius 0.1 falloff linear",
               "stroke path 0 0.1 0.15 0.2 9 0.2 0.15 0.2"});
  // At rest: the distance of each node from the line between the ends.
  const Eigen::Matrix3Xd nodes =
      subdiv::apply(session.document().refinement().stencils.back(), session.document().positions());
  const Eigen::VectorXd& young = field(session, FieldName::young_modulus);
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    const Eigen::Vector3d x = nodes.col(i);
    const double distance = (x - Eigen::Vector3d(std::clamp(x.x(), 0.1, 0.2), 0.15, 0.2)).norm();
    EXPECT_NEAR(young[i], 1e5 * std::pow(4, std::max(0.0, 1 - distance / 0.1)), 1e-6 * young[i]);
  }
}

TEST(PaintStroke, DoesNotDependOnHowLongItTakes) {
  // Standing still: what is painted once is not painted again, however many steps pass.
  const auto painted = [](const std::string& path) {
    TestSession session({"new box 3 3 2 size 0.3 0.3 0.2", "levels 1", "tool paint_mass scale 2 radius 0.1",
                         "stroke path " + path});
    return field(session, FieldName::density);
  };
  const Eigen::VectorXd fast = painted("0 0.1 0.15 0.18 5 0.2 0.15 0.18"),
                        slow = painted("0 0.1 0.15 0.18 400 0.2 0.15 0.18");
  EXPECT_GT(fast.maxCoeff(), 1500);
  EXPECT_LT((fast - slow).cwiseAbs().maxCoeff(), 1e-6 * 1000);
}

TEST(PaintStroke, WhileTheBodyMovesOn) {
  TestSession session(block()), replayed(block());
  session.run({"tool paint_mass scale 3 radius 0.1"});
  replayed.run({"tool paint_mass scale 3 radius 0.1"});
  Stroke stroke(session.session(), {{0.1, 0.15, 0.2}});
  int steps = 0;
  for (int tick = 1; tick <= 131; ++tick)
    steps += stroke.tick({{0.1 + 0.001 * tick, 0.15 + 0.01 * std::sin(0.1 * tick), 0.2}});
  EXPECT_GE(steps, 7);
  replayed.run({stroke.finish()});
  EXPECT_EQ(session.hash(), replayed.hash());
  EXPECT_EQ(session->steps().size(), 3U + static_cast<unsigned>(steps));
  // Heavier on top, it sinks deeper.
  TestSession light(block());
  light.run({"step 8"});
  EXPECT_LT(session.measure("momentum_z"), 1.05 * light.measure("momentum_z"));
}

TEST(PaintStroke, TheMaskProtectsAndPressureSharesOut) {
  TestSession session(block());
  session.run({"set mask 1 where x < 0.15", "tool paint_stiffness value 5e5 radius 0.1 falloff constant",
               "stroke path 0 0.15 0.15 0.2 pressures 0.5"});
  const Eigen::Matrix3Xd nodes =
      subdiv::apply(session.document().refinement().stencils.back(), session.document().rest());
  const Eigen::VectorXd& young = field(session, FieldName::young_modulus);
  EXPECT_NEAR(young.maxCoeff(), 3e5, 1e-6);
  for (Eigen::Index i = 0; i < nodes.cols(); ++i)
    if (nodes(0, i) < 0.149) {
      EXPECT_EQ(young[i], 1e5);
    }
}

TEST(PaintStroke, PressureRisesAlongTheWay) {
  Eigen::Matrix3Xd nodes;
  const auto painted = [&](const std::string& scales) {
    TestSession session(block());
    nodes = subdiv::apply(session.document().refinement().stencils.back(), session.document().positions());
    session.run({"tool paint_stiffness value 5e5 radius 0.1 falloff constant",
                 "stroke path 0 0 0.15 0.2 1 0.3 0.15 0.2 pressures 0 1" + scales});
    return field(session, FieldName::young_modulus);
  };
  const Eigen::VectorXd strength = painted(""), radius = painted(" scales radius");
  int touched = 0, within = 0;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    // A constant brush leaves what it was pressed with where its middle came nearest.
    const double share = std::clamp(nodes(0, i) / 0.3, 0.0, 1.0);
    const double away = (nodes.col(i) - Eigen::Vector3d(0.3 * share, 0.15, 0.2)).norm();
    EXPECT_NEAR(strength[i], 1e5 + (away < 0.1 ? 4e5 * share : 0), 1e-5);
    touched += away < 0.1;
    // One that grows paints a cone: all that any of its balls holds, here tried one after another.
    double least = 1e9;
    for (int k = 1; k <= 3000; ++k)
      least = std::min(least, (nodes.col(i) - Eigen::Vector3d(k * 1e-4, 0.15, 0.2)).norm() / (k / 3000.0));
    EXPECT_NEAR(radius[i], least < 0.1 ? 5e5 : 1e5, 1e-5) << least;
    within += least < 0.1;
  }
  EXPECT_GT(within, 3);
  EXPECT_GT(touched, within);
}

TEST(PaintStroke, InvertedItTakesBack) {
  TestSession session(block());
  session.run({"tool paint_stiffness scale 3 radius 0.1", "stroke path 0 0.15 0.15 0.2",
               "stroke path 0 0.15 0.15 0.2 invert"});
  EXPECT_LT((field(session, FieldName::young_modulus).array() / 1e5 - 1).abs().maxCoeff(), 1e-12);
  session.run({"tool paint_damping value 7", "stroke path 0 0.15 0.15 0.2"});
  EXPECT_GT(field(session, FieldName::damping).maxCoeff(), 3);
  session.run({"tool paint_damping falloff constant radius 0.15", "stroke path 0 0.15 0.15 0.2 invert"});
  EXPECT_EQ(field(session, FieldName::damping).maxCoeff(), 0);
}

TEST(PaintStroke, ValuesThatAFieldCannotHaveAreRefused) {
  TestSession session(block());
  session.run({"tool paint_mass value -3 radius 0.1"});
  const std::uint64_t before = session.hash();
  EXPECT_THAT(session.fault_of("stroke path 0 0.15 0.15 0.2").what(), HasSubstr("density must lie between"));
  EXPECT_THAT(session.fault_of("tool paint_mass value 3 scale 2").what(), HasSubstr("leave out"));
  session.run({"tool paint_mass scale 2"});
  EXPECT_THAT(session.fault_of("stroke path 0 0.15 0.15 0.9").what(), HasSubstr("touches nothing"));
  session.run({"undo"});
  EXPECT_EQ(session.hash(), before);
}

TEST(PinBrush, PinsWhereItGoesAndReleases) {
  TestSession session(block());
  const std::size_t before = session.state().pins->control_points.size();
  session.run({"tool pin_brush radius 0.06", "stroke path 0 0.1 0.1 0.2 200 0.2 0.1 0.2"});
  const Pins pins = *session.state().pins;
  ASSERT_EQ(pins.control_points.size(), before + 2);
  EXPECT_TRUE(std::is_sorted(pins.control_points.begin(), pins.control_points.end()));
  const Eigen::Matrix3Xd held = session.document().positions();
  session.run({"step 20"});
  for (const std::uint32_t v : pins.control_points) EXPECT_EQ(session.document().positions().col(v), held.col(v));
  session.run({"stroke path 0 0.1 0.1 0.2 20 0.2 0.1 0.2 invert"});
  EXPECT_EQ(session.state().pins->control_points.size(), before);
}

}  // namespace
}  // namespace argil::sculpt
