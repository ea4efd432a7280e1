#include "tools/studio/picking.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "sculpt/scene.h"
#include "subdiv/primitives.h"

namespace argil::studio {
namespace {

const sculpt::SceneSurface& box_surface() {
  static const sculpt::SceneSurface surface = [] {
    const subdiv::Built grid = subdiv::box_grid(3, 4, 5, {1, 2, 3});
    return sculpt::cells_surface(grid.solid, grid.positions);
  }();
  return surface;
}

TEST(Picking, ARayMeetsABoxWhereItsSlabsDo) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1, 1);
  int met = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d origin = Eigen::Vector3d(0.5, 1, 1.5) +
                                   6 * Eigen::Vector3d(share(random), share(random), share(random)).normalized();
    const Eigen::Vector3d towards(0.5 + 0.7 * share(random), 1 + 1.3 * share(random), 1.5 + 1.9 * share(random));
    const Ray ray{origin, (towards - origin).normalized()};
    double enters = -1e9, leaves = 1e9;
    for (int k = 0; k < 3; ++k) {
      const double a = -origin[k] / ray.direction[k],
                   b = (Eigen::Vector3d(1, 2, 3)[k] - origin[k]) / ray.direction[k];
      enters = std::max(enters, std::min(a, b));
      leaves = std::min(leaves, std::max(a, b));
    }
    const auto hit = pick(box_surface(), ray);
    ASSERT_EQ(hit.has_value(), enters < leaves) << i;
    if (!hit) continue;
    ++met;
    // Places of the surface are in single precision.
    EXPECT_NEAR(hit->distance, enters, 1e-5);
    EXPECT_LT(hit->normal.dot(ray.direction), 0);
    EXPECT_NEAR(hit->normal.cwiseAbs().maxCoeff(), 1, 1e-5);
  }
  EXPECT_GT(met, 100);
}

TEST(Picking, ValuesAreThoseOfTheTrianglesThatAreDrawn) {
  std::vector<float> values;  // linear in space, so that every interpolation gives it back
  for (const Eigen::Vector3f& p : box_surface().positions) values.push_back(2 * p.x() - p.y() + 0.5F * p.z());
  const Ray ray{{3, -4, 5}, (Eigen::Vector3d(0.6, 0.9, 1.2) - Eigen::Vector3d(3, -4, 5)).normalized()};
  const auto hit = pick(box_surface(), ray);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(value_at(box_surface(), values, *hit), 2 * hit->at.x() - hit->at.y() + 0.5 * hit->at.z(), 1e-5);
}

TEST(Picking, TheCameraSeesAPlaceWhereItsRayGoes) {
  OrbitCamera camera;
  camera.set_window(1280, 800, {60, 40, 900, 680});
  camera.frame({{-1, -1, -1}, {1, 1, 1}});
  camera.arrive();
  camera.orbit(37, -21);
  camera.pan(12, 30);
  camera.zoom(1.5);
  const Eigen::Vector3d place(0.3, -0.2, 0.6);
  const Eigen::Vector2d pixel = camera.pixel(place);
  const Ray ray = camera.ray(pixel.x(), pixel.y());
  EXPECT_NEAR((place - ray.origin).cross(ray.direction).norm(), 0, 1e-12);
  // And where the picture has it.
  const view::Place at{{0.1, 0.2, 0.3}, 1.7};
  const view::Camera drawn = camera.camera(at, {{-1, -1, -1}, {1, 1, 1}});
  const Eigen::Vector2f seen = drawn.pixel(at(place.cast<float>()), 1280, 800);
  EXPECT_NEAR(seen.x(), pixel.x(), 0.01);
  EXPECT_NEAR(seen.y(), pixel.y(), 0.01);
}

}  // namespace
}  // namespace argil::studio
