// What the tools do to a body: force and moment in all are the device's, whatever the body looks like; each does
// what its name says; all work inside and in a mirror.

#include "sculpt/force_tools/tool_table.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "fem/measure/energy.h"
#include "sculpt/force_tools/patch_modes.h"
#include "sculpt/force_tools/probe.h"
#include "sculpt/force_tools/touched.h"
#include "tests/sculpt/force_tools/held_block.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const Eigen::Vector3d k_top(0.15, 0.15, 0.2), k_inside(0.15, 0.15, 0.1);

// Every control point somewhere else: what must hold for any shape of the body is asked there.
Eigen::Matrix3Xd crumpled(const Eigen::Matrix3Xd& positions, double by) {
  std::mt19937 engine(7);
  Eigen::Matrix3Xd result = positions;
  for (Eigen::Index i = 0; i < result.size(); ++i)
    result.data()[i] += by * (static_cast<double>(engine()) / 4294967295.0 - 0.5);
  return result;
}

Eigen::Matrix3Xd forces_of(const fem::Loads& loads, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd forces =
      loads.forces.cols() > 0 ? loads.forces : Eigen::Matrix3Xd(Eigen::Matrix3Xd::Zero(3, positions.cols()));
  fem::add_spring_forces(loads.springs, positions, forces);
  return forces;
}

StrokePose moved_and_turned() {
  StrokePose pose;
  pose.position = k_top + Eigen::Vector3d(0.02, -0.01, 0.05);
  pose.orientation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized());
  return pose;
}

class Tools : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Spaces, Tools, testing::Values("default", "cubic"));

TEST_P(Tools, GrabIsARigidHandOnSprings) {
  TestSession session(held_block(GetParam()));
  const Tool tool = tool_of("grab");
  const auto grab = take_hold(session.document(), tool, {k_top}, {});
  const Touched touched = touch(session.document(), tool, k_top, false);
  const Eigen::Matrix3Xd p = crumpled(session.document().positions(), 0.02);
  for (const double pressure : {1.0, 0.4}) {
    StrokePose pose = moved_and_turned();
    pose.pressure = pressure;
    // Springs of the hand's points, summed by themselves.
    fem::Wrench device;
    for (Eigen::Index i = 0; i < touched.weights.size(); ++i) {
      const Eigen::Vector3d x = fem::position(touched.points[static_cast<std::size_t>(i)], p);
      const Eigen::Vector3d hand = pose.position + pose.orientation * (touched.positions.col(i) - k_top);
      const Eigen::Vector3d force = pressure * 50 * touched.weights[i] * (hand - x);
      device.force += force;
      device.moment += x.cross(force);
    }
    const fem::Wrench body = fem::wrench(forces_of(grab->loads(pose, p), p), p);
    EXPECT_LT((body.force - device.force).norm(), 1e-10);
    EXPECT_LT((body.moment - device.moment).norm(), 1e-10);
    EXPECT_LT((grab->felt(pose, p).force + device.force).norm(), 1e-10);
  }
  // In the hand as it was taken nothing pulls.
  EXPECT_LT(forces_of(grab->loads({k_top}, session.document().positions()), session.document().positions()).norm(),
            1e-12);
}

TEST_P(Tools, InflatePressesAlongTheNormals) {
  TestSession session(held_block(GetParam()));
  const Tool tool = tool_of("inflate");
  const Eigen::Matrix3Xd& p = session.document().positions();
  const auto inflate = take_hold(session.document(), tool, {k_top}, {});
  const auto deflate = take_hold(session.document(), tool, {k_top}, {.invert = true});
  const Touched touched = touch(session.document(), tool, k_top, false);
  // On a flat face: pressure times the area under the brush, which is π R²/3 to the accuracy of the points' sum.
  const Eigen::Vector3d expected(0, 0, 50 / 0.09 * touched.measure);
  EXPECT_LT((fem::wrench(forces_of(inflate->loads({k_top}, p), p), p).force - expected).norm(), 1e-10);
  EXPECT_LT((inflate->felt({k_top}, p).force + expected).norm(), 1e-10);
  EXPECT_LT((fem::wrench(forces_of(deflate->loads({k_top}, p), p), p).force + expected).norm(), 1e-10);
  EXPECT_NEAR(touched.measure, M_PI * 0.09 * 0.09 / 3, 0.15 * touched.measure);
  // It follows the surface as it turns.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(2, 1, -1).normalized()).toRotationMatrix();
  const Eigen::Matrix3Xd turned = turn * p;
  EXPECT_LT(
      (fem::wrench(forces_of(inflate->loads({k_top}, turned), turned), turned).force - turn * expected).norm(),
      1e-10);
}

TEST_P(Tools, InflatePressesOnLessWhereTheDeviceIsSmaller) {
  TestSession session(held_block(GetParam()));
  session.run({"levels 2"});  // the smaller brush is to have points enough
  const Tool tool = tool_of("inflate");
  const Eigen::Matrix3Xd& p = session.document().positions();
  const auto inflate = take_hold(session.document(), tool, {k_top}, {});
  const double whole = inflate->wrench({k_top}, p).force.z();
  // A little above the surface, as where the body has given way: by its nearest point, not by the distance.
  StrokePose half{k_top + Eigen::Vector3d(0, 0, 0.05)};
  half.size = 0.5;
  inflate->follow(half, session.document());
  const fem::Wrench wrench = inflate->wrench(half, p);
  // Half the radius is a quarter of the area, to the accuracy of sums over some dozen points.
  EXPECT_NEAR(wrench.force.z(), whole / 4, 0.2 * whole / 4);
  EXPECT_LT(wrench.force.head<2>().norm(), 1e-10);
  half.size = 0;  // the least that the mesh has
  inflate->follow(half, session.document());
  EXPECT_LT(inflate->wrench(half, p).force.z(), whole / 8);
  inflate->follow({k_top}, session.document());
  EXPECT_NEAR(inflate->wrench({k_top}, p).force.z(), whole, 1e-12 * whole);
}

TEST_P(Tools, InflateInsideWorksOnEveryChangeOfVolume) {
  TestSession session(held_block(GetParam()));
  const Tool tool = tool_of("inflate");
  const auto inflate = take_hold(session.document(), tool, {k_inside}, {});
  const Touched touched = touch(session.document(), tool, k_inside, false);
  ASSERT_TRUE(touched.inside);
  const fem::Discretization& d = session.document().discretization();
  const auto work = [&](const Eigen::Matrix3Xd& p) {
    const Eigen::Matrix3Xd nodes = subdiv::apply(d.nodes.rows, p);
    double sum = 0;
    for (std::size_t i = 0; i < touched.places.size(); ++i) {
      const TouchedPlace& place = touched.places[i];
      const fem::ElementBlock& block = d.blocks[place.block];
      const auto n = static_cast<std::size_t>(block.kind->node_count);
      Eigen::Matrix3d along = Eigen::Matrix3d::Zero();
      for (std::size_t a = 0; a < n; ++a)
        for (int axis = 0; axis < 3; ++axis)
          along.col(axis) += block.kind->gradients[(static_cast<std::size_t>(place.which) * n + a) * 3 +
                                                   static_cast<std::size_t>(axis)] *
                             nodes.col(block.nodes[place.element * n + a]);
      const std::size_t point = block.point_index(place.element, place.which);
      sum += 50 / 0.09 * touched.falloffs[static_cast<Eigen::Index>(i)] * block.volumes[point] *
             (along * block.inverse_rest_jacobians[point]).determinant();
    }
    return sum;
  };
  const Eigen::Matrix3Xd p = crumpled(session.document().positions(), 0.02);
  const Eigen::Matrix3Xd forces = forces_of(inflate->loads({k_inside}, p), p);
  const fem::Wrench wrench = fem::wrench(forces, p);
  EXPECT_LT(wrench.force.norm(), 1e-10);
  EXPECT_LT(wrench.moment.norm(), 1e-10);
  const Eigen::Matrix3Xd way = crumpled(Eigen::Matrix3Xd::Zero(3, p.cols()), 1);
  // The work is cubic along a line: central differences are off by its third derivative times the step squared.
  const double step = 1e-5;
  EXPECT_NEAR(forces.cwiseProduct(way).sum(), (work(p + step * way) - work(p - step * way)) / (2 * step),
              1e-6 * forces.norm());
}

TEST_P(Tools, TwistIsAPureMomentAboutTheNormal) {
  TestSession session(held_block(GetParam()));
  const Tool tool = tool_of("twist");
  const Eigen::Matrix3Xd& p = session.document().positions();
  const auto twist = take_hold(session.document(), tool, {k_top}, {});
  const auto inverse = take_hold(session.document(), tool, {k_top}, {.invert = true});
  const Touched touched = touch(session.document(), tool, k_top, false);
  double torsion = 0;
  for (Eigen::Index i = 0; i < touched.weights.size(); ++i)
    torsion += 50 * touched.weights[i] * (touched.positions.col(i) - touched.middle).squaredNorm();
  const StrokePose turned{k_top, Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ())), 1};
  for (const auto& [tool_now, sense] : {std::pair{twist.get(), 1.0}, std::pair{inverse.get(), -1.0}}) {
    const fem::Wrench wrench = fem::wrench(forces_of(tool_now->loads(turned, p), p), p);
    EXPECT_LT(wrench.force.norm(), 1e-10);
    EXPECT_LT((wrench.moment - Eigen::Vector3d(0, 0, sense * 0.4 * torsion)).norm(), 1e-10);
  }
  // A radius to the right is a turn by one radian, and the way is felt with the same work.
  const StrokePose right{k_top + Eigen::Vector3d(0.09, 0, 0)};
  EXPECT_NEAR(fem::wrench(forces_of(twist->loads(right, p), p), p).moment.z(), torsion, 1e-10);
  EXPECT_LT((twist->felt(right, p).force - Eigen::Vector3d(-torsion / 0.09, 0, 0)).norm(), 1e-10);
  // Of a body that is anyhow, the force stays none and the moment is along the patch's own normal.
  const TouchedPatch patch = touch_patch(session.document(), tool, k_top, false);
  const Eigen::Matrix3Xd q = crumpled(p, 0.03);
  const Eigen::Vector3d normal = mode_normal(mode_vectors(patch.modes, q));
  const fem::Wrench wrench = fem::wrench(forces_of(twist->loads(turned, q), q), q);
  EXPECT_LT(wrench.force.norm(), 1e-10);
  EXPECT_LT(wrench.moment.cross(normal).norm(), 1e-10);
  EXPECT_GT(wrench.moment.norm(), 0.1 * torsion);
}

TEST(Tools, TwistCountsTurns) {
  TestSession session(held_block());
  const Eigen::Matrix3Xd& p = session.document().positions();
  const auto twist = take_hold(session.document(), tool_of("twist"), {k_top}, {});
  const auto moment_at = [&](double angle) {
    const StrokePose pose{k_top, Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())), 1};
    twist->follow(pose, session.document());
    return fem::wrench(forces_of(twist->loads(pose, p), p), p).moment.z();
  };
  const double one = moment_at(1);
  for (int i = 2; i <= 20; ++i) EXPECT_NEAR(moment_at(i), i * one, 1e-10 * i);
  for (int i = 19; i >= -5; --i) EXPECT_NEAR(moment_at(i), i * one, 1e-10 * 20);
}

TEST_P(Tools, PinchDrawsTogetherWithoutForceOrMoment) {
  TestSession session(held_block(GetParam()));
  for (const Eigen::Vector3d& at : {k_top, k_inside}) {
    const Tool tool = tool_of("pinch");
    const TouchedPatch patch = touch_patch(session.document(), tool, at, false);
    for (const bool invert : {false, true}) {
      const auto pinch = take_hold(session.document(), tool, {at}, {.invert = invert});
      for (const double by : {0.0, 0.03}) {
        const Eigen::Matrix3Xd p = crumpled(session.document().positions(), by);
        const Eigen::Matrix3Xd forces = forces_of(pinch->loads({at}, p), p);
        const fem::Wrench wrench = fem::wrench(forces, p);
        EXPECT_LT(wrench.force.norm(), 1e-10);
        EXPECT_LT(wrench.moment.norm(), 1e-10);
        // The work of drawing all points together, at a constant rate.
        const double inwards = -forces.cwiseProduct(p.colwise() - pinch->held(p)).sum();
        EXPECT_GT(invert ? -inwards : inwards, 0.01);
        // On the flat face at rest, nothing acts along the normal.
        if (by == 0 && at == k_top) {
          EXPECT_LT(forces.row(2).norm(), 1e-10);
        }
      }
    }
  }
}

TEST_P(Tools, SmoothLeavesFlatSurfacesAndDrawsBumpsDown) {
  TestSession session(held_block(GetParam()));
  const Tool tool = tool_of("smooth");
  const Eigen::Matrix3Xd& p = session.document().positions();
  const auto smooth = take_hold(session.document(), tool, {k_top}, {});
  const auto sharpen = take_hold(session.document(), tool, {k_top}, {.invert = true});
  EXPECT_LT(forces_of(smooth->loads({k_top}, p), p).norm(), 1e-12);
  const Eigen::Matrix3Xd q = crumpled(p, 0.03);
  for (const auto* one : {smooth.get(), sharpen.get()}) {
    const fem::Wrench wrench = one->wrench({k_top}, q);
    EXPECT_LT(wrench.force.norm(), 1e-10);
    EXPECT_LT(wrench.moment.norm(), 1e-10);
  }
  // One control point of the top pulled out: it is pushed back, and its surroundings are drawn out.
  Eigen::Index top = 0;
  for (Eigen::Index i = 0; i < p.cols(); ++i)
    if ((p.col(i) - k_top).norm() < (p.col(top) - k_top).norm()) top = i;
  Eigen::Matrix3Xd bump = p;
  bump(2, top) += 0.03;
  const Eigen::Matrix3Xd forces = forces_of(smooth->loads({k_top}, bump), bump);
  EXPECT_LT(forces(2, top), -0.001);
}

TEST_P(Tools, SmoothPressesABumpFlatAgainstNothing) {
  auto lines = held_block(GetParam());
  lines.insert(lines.begin() + 1,
               "move 0 0 0.04 where x > 0.09 and x < 0.11 and y > 0.09 and y < 0.11 and z > 0.19");
  lines.insert(lines.end(), {"set damping 20", "tool smooth radius 0.08 strength 200000"});
  TestSession session(lines);
  Eigen::Index bump = 0;
  session.document().rest().row(2).maxCoeff(&bump);
  const double before = session.document().positions()(2, bump);
  session.run({"stroke from 0.1 0.1 0.22 to 0.1 0.1 0.22 ticks 1000"});
  EXPECT_LT(session.document().positions()(2, bump), before - 0.003);
  // Nothing but the inside of the body bears it: of forces that sum to some 100 N in size, the pins feel what the
  // tolerance of Newton's method leaves.
  EXPECT_LT(std::abs(session.measure("reaction_z")), 0.01);
}

TEST(Tools, EveryToolKeepsItsLimit) {
  TestSession session(held_block());
  const Eigen::Matrix3Xd p = crumpled(session.document().positions(), 0.03);
  for (const ToolKind& kind : tool_table()) {
    if (!kind.take_hold) continue;
    for (const Eigen::Vector3d& at : {k_top, k_inside}) {
      Tool tool = tool_of(std::string(kind.name));
      tool.strength = 5000;
      tool.largest_force = 0.25;
      const auto held = take_hold(session.document(), tool, {at}, {});
      StrokePose pose = moved_and_turned();
      pose.position += at - k_top;
      double sizes = 0;
      const fem::Loads loads = held->loads(pose, p);
      for (Eigen::Index i = 0; i < loads.forces.cols(); ++i) sizes += loads.forces.col(i).norm();
      EXPECT_GT(loads.springs.size() + static_cast<std::size_t>(loads.forces.cols()), 0U) << kind.name;
      EXPECT_LE(fem::wrench(forces_of(loads, p), p).force.norm(), 0.25 * (1 + 1e-12)) << kind.name;
      EXPECT_LE(sizes, 0.25 * (1 + 1e-12)) << kind.name;
    }
  }
}

// Bodies that are their own mirror image stay so under a tool and its image.
class Mirror : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Axes, Mirror, testing::Values("x", "y", "z"));

TEST_P(Mirror, ImagesActAlike) {
  const int axis = GetParam()[0] - 'x';
  for (const ToolKind& kind : tool_table()) {
    if (kind.name == "probe") continue;
    const bool paints = !kind.take_hold;
    TestSession session({"new box 2 2 2 at 0.1 0.2 0.3 size 0.2 0.2 0.2", "levels 1",
                         "tool " + std::string(kind.name) + " radius 0.08 strength 200 symmetry " + GetParam()});
    // Away from all planes of symmetry, near an edge of the solid.
    const double z = axis == 2 ? 0.46 : 0.48;
    const std::string at = fmt::format("{} {} {}", axis == 0 ? 0.15 : 0.2, axis == 1 ? 0.25 : 0.31, z);
    session.run({fmt::format("stroke path 0 {} 60 {} turns 1 0 0 0 0.8 0.6 0 0", at,
                             fmt::format("{} {} {}", axis == 0 ? 0.16 : 0.22, axis == 1 ? 0.27 : 0.3, z + 0.01))});
    const Eigen::Matrix3Xd& rest = session.document().rest();
    const Eigen::Matrix3Xd moved = session.document().positions() - rest;
    EXPECT_TRUE(paints || moved.norm() > 1e-6) << kind.name;
    const double plane = mirror_plane(session.document(), axis);
    EXPECT_DOUBLE_EQ(plane, 0.2 + 0.1 * axis);
    for (Eigen::Index i = 0; i < rest.cols(); ++i) {
      Eigen::Vector3d image = rest.col(i);
      image[axis] = 2 * plane - image[axis];
      for (Eigen::Index j = 0; j < rest.cols(); ++j) {
        if ((rest.col(j) - image).norm() > 1e-9) continue;
        Eigen::Vector3d back = moved.col(j);
        back[axis] *= -1;
        // The solver's tolerance of 1e-4 acts on a system that is not mirrored in its order of unknowns.
        EXPECT_LT((back - moved.col(i)).norm(), 1e-3 * moved.norm() + 1e-12) << kind.name << " " << i;
      }
    }
    if (kind.name != "paint_stiffness") continue;
    const Eigen::VectorXd& young = (*session.state().fields)[FieldName::young_modulus];
    const Eigen::Matrix3Xd nodes = subdiv::apply(session.document().refinement().stencils.back(), rest);
    EXPECT_GT(young.maxCoeff(), 1.5e5);
    for (Eigen::Index i = 0; i < nodes.cols(); ++i)
      for (Eigen::Index j = 0; j < nodes.cols(); ++j) {
        Eigen::Vector3d image = nodes.col(j);
        image[axis] = 2 * plane - image[axis];
        if ((nodes.col(i) - image).norm() < 1e-9) {
          EXPECT_NEAR(young[i], young[j], 1e-6 * young[j]);
        }
      }
  }
}

TEST(Mirror, AnImageThatTouchesNothingIsRefused) {
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2", "extrude 0.3 where z > 0.19 and x < 0.1", "levels 1",
                       "tool pull radius 0.03 symmetry x"});
  EXPECT_THAT(session.fault_of("stroke from 0.05 0.1 0.48 to 0 0 1 ticks 20").what(), HasSubstr("mirror image"));
  session.run({"tool pull symmetry none", "stroke from 0.05 0.1 0.48 to 0 0 1 ticks 20"});
}

TEST(Inside, WhatIsWithinTheRadiusIsTaken) {
  TestSession session(held_block());
  for (const char* falloff : {"smooth", "linear", "constant"}) {
    Tool tool = tool_of("pull");
    tool.falloff = falloff;
    tool.radius = 0.06;
    const Touched inside = touch(session.document(), tool, k_inside, false);
    EXPECT_TRUE(inside.inside);
    EXPECT_NEAR(inside.weights.sum(), 1, 1e-12);
    EXPECT_LT((inside.middle - k_inside).norm(), 1e-12);  // by symmetry of the mesh
    for (Eigen::Index i = 0; i < inside.weights.size(); ++i)
      EXPECT_LT((inside.positions.col(i) - k_inside).norm(), 0.06);
    // Near the surface it is the surface, unless the inside is asked for.
    const Eigen::Vector3d shallow(0.15, 0.15, 0.17);
    EXPECT_FALSE(touch(session.document(), tool, shallow, false).inside);
    EXPECT_TRUE(touch(session.document(), tool, shallow, true).inside);
  }
  // A brush finer than the mesh is widened, and outside there is nothing.
  Tool fine = tool_of("pull");
  fine.radius = 1e-4;
  EXPECT_GE(touch(session.document(), fine, k_inside, false).points.size(), 1U);
  EXPECT_TRUE(touched(session.document(), fine, {0.15, 0.15, 0.21}, true).empty());
}

TEST(Inside, ToolsPullWhatIsThere) {
  for (const char* name : {"pull", "grab"}) {
    TestSession session(held_block());
    session.run({fmt::format("tool {} radius 0.06 strength 20000", name), "set damping 20", "set young_modulus 2e4",
                 "stroke from 0.15 0.15 0.1 to 0.15 0.15 0.12 ticks 500 hold 500"});
    const double middle = session.measure("displacement_z at 0.15 0.15 0.1");
    EXPECT_GT(middle, 0.003);
    EXPECT_LT(session.measure("displacement_z at 0.15 0.15 0.1999"), 0.97 * middle) << name;
  }
}

TEST(Volume, InflateAddsItAndDeflateTakesIt) {
  for (const char* at : {"0.15 0.15 0.2", "0.15 0.15 0.1"}) {
    TestSession session(held_block());
    session.run({"set damping 20", "tool inflate radius 0.09 strength 500"});
    const double before = session.measure("volume");
    const std::string stroke = fmt::format("stroke from {0} to {0} ticks 600", at);
    session.run({stroke});
    const double inflated = session.measure("volume");
    session.run({"undo", stroke + " invert"});
    const double deflated = session.measure("volume");
    EXPECT_GT(inflated, before * 1.001) << at;
    EXPECT_LT(deflated, before * 0.999) << at;
  }
}

TEST(FirstAcceleration, IsHalvedByDoubledMass) {
  const auto speed = [](const char* density) {
    TestSession session(held_block());
    session.run({std::string("set density ") + density, "tool pull radius 0.09 strength 50", "step 1 dt 0.0001"});
    session.run({"stroke path 0 0.15 0.15 0.2 1 0.15 0.15 0.21"});
    return session.state().motion->velocities;
  };
  const Eigen::Matrix3Xd one = speed("1000"), two = speed("2000");
  EXPECT_GT(one.norm(), 0);
  // After ten steps of 0.1 ms the stiffness has begun to act: (ωt)² of the slowest waves that the force makes,
  // 1e-2.
  EXPECT_LT((one - 2 * two).norm(), 0.03 * one.norm());
}

}  // namespace
}  // namespace argil::sculpt
