#include "sculpt/physics_picture.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sculpt/picture.h"
#include "sculpt/shown_fields.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

PictureRequest request_of(const std::string& field) {
  PictureRequest request;
  request.field = field;
  return request;
}

const std::vector<std::string> k_box{"new box 3 3 3 size 1 1 1", "levels 1", "set young_modulus 1e5",
                                     "set poisson_ratio 0.25"};

TEST(ShownFields, OfAUniformStretchAreItsPrincipalStrainsStressesAndVolume) {
  TestSession session(k_box);
  session.deform(Eigen::Vector3d(1.1, 0.95, 1.02).asDiagonal());
  const double mu = 1e5 / 2.5, lambda = 1e5 * 0.25 / (1.25 * 0.5), trace = 0.1 - 0.05 + 0.02;
  const std::pair<const char*, double> wanted[] = {{"strain_1", 0.1},
                                                   {"strain_2", 0.02},
                                                   {"strain_3", -0.05},
                                                   {"stress_1", 2 * mu * 0.1 + lambda * trace},
                                                   {"stress_3", -2 * mu * 0.05 + lambda * trace},
                                                   {"pressure", -(2 * mu / 3 + lambda) * trace},
                                                   {"distortion", 1.1 * 0.95 * 1.02 - 1}};
  for (const auto& [name, value] : wanted) {
    const ShownField field = shown_field(session.document(), name);
    EXPECT_NEAR(field.values.minCoeff(), value, 1e-9 * (1 + std::abs(value))) << name;
    EXPECT_NEAR(field.values.maxCoeff(), value, 1e-9 * (1 + std::abs(value))) << name;
    EXPECT_EQ(field.map, ColourMap::balanced);
    EXPECT_NEAR(session.measure(std::string(name) + "_mean"), value, 1e-9 * (1 + std::abs(value)));
  }
  EXPECT_NEAR(session.measure("min_volume_ratio"), 1.1 * 0.95 * 1.02, 1e-12);
  EXPECT_EQ(shown_field(session.document(), "young_modulus").map, ColourMap::cividis);
  // Prestress p is a second Piola–Kirchhoff stress: it adds p times the stretch.
  session.run({"set prestress 100"});
  EXPECT_NEAR(session.measure("stress_1_max"), 2 * mu * 0.1 + lambda * trace + 110, 1e-6);
}

TEST(ShownFields, WithASignGetALegendAsFarBelowZeroAsAbove) {
  TestSession session(k_box);
  session.deform(Eigen::Vector3d(1.1, 1, 1).asDiagonal());
  const Scene scene = make_scene(session.document(), request_of("displacement_x"));
  EXPECT_EQ(scene.legend->low, -scene.legend->high);
  EXPECT_EQ(scene.legend->map, ColourMap::balanced);
  EXPECT_NEAR(scene.legend->high, 0.1, 0.021);
}

TEST(ShownFields, WhatRoundingLeavesOfABodyAtRestIsNoPattern) {
  TestSession session(k_box);
  session.deform(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix());
  for (const char* field : {"stress", "stress_1", "pressure"}) {
    const Scene scene = make_scene(session.document(), request_of(field));
    EXPECT_GT(shown_field(session.document(), field).values.cwiseAbs().maxCoeff(), 1e-12) << field;
    EXPECT_EQ(scene.legend->high, 1) << field;  // [Pa]
    for (const float value : scene.surface.values) EXPECT_LT(std::abs(value), 1e-3) << field;
  }
}

TEST(Frames, TangentsFollowTheMapAndRotatedOnesOnlyTurn) {
  TestSession session(k_box);
  Scene rest;
  add_frames(rest, session.document(), FrameKind::tangent);
  ASSERT_EQ(rest.lines.size(), 3U);
  ASSERT_EQ(rest.lines[0].lines.size(), 216U);
  Eigen::Matrix3d map;
  map << 1.3, 0.4, 0, 0, 0.8, 0.2, 0.1, 0, 1;
  session.deform(map);
  Scene tangent, rotated;
  add_frames(tangent, session.document(), FrameKind::tangent);
  add_frames(rotated, session.document(), FrameKind::rotated);
  for (std::size_t cell : {0U, 100U, 215U}) {
    Eigen::Matrix3f axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto along = [&](const Scene& scene) -> Eigen::Vector3f {
        return scene.lines[axis].lines[cell][1] - scene.lines[axis].lines[cell][0];
      };
      EXPECT_LT((along(tangent) - map.cast<float>() * along(rest)).norm(), 1e-6F);  // single precision
      axes.col(static_cast<Eigen::Index>(axis)) = along(rotated);
    }
    const float length = axes.col(0).norm();
    EXPECT_LT((axes.transpose() * axes - length * length * Eigen::Matrix3f::Identity()).norm(),
              1e-4F * length * length);
    EXPECT_GT(axes.determinant(), 0);
  }
}

TEST(ShearedCorner, TurnsItsSidesBackToTheRestAngleByHalfEach) {
  TestSession session(k_box);
  // A simple shear of a corner inside, where all rest angles of the regular grid are right ones.
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  map(0, 1) = 0.5;
  const Eigen::Matrix3Xd rest = session.document().surface_nodes(session.document().rest());
  Eigen::Index middle = 0;
  (rest.colwise() - Eigen::Vector3d::Constant(0.5)).colwise().norm().minCoeff(&middle);
  session.deform(map);
  const ShearedCorner corner = sheared_corner(session.document(), static_cast<std::uint32_t>(middle));
  EXPECT_NEAR(corner.rest_angle, M_PI / 2, 1e-12);
  EXPECT_NEAR(std::abs(corner.rest_angle - corner.angle), std::atan(0.5), 1e-12);
  const Eigen::Vector3d a = corner.a_unsheared - corner.at, b = corner.b_unsheared - corner.at;
  EXPECT_NEAR(a.dot(b), 0, 1e-12);
  EXPECT_NEAR(a.norm(), (corner.a_now - corner.at).norm(), 1e-12);
  EXPECT_NEAR(b.norm(), (corner.b_now - corner.at).norm(), 1e-12);
  // Each by the same angle.
  const auto between = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  EXPECT_NEAR(between(a, corner.a_now - corner.at), std::atan(0.5) / 2, 1e-12);
  EXPECT_NEAR(between(b, corner.b_now - corner.at), std::atan(0.5) / 2, 1e-12);
  const Scene scene = corner_scene(session.document(), static_cast<std::uint32_t>(middle));
  EXPECT_EQ(scene.labels.size(), 5U);
  EXPECT_THROW((void)sheared_corner(session.document(), 100000), Error);
}

TEST(Overlay, HasEveryEdgeOfTheMeshOnceAndRestIsTheSolidAtRest) {
  TestSession session({"new box 2 1 1 size 2 1 1", "save box.obj"});
  PictureRequest request;
  request.overlay_rest = true;
  EXPECT_EQ(make_scene(session.document(), request).lines.at(0).lines.size(), 20U);
  const ComparedMesh mesh = read_compared_mesh(session.folder().path() / "box.obj", 1000);
  request.overlay_rest = false;
  request.overlay = mesh.surface;
  EXPECT_EQ(make_scene(session.document(), request).lines.at(0).lines.size(), 20U);
  EXPECT_THROW((void)read_compared_mesh(session.folder().path() / "box.obj", 3), Error);
}

TEST(Render, ExplainsWhatDoesNotGoTogether) {
  TestSession session(k_box);
  for (const char* line :
       {"render a.png volume", "render a.png opacity 2 field strain", "render a.png colours cividis",
        "render a.png field error", "render a.png field strain reference a.vtu"})
    EXPECT_THAT(std::string(session.fault_of(line).what()), testing::HasSubstr("; ")) << line;
}

}  // namespace
}  // namespace argil::sculpt
