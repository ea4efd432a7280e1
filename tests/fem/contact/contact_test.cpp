#include "fem/contact/contact.h"

#include <gtest/gtest.h>

#include <random>

#include "fem/simulated_solid.h"

namespace argil::fem {
namespace {

struct Scene {
  Scene(double friction, ObstacleShape shape, const Eigen::Vector3d& size, const Eigen::Vector3d& position)
      : body(test::box(2, 2, 2, {1, 1, 1}), 1, {}, {}) {
    contact.surface = std::make_shared<ContactSurface>(
        contact_surface(body.discretization, body.refinement.solid(), body.fields.young_modulus));
    Obstacle obstacle{.id = 3, .shape = shape, .size = size, .position = position};
    obstacle.friction = friction;
    contact.obstacles.push_back(obstacle);
  }
  test::SimulatedSolid body;
  Contact contact;
};

TEST(ContactSurface, AreasSumToThatOfTheBody) {
  const Scene scene(0, ObstacleShape::plane, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  double sum = 0;
  for (const double area : scene.contact.surface->areas) {
    EXPECT_GT(area, 0);
    sum += area;
  }
  EXPECT_NEAR(sum, 6, 1e-12);  // Simpson's rule is exact on squares
  // Nodes, middles of edges and of faces of six sides of 4 x 4 squares.
  EXPECT_EQ(scene.contact.surface->point_count(), 98U + 192U + 96U);
  for (const double stiffness : scene.contact.surface->stiffness)
    EXPECT_NEAR(stiffness, k_contact_stiffness * 1000 / 0.25, 1e-6);
}

TEST(ContactSurface, AUniformDepthGivesUniformPressure) {
  Scene scene(0, ObstacleShape::plane, Eigen::Vector3d::Zero(), {0, 0, 0.01});
  const BodyState& state = scene.body.state;
  const Wrench found = contact_wrench(scene.contact, state);
  const double pressure = k_contact_stiffness * 1000 / 0.25 * 0.01;
  // The rim of the sides touches as well, where only the lowest ring of points is under the plane; its force is
  // along the plane's normal too.
  EXPECT_NEAR(found.force.x(), 0, 1e-12);
  EXPECT_NEAR(found.force.y(), 0, 1e-12);
  EXPECT_GE(found.force.z(), pressure * (1 - 1e-12));
  EXPECT_NEAR(found.moment.x(), 0.5 * found.force.z(), 1e-12);
  EXPECT_NEAR(found.moment.y(), -0.5 * found.force.z(), 1e-12);
  EXPECT_EQ(contact_wrench(scene.contact, state, 4).force.norm(), 0) << "of an obstacle that is not there";
}

TEST(Contact, NothingActsBeforeItTouches) {
  Scene scene(0.5, ObstacleShape::plane, Eigen::Vector3d::Zero(), {0, 0, -1e-9});
  EXPECT_EQ(contact_forces(scene.contact, scene.body.state).norm(), 0);
  ContactStep step(scene.contact, scene.body.state, 0);
  step.set_state(scene.body.state.positions);
  EXPECT_TRUE(step.touches().empty());
  EXPECT_EQ(step.energy(scene.body.state.positions), 0);
}

/// Random displacements that leave much of the lower side beneath z = 0.05, drawn sideways.
Eigen::Matrix3Xd displaced(const Eigen::Matrix3Xd& rest, double size) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-size, size);
  Eigen::Matrix3Xd result = rest;
  for (Eigen::Index i = 0; i < result.size(); ++i) result.data()[i] += any(random);
  return result;
}

TEST(Contact, ForceIsTheEnergysDerivativeAndTheTangentTheForces) {
  // Of the plane, whose normal does not turn, with friction that sticks and that slips, and without; of curved
  // obstacles without friction.
  struct Case {
    ObstacleShape shape;
    Eigen::Vector3d size, position;
    double friction, sideways;
  };
  const Case cases[] = {{ObstacleShape::plane, {0, 0, 0}, {0, 0, 0.05}, 0, 0},
                        {ObstacleShape::plane, {0, 0, 0}, {0, 0, 0.05}, 50, 0.01},
                        {ObstacleShape::plane, {0, 0, 0}, {0, 0, 0.05}, 0.05, 0.1},
                        {ObstacleShape::sphere, {0.6, 0, 0}, {0.5, 0.5, -0.4}, 0, 0},
                        {ObstacleShape::capsule, {0.4, 0.6, 0}, {0.5, 0.4, -0.3}, 0, 0},
                        {ObstacleShape::box, {0.4, 0.3, 0.4}, {0.5, 0.4, -0.3}, 0, 0}};
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::Message() << word(c.shape) << " " << c.friction);
    Scene scene(c.friction, c.shape, c.size, c.position);
    const Eigen::Matrix3Xd p =
        displaced(scene.body.rest, 0.005).colwise() + Eigen::Vector3d(c.sideways, 0.5 * c.sideways, 0);
    ContactStep step(scene.contact, scene.body.state, 0);
    step.set_state(p);
    ASSERT_GT(step.touches().size(), 10U);
    if (c.friction > 0) {
      const bool slips = std::ranges::any_of(step.touches(), [](const Touch& t) { return t.slips(); });
      EXPECT_EQ(slips, c.friction < 1);
    }
    Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, p.cols());
    step.add_forces(force);
    const Eigen::Matrix3Xd direction = displaced(Eigen::Matrix3Xd::Zero(3, p.cols()), 1);
    constexpr double k_eps = 1e-6;
    const double slope = (step.energy(p + k_eps * direction) - step.energy(p - k_eps * direction)) / (2 * k_eps);
    EXPECT_NEAR(slope, -force.cwiseProduct(direction).sum(), 1e-6 * force.norm() * direction.norm());
    Eigen::Matrix3Xd product = Eigen::Matrix3Xd::Zero(3, p.cols());
    step.add_product(direction, product);
    // Symmetric, and not negative.
    const Eigen::Matrix3Xd other = displaced(Eigen::Matrix3Xd::Zero(3, p.cols()), 0.3).rowwise().reverse();
    Eigen::Matrix3Xd other_product = Eigen::Matrix3Xd::Zero(3, p.cols());
    step.add_product(other, other_product);
    EXPECT_NEAR(other.cwiseProduct(product).sum(), direction.cwiseProduct(other_product).sum(),
                1e-10 * product.norm() * other.norm());
    EXPECT_GE(direction.cwiseProduct(product).sum(), 0);
    if (c.shape != ObstacleShape::plane || c.friction == 0.05) continue;
    // Of the sticking or frictionless plane it is the whole derivative, where no point comes or goes.
    ContactStep there = step, back = step;
    there.set_state(p + 1e-9 * direction);
    back.set_state(p - 1e-9 * direction);
    ASSERT_EQ(there.touches().size(), back.touches().size());
    Eigen::Matrix3Xd difference = Eigen::Matrix3Xd::Zero(3, p.cols()), minus = difference;
    there.add_forces(difference);
    back.add_forces(minus);
    difference = (minus - difference) / 2e-9;
    EXPECT_LT((difference - product).norm(), 1e-5 * product.norm());
  }
}

TEST(Contact, FrictionHoldsToItsLimitAndItsAnchorFollows) {
  Scene scene(0.3, ObstacleShape::plane, Eigen::Vector3d::Zero(), {0, 0, 0.01});
  BodyState state = scene.body.state;
  const auto moved = [&](double x) {
    Eigen::Matrix3Xd p = scene.body.rest;
    p.row(0).array() += x;
    return p;
  };
  const auto force_at = [&](double x) {
    ContactStep step(scene.contact, state, 0);
    step.set_state(moved(x));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Touch& t : step.touches()) sum += t.force();
    state.grips = step.grips();
    return sum;
  };
  // The depth is 0.01, so that friction holds over 0.003 sideways, with the stiffness of the normal.
  const Eigen::Vector3d first = force_at(0.002);
  EXPECT_NEAR(first.x() / first.z(), -0.2, 1e-12);
  const Eigen::Vector3d slid = force_at(0.05);
  EXPECT_NEAR(slid.x() / slid.z(), -0.3, 1e-12);
  EXPECT_NEAR(force_at(0.05 - 0.002).x() / slid.z(), -0.1, 1e-12) << "from an anchor that had come along to 0.047";
  EXPECT_NEAR(force_at(0.05 - 0.02).x() / slid.z(), 0.3, 1e-12) << "back, over the limit on the other side";
}

TEST(Contact, AMovingObstacleDragsWhatItHolds) {
  Scene scene(0.5, ObstacleShape::plane, Eigen::Vector3d::Zero(), {0, 0, 0.01});
  BodyState state = scene.body.state;
  ContactStep begin(scene.contact, state, 0);
  begin.set_state(state.positions);
  state.grips = begin.grips();
  scene.contact.obstacles[0].velocity = {0.1, 0, 0};
  ContactStep step(scene.contact, state, 0.02);  // 2 mm on
  step.set_state(state.positions);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Touch& t : step.touches()) sum += t.force();
  EXPECT_NEAR(sum.x() / sum.z(), 0.2, 1e-12);
}

}  // namespace
}  // namespace argil::fem
