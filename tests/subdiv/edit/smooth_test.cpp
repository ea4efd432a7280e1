#include "subdiv/edit/smooth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "subdiv/primitives.h"
#include "subdiv/primitives/round.h"
#include "subdiv/solid_measures.h"
#include "tests/shapes/shapes.h"

namespace argil::subdiv {
namespace {

std::vector<VertexId> all_vertices(const Solid& solid) {
  std::vector<VertexId> vertices;
  for (const VertexId v : solid.vertices()) vertices.push_back(v);
  return vertices;
}

Eigen::Matrix3Xd smoothed(const Built& built, const SmoothOptions& options) {
  GuardedMotion motion(built.solid, built.positions, all_vertices(built.solid));
  smooth(built.solid, motion, all_vertices(built.solid), options);
  return motion.positions();
}

TEST(Smooth, NeighboursOfCreasesLieOnThemAndCornersHaveNone) {
  const Built box = test::sharp_box_grid(2, 2, 2, {2, 2, 2});
  EXPECT_THAT(smoothing_neighbours(box.solid, VertexId{0u}), testing::IsEmpty());
  EXPECT_THAT(smoothing_neighbours(box.solid, VertexId{1u}), testing::ElementsAre(VertexId{0u}, VertexId{2u}));
  EXPECT_EQ(smoothing_neighbours(box.solid, VertexId{4u}).size(), 4u);   // within a side
  EXPECT_EQ(smoothing_neighbours(box.solid, VertexId{13u}).size(), 6u);  // inside
}

TEST(Smooth, ABoxWithSharpEdgesComesBackFromNoiseInside) {
  Built box = test::sharp_box_grid(4, 4, 4, {4, 4, 4});
  const Eigen::Matrix3Xd even = box.positions;
  for (const VertexId v : box.solid.vertices())
    if (!box.solid.is_boundary(v))
      box.positions.col(v.value) += 0.3 * Eigen::Vector3d(std::sin(v.value), 0.5, -0.4);
  EXPECT_LT((smoothed(box, {.times = 120}) - even).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Smooth, NoiseGoesAndTheVolumeStays) {
  Built ball = sphere(1, {32, 1, 2});
  const double volume = mass_properties(ball.solid, ball.positions).volume;
  const auto roughness = [&](const Eigen::Matrix3Xd& positions) {
    double sum = 0;
    for (const VertexId v : ball.solid.vertices())
      if (ball.solid.is_boundary(v))
        sum += std::pow((positions.col(v.value) - Eigen::Vector3d(0, 0, 1)).norm() - 1, 2);
    return std::sqrt(sum);
  };
  ball.positions = test::jittered(ball.positions, 0.02, 3);
  const Eigen::Matrix3Xd kept = smoothed(ball, {.times = 6}), shrunk = smoothed(ball, {.times = 6, .shrink = true});
  EXPECT_LT(roughness(kept), 0.5 * roughness(ball.positions));
  EXPECT_NEAR(mass_properties(ball.solid, kept).volume, volume, 0.02 * volume);
  EXPECT_LT(mass_properties(ball.solid, shrunk).volume, 0.95 * volume);
}

TEST(Smooth, NoCellCloses) {
  for (const test::Shape& shape : test::catalogue()) {
    SCOPED_TRACE(shape.name);
    const Built built{shape.solid, shape.positions, {}};
    const GuardedMotion before(shape.solid, shape.positions, all_vertices(shape.solid));
    const GuardedMotion after(shape.solid, smoothed(built, {.times = 20, .shrink = true}),
                              all_vertices(shape.solid));
    double worst_before = 0.15, worst_after = 1;
    for (const VertexId v : shape.solid.vertices()) {
      worst_before = std::min(worst_before, before.openness(v));
      worst_after = std::min(worst_after, after.openness(v));
    }
    EXPECT_GE(worst_after, worst_before);
  }
}

TEST(GuardedMotion, OpennessIsTheLeastDeterminantOfUnitEdges) {
  const Built box = box_grid(1, 1, 1, {1, 2, 3});
  GuardedMotion motion(box.solid, box.positions, all_vertices(box.solid));
  for (const VertexId v : box.solid.vertices()) EXPECT_NEAR(motion.openness(v), 1, 1e-15);
  const Built tip = pyramid({1, 1, 1});
  const GuardedMotion of_pyramid(tip.solid, tip.positions, all_vertices(tip.solid));
  for (const VertexId v : tip.solid.vertices()) EXPECT_GT(of_pyramid.openness(v), 0.1);
}

TEST(GuardedMotion, StopsBeforeACellClosesAndLetsOneOpen) {
  const Built box = box_grid(2, 1, 1, {2, 1, 1});
  GuardedMotion motion(box.solid, box.positions, all_vertices(box.solid));
  EXPECT_TRUE(motion.move(VertexId{1u}, {1.3, 0, 0}));
  EXPECT_FALSE(motion.move(VertexId{1u}, {9, 0, 0}));
  EXPECT_GT(motion.at(VertexId{1u}).x(), 1.3);
  EXPECT_GT(motion.openness(VertexId{1u}), 0.1);
  Eigen::Matrix3Xd folded = box.positions;
  folded.col(1) << 3, 0, 0;
  GuardedMotion repair(box.solid, folded, all_vertices(box.solid));
  EXPECT_LT(repair.openness(VertexId{1u}), 0);
  EXPECT_TRUE(repair.move(VertexId{1u}, {1, 0, 0}));
}

}  // namespace
}  // namespace argil::subdiv
