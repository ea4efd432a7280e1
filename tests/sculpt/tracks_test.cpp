#include "sculpt/tracks.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "subdiv/error.h"

namespace argil::sculpt {
namespace {

Track track_of(Interpolation interpolation, const std::vector<std::pair<double, double>>& keys) {
  Track track;
  track.interpolation = interpolation;
  for (const auto& [time, value] : keys) set_key(track, time, Eigen::VectorXd::Constant(1, value));
  return track;
}

double at(const Track& track, double time) {
  return value_at(track, time)[0];
}

constexpr Interpolation k_all[] = {Interpolation::smooth, Interpolation::linear, Interpolation::step};

TEST(Tracks, PassThroughTheirKeysAndStayBeforeAndAfter) {
  for (const Interpolation interpolation : k_all) {
    const Track track = track_of(interpolation, {{2, -1}, {0.5, 3}, {1, 7}});  // in any order
    EXPECT_EQ(track.times, (std::vector<double>{0.5, 1, 2}));
    EXPECT_EQ(at(track, 0.5), 3);
    EXPECT_EQ(at(track, 1), 7);
    EXPECT_EQ(at(track, 2), -1);
    EXPECT_EQ(at(track, -10), 3);
    EXPECT_EQ(at(track, 10), -1);
    EXPECT_EQ(rate_at(track, 0.2)[0], 0);
    EXPECT_EQ(rate_at(track, 2.1)[0], 0);
  }
}

TEST(Tracks, GoBetweenKeysAsTheyAreToldTo) {
  EXPECT_DOUBLE_EQ(at(track_of(Interpolation::linear, {{0, 1}, {2, 5}}), 0.5), 2);
  EXPECT_DOUBLE_EQ(rate_at(track_of(Interpolation::linear, {{0, 1}, {2, 5}}), 0.5)[0], 2);
  EXPECT_EQ(at(track_of(Interpolation::step, {{0, 1}, {2, 5}}), 1.999), 1);
  // A clock that is a sum of steps comes to the key, if it is a rounding short of it.
  EXPECT_EQ(at(track_of(Interpolation::step, {{0, 1}, {2, 5}}), 2 - 1e-12), 5);
  // Two keys alone, level at both ends: 3s² − 2s³.
  EXPECT_DOUBLE_EQ(at(track_of(Interpolation::smooth, {{0, 1}, {2, 5}}), 0.5), 1 + 4 * (3.0 / 16 - 2.0 / 64));
}

TEST(Tracks, AreOnceDifferentiableAndMonotoneWhereSmooth) {
  const Track track = track_of(Interpolation::smooth, {{0, 0}, {0.4, 1}, {1, 1.2}, {1.5, 4}, {2, 3}, {3, 3}});
  const double e = 1e-6;
  double before = at(track, 0);
  for (double time = 0.001; time < 3.2; time += 0.001) {
    const double now = at(track, time);
    if (time <= 1.5) {
      EXPECT_GE(now, before - 1e-12) << time;
    }
    if (time > 1.5 && time < 2) {
      EXPECT_LE(now, before + 1e-12) << time;
    }
    EXPECT_LE(now, 4 + 1e-12);
    // Central differences err by e² times the third derivative, which is some 100, and by rounding over e.
    EXPECT_NEAR((at(track, time + e) - at(track, time - e)) / (2 * e), rate_at(track, time)[0], 1e-4) << time;
    before = now;
  }
  for (const double key : {0.0, 0.4, 1.0, 1.5, 2.0, 3.0})
    EXPECT_NEAR((at(track, key + e) - at(track, key)) / e, (at(track, key) - at(track, key - e)) / e, 1e-4) << key;
  EXPECT_NE(rate_at(track, 0.4)[0], 0);  // it does not stop at keys that it rises through
}

TEST(Tracks, ReplaceAndRemoveKeys) {
  Track track = track_of(Interpolation::linear, {{0, 0}, {1, 1}, {2, 0}});
  set_key(track, 1 + 1e-12, Eigen::VectorXd::Constant(1, 5));
  EXPECT_EQ(track.times.size(), 3U);
  EXPECT_EQ(at(track, 1), 5);
  EXPECT_FALSE(remove_key(track, 1.5));
  EXPECT_TRUE(remove_key(track, 1));
  EXPECT_EQ(at(track, 1), 0);
  EXPECT_TRUE(remove_key(track, 0));
  EXPECT_TRUE(remove_key(track, 2));
  EXPECT_TRUE(track.empty());
  EXPECT_THROW((void)interpolation_by_word("cubic"), Error);
}

TEST(Tracks, TurnPastAWholeRoundAndKnowTheVelocity) {
  Track track;
  track.interpolation = Interpolation::linear;
  Eigen::VectorXd end(6), bent(6);
  end << 0.3, 0, 0, 0, 0, 4 * std::numbers::pi;  // two rounds in 2 s
  set_key(track, 0, Eigen::VectorXd::Zero(6));
  set_key(track, 2, end);
  const Eigen::Vector3d pivot(1, 2, 3), point(1.5, 2, 3);
  EXPECT_LT((motion_at(track, pivot, 1) * point - Eigen::Vector3d(1.65, 2, 3)).norm(), 1e-12);
  EXPECT_LT((motion_at(track, pivot, 0.25) * point - Eigen::Vector3d(1.0375, 2.5, 3)).norm(), 1e-12);

  bent << 0.1, -0.4, 0.2, 0.7, -1.1, 0.3;  // the axis turns on the way
  track.interpolation = Interpolation::smooth;
  set_key(track, 3, bent);
  const double e = 1e-6;
  for (const double time : {0.001, 0.3, 1.0, 1.7, 2.4, 2.9}) {
    const Eigen::Vector3d velocity =
        (motion_at(track, pivot, time + e) * point - motion_at(track, pivot, time - e) * point) / (2 * e);
    EXPECT_LT((velocity - velocity_at(track, pivot, time, motion_at(track, pivot, time) * point)).norm(), 1e-6)
        << time;
    const RigidMotion motion = motion_at(track, pivot, time);
    EXPECT_LT((motion.inverse() * (motion * point) - point).norm(), 1e-14);
    EXPECT_LT(((motion * motion.inverse()) * point - point).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace argil::sculpt
