#include "sculpt/reference_shape.h"

#include <Eigen/Geometry>

#include "io/volume_mesh.h"
#include "subdiv/primitives.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

Eigen::Matrix3d stretch() {
  Eigen::Matrix3d map;
  map << 1.2, 0.3, 0, 0, 0.9, 0.1, 0.05, 0, 1.1;
  return map;
}

ComparedMesh moved_box() {
  ComparedMesh mesh;
  mesh.volume = subdiv::box_grid(3, 2, 2, {1, 1, 1});
  const Eigen::Matrix3Xd rest = mesh.volume.positions;
  mesh.volume.positions = stretch() * rest;
  mesh.displacements = mesh.volume.positions - rest;
  return mesh;
}

TEST(ReferenceShape, OfAnAffineMotionTellsAnyMeshHowFarItIsFromIt) {
  const ReferenceShape reference(moved_box());
  EXPECT_TRUE(reference.at_common_points());
  const subdiv::Built other = subdiv::box_grid(5, 7, 4, {1, 1, 1});
  const Eigen::Vector3d off(0.01, -0.02, 0.03);
  const Eigen::Matrix3Xd there = stretch() * other.positions;
  EXPECT_LT(reference.distances(other.positions, there).maxCoeff(), 1e-12);
  const Eigen::VectorXd found = reference.distances(other.positions, there.colwise() + off);
  EXPECT_NEAR(found.minCoeff(), off.norm(), 1e-12);
  EXPECT_NEAR(found.maxCoeff(), off.norm(), 1e-12);
}

TEST(ReferenceShape, RefusesABodyThatItDoesNotReach) {
  const ReferenceShape reference(moved_box());
  const Eigen::Matrix3Xd far = Eigen::Vector3d(9, 0, 0);
  EXPECT_THROW((void)reference.distances(far, far), Error);
}

TEST(ReferenceShape, WithoutDisplacementsIsItsSurface) {
  ComparedMesh mesh;
  mesh.surface.positions.resize(3, 4);
  mesh.surface.positions << 0, 4, 4, 0, 0, 0, 4, 4, 1, 1, 1, 1;
  mesh.surface.offsets = {0, 4};
  mesh.surface.corners = {0, 1, 2, 3};
  const ReferenceShape reference(mesh);
  EXPECT_FALSE(reference.at_common_points());
  Eigen::Matrix3Xd now(3, 2);
  now << 1, 5, 2, 2, 3, 1;
  const Eigen::VectorXd found = reference.distances(now, now);
  EXPECT_NEAR(found[0], 2, 1e-12);
  EXPECT_NEAR(found[1], 1, 1e-12);
}

// The same cantilever on two levels: where the tip of the finer one lies is in its file.
TEST(ReferenceShape, OfAFinerLevelGivesTheDifferenceOfTheTips) {
  const std::vector<std::string> bar{
      "new box 4 1 1 size 0.4 0.1 0.1", "select edges angle 45", "sharpen",          "levels 1",
      "set young_modulus 1e5",          "pin where x < 0.001",   "gravity 0 0 -9.81"};
  TestSession fine(bar), coarse(bar);
  fine.run({"levels 2", "solve", "save fine.vtu"});
  coarse.run({"solve"});
  const std::string at = " at 0.4 0.05 0.05";
  const double expected = std::hypot(fine.measure("displacement_x" + at) - coarse.measure("displacement_x" + at),
                                     fine.measure("displacement_z" + at) - coarse.measure("displacement_z" + at));
  std::filesystem::copy(fine.folder().path() / "fine.vtu", coarse.folder().path() / "fine.vtu");
  const double found = coarse.measure(
      "error_max reference fine.vtu where x > 0.399 and abs(z - 0.05) < 1e-3 and "
      "abs(y - 0.05) < 1e-3");
  EXPECT_GT(expected, 1e-4);
  EXPECT_NEAR(found, expected, 1e-6);
  EXPECT_LT(coarse.measure("error_min reference fine.vtu"), 1e-9);  // where both are pinned
  coarse.run({"expect error_mean reference fine.vtu below 0.02", "save with_error.vtu reference fine.vtu"});
  bool holds_error = false;
  for (const io::NamedField& field : io::read_volume_mesh(coarse.folder().path() / "with_error.vtu").point_fields)
    holds_error = holds_error || field.name == "error";
  EXPECT_TRUE(holds_error);
  EXPECT_EQ(coarse.fault_of("measure error_max").code(), ErrorCode::bad_input);
  EXPECT_EQ(coarse.fault_of("measure volume reference fine.vtu").code(), ErrorCode::bad_input);
  EXPECT_EQ(coarse.fault_of("measure error_max reference ../fine.vtu").code(), ErrorCode::refused);
}

}  // namespace
}  // namespace argil::sculpt
