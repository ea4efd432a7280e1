#include "sculpt/force_tools/curve.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sculpt/stroke.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

std::vector<Eigen::Vector3d> bent(std::size_t count) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = static_cast<double>(i);
    points.emplace_back(t, std::sin(t), 0.3 * t * t);
  }
  return points;
}

TEST(HandleCurve, GoesThroughItsHandles) {
  for (const std::size_t count : {2U, 3U, 4U, 5U, 9U}) {
    const HandleCurve curve(bent(count));
    EXPECT_EQ(curve.parameter_of(0), 0);
    EXPECT_DOUBLE_EQ(curve.parameter_of(count - 1), curve.end());
    for (std::size_t i = 0; i < count; ++i) {
      const double t = curve.parameter_of(i);
      EXPECT_LT((curve.point(t) - bent(count)[i]).norm(), 1e-12 * count);
      const Eigen::VectorXd influences = curve.influences(t);
      for (std::size_t j = 0; j < count; ++j) EXPECT_NEAR(influences[static_cast<Eigen::Index>(j)], i == j, 1e-12);
    }
  }
}

TEST(HandleCurve, IsAnAffineCombinationAndSmooth) {
  const std::size_t count = 8;
  const HandleCurve curve(bent(count));
  for (double t = 0; t <= curve.end(); t += 0.0625) EXPECT_NEAR(curve.influences(t).sum(), 1, 1e-12);
  // Twice continuously differentiable at inner knots: second differences from both sides meet, as third derivatives
  // are bounded.
  const double h = 1e-3;
  for (double knot = 1; knot < curve.end(); ++knot) {
    const auto second = [&](double t) {
      return Eigen::Vector3d((curve.point(t + h) - 2 * curve.point(t) + curve.point(t - h)) / (h * h));
    };
    EXPECT_LT((second(knot + h) - second(knot - h)).norm(), 50 * h);
  }
  // A straight line with even steps stays one, at the even pace of its parameter.
  const HandleCurve line({{0, 0, 0}, {1, 2, 0}});
  EXPECT_LT((line.point(0.25 * line.end()) - Eigen::Vector3d(0.25, 0.5, 0)).norm(), 1e-14);
}

TEST(HandleCurve, RefusesWhatIsNone) {
  EXPECT_THROW(HandleCurve({{0, 0, 0}}), Error);
  EXPECT_THROW(HandleCurve({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}), Error);
}

std::vector<std::string> slab(double strength) {
  return {"new box 6 3 1 size 0.6 0.3 0.1", "levels 1", "pin where z < 0.01", "set damping 20",
          fmt::format("tool pull radius 0.06 strength {}", strength)};
}
const std::string k_through =
    "curve through 0.1 0.15 0.09 0.2 0.15 0.09 0.3 0.15 0.09 0.4 0.15 0.09 0.5 0.15 0.09 ";

TEST(Curve, ItsHandleMovesWhatItTouches) {
  // The slab answers with some 1e4 N/m a handle: E times its area over its height.
  TestSession session(slab(1e6));
  session.run({k_through + "handle 3 to 0.3 0.15 0.12 ticks 300 hold 700"});
  const auto along = [&](double x) { return session.measure(fmt::format("displacement_z at {} 0.15 0.0999", x)); };
  EXPECT_GE(along(0.3), 0.8 * 0.03);
  EXPECT_LE(along(0.3), 1.2 * 0.03);
  // At the other handles it holds the body where it was.
  EXPECT_LT(std::abs(along(0.4)), 0.25 * 0.03);
  EXPECT_LT(std::abs(along(0.5)), 0.1 * 0.03);
}

TEST(Curve, ALiveHandleIsItsLine) {
  TestSession live(slab(1e4)), replayed(slab(1e4));
  StrokeOptions options;
  options.curve = {{0.1, 0.15, 0.09}, {0.3, 0.15, 0.09}, {0.5, 0.15, 0.09}};
  options.handle = 1;
  Stroke stroke(live.session(), {{0.3, 0.15, 0.09}}, options);
  for (int tick = 1; tick <= 70; ++tick)
    stroke.tick({{0.3 + 0.0001 * tick, 0.15, 0.09 + 0.02 * std::sin(0.05 * tick)}});
  const std::string line = stroke.finish();
  EXPECT_THAT(line, HasSubstr("curve through 0.1 0.15 0.09 0.3 0.15 0.09 0.5 0.15 0.09 handle 2 path 0 "));
  replayed.run({line});
  EXPECT_EQ(live.hash(), replayed.hash());
}

TEST(Curve, TheDeviceFeelsTheWorkOfItsWay) {
  TestSession session(slab(1e4));
  const HandleCurve curve({{0.1, 0.15, 0.09}, {0.3, 0.15, 0.09}, {0.5, 0.15, 0.09}});
  const auto grip = take_curve(session.document(), session.state().tool, curve, 1, {{0.3, 0.15, 0.09}});
  const Eigen::Matrix3Xd& p = session.document().positions();
  const Eigen::Vector3d at(0.31, 0.14, 0.12);
  const auto energy = [&](const Eigen::Vector3d& device) {
    return fem::spring_energy(grip->loads({device}, p).springs, p);
  };
  const Felt felt = grip->felt({at}, p);
  const double h = 1e-4;  // the energy is quadratic: central differences are exact
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
    EXPECT_NEAR(felt.force[axis], -(energy(at + step) - energy(at - step)) / (2 * h), 1e-8 * felt.force.norm());
    EXPECT_NEAR(felt.derivative(axis, axis), -(energy(at + step) - 2 * energy(at) + energy(at - step)) / (h * h),
                1e-6 * std::abs(felt.derivative(axis, axis)));
  }
}

TEST(Curve, HandlesThatAreNotThereAreRefused) {
  TestSession session(slab(1e4));
  EXPECT_THAT(session.fault_of(k_through + "handle 6 to 0 0 1").what(), HasSubstr("handles 1 to 5"));
  EXPECT_THAT(session.fault_of("curve through 0 0 3 1 0 3 handle 1 to 0 0 1").what(), HasSubstr("touches nothing"));
  EXPECT_THAT(session.fault_of("curve through 0.3 0.15 0.09 handle 1 to 0 0 1").what(), HasSubstr("two points"));
}

}  // namespace
}  // namespace argil::sculpt
