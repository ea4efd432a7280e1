// Base shapes, copies and transforms as a session has them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sessions.h"
#include "subdiv/boundary.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

// `levels` refuses a Jacobian that is not positive at a quadrature point.
TEST(ShapeCommands, EveryShapeRefinesTwice) {
  for (const char* shape : {"box 2 1 3",
                            "cylinder",
                            "cylinder around 4 along 1 sharp",
                            "tube",
                            "tube around 5 sharp",
                            "cone",
                            "cone sharp around 12 rings 2",
                            "cone top 0.2",
                            "sphere",
                            "sphere around 4",
                            "sphere around 12 rings 2",
                            "torus",
                            "torus around 4 along 3",
                            "cube",
                            "octahedron",
                            "dodecahedron sharp",
                            "icosahedron",
                            "tetrahedron",
                            "tetrahedron radius 2",
                            "wedge sharp",
                            "pyramid"}) {
    SCOPED_TRACE(shape);
    TestSession test({std::string("new ") + shape, "levels 2"});
    EXPECT_GT(test.measure("volume"), 0);
  }
}

TEST(ShapeCommands, SharpOnesKeepTheirSizeWhenRefined) {
  TestSession box({"new box 2 2 2 sharp", "levels 2"});
  EXPECT_NEAR(box.measure("volume"), 1, 1e-12);
  TestSession cube({"new icosahedron sharp", "levels 1"});
  TestSession round({"new icosahedron", "levels 1"});
  EXPECT_GT(cube.measure("volume"), round.measure("volume"));
}

TEST(ShapeCommands, RefuseByNameWhatAShapeHasNot) {
  TestSession test;
  EXPECT_THAT(test.fault_of("new sphere height 2").what(), HasSubstr("a sphere has no `height`"));
  EXPECT_THAT(test.fault_of("new torus sharp").what(), HasSubstr("a torus has no `sharp`"));
  EXPECT_THAT(test.fault_of("new cylinder 4 4").what(), HasSubstr("a cylinder has no `nx`"));
  EXPECT_THAT(test.fault_of("new cylinder around 6").what(), HasSubstr("multiple of 4"));
  EXPECT_THAT(test.fault_of("new tube inner 0.6").what(), HasSubstr("smaller hole"));
  EXPECT_THAT(test.fault_of("new tetrahedron size 1 1 1 radius 1").what(), HasSubstr("leave one out"));
  EXPECT_EQ(test.fault_of("new sphere around 1000 rings 1000").code(), ErrorCode::limit_exceeded);
  EXPECT_TRUE(test.document().empty());
}

TEST(ShapeCommands, JoinKeepsWhatIsThere) {
  TestSession test({"new box 2 2 2", "levels 1", "set young_modulus 7e4", "pin where z < 0.1",
                    "join sphere radius 0.2 at 3 0 0", "join box size 0.5 0.5 0.5 at 0 4 0"});
  EXPECT_EQ(test.state().level, 1);
  EXPECT_EQ(subdiv::components(*test.state().solid).count, 3);
  EXPECT_EQ(test.state().pins->control_points.size(), 9u);
  const double there = test.measure("volume");
  test.run({"undo 2"});
  EXPECT_EQ(subdiv::components(*test.state().solid).count, 1);
  EXPECT_LT(test.measure("volume"), there);
  test.run({"save body.vtk", "join file body.vtk at 0 0 5"});
  EXPECT_EQ(subdiv::components(*test.state().solid).count, 2);
  EXPECT_THAT(test.fault_of("join").what(), HasSubstr("found neither"));
  EXPECT_THAT(test.fault_of("join sphere file body.vtk").what(), HasSubstr("leave out `shape`"));
}

TEST(ShapeCommands, TransformScalesThenTurns) {
  TestSession test({"new box 1 1 1", "transform stretch 2 1 1 rotate 90 axis 0 0 1"});
  const Eigen::Matrix3Xd rest = test.document().rest();
  EXPECT_NEAR(rest.row(1).maxCoeff(), 2, 1e-12);
  EXPECT_NEAR(rest.row(0).minCoeff(), -1, 1e-12);
  test.run({"transform scale 0.5 about 0 0 1 where z > 0.5"});
  EXPECT_NEAR(test.document().rest().row(1).maxCoeff(), 2, 1e-12);  // the lower side stays
  EXPECT_THAT(test.fault_of("transform stretch -1 1 1").what(), HasSubstr("mirror"));
  EXPECT_THAT(test.fault_of("transform scale 0").what(), HasSubstr("flatten"));
  EXPECT_THAT(test.fault_of("transform about 1 0 0").what(), HasSubstr("found none"));
  EXPECT_THAT(test.fault_of("transform axis 1 0 0 scale 2").what(), HasSubstr("no angle"));
}

TEST(ShapeCommands, ImagesTakeFieldsSetsAndPins) {
  TestSession test({"new box 2 2 2", "levels 1", "paint young_modulus scale 3 where x > 0.9",
                    "select cells as right where x > 0.5", "pin where x > 0.9",
                    "mirror normal 1 0 0 where x > -1"});
  EXPECT_EQ(test.state().solid->cell_count(), 16u);
  EXPECT_EQ(test.state().sets->at("right").ids.size(), 8u);
  EXPECT_EQ(test.state().pins->control_points.size(), 18u);
  const Eigen::Matrix3Xd rest = test.document().rest();
  EXPECT_EQ(rest.row(0).minCoeff(), -1);
}

// Whatever the level, a copy has the values of its source, node by node.
TEST(ShapeCommands, CopiesHaveTheFieldsOfTheirSources) {
  for (const char* level : {"levels 0", "levels 2"})
    for (const char* copy : {"duplicate by 5 0 0", "mirror normal 1 0 0"}) {
      SCOPED_TRACE(std::string(copy) + " at " + level);
      TestSession test({"new box 2 2 2", level, "set young_modulus 1e4 + 1e4*x*x + 3e4*y"});
      const auto half = test.state().fields;
      test.run({copy});
      const Eigen::VectorXd& values = (*test.state().fields)[FieldName::young_modulus];
      const Eigen::VectorXd& before = (*half)[FieldName::young_modulus];
      EXPECT_EQ(values.minCoeff(), before.minCoeff());
      EXPECT_EQ(values.maxCoeff(), before.maxCoeff());
      std::vector<double> here(values.begin(), values.end()), there(before.begin(), before.end());
      const auto count = [](const std::vector<double>& all, double value) {
        return std::count(all.begin(), all.end(), value);
      };
      for (const double value : there) {
        EXPECT_GT(count(here, value), 0);
        EXPECT_LE(count(here, value), 2 * count(there, value));
      }
      for (const double value : here) EXPECT_GT(count(there, value), 0) << value;
    }
}

TEST(ShapeCommands, ImagesOfABentBodyAreBentTheOtherWay) {
  TestSession test({"new box 4 1 1 size 4 1 1", "levels 0", "pin where x < 0.01", "gravity 0 0 -9.81",
                    "set young_modulus 2e4", "step 5"});
  test.run({"mirror normal 1 0 0 where x > -1"});
  const Eigen::Matrix3Xd now = test.document().positions(), rest = test.document().rest();
  EXPECT_NEAR(now.row(0).minCoeff(), -now.row(0).maxCoeff(), 1e-12);
  EXPECT_LT(now.row(2).minCoeff(), rest.row(2).minCoeff() - 1e-4);
}

TEST(ShapeCommands, FlipIsItsOwnInverse) {
  TestSession test({"new box 2 1 1"});
  const Eigen::Matrix3Xd before = test.document().rest();
  test.run({"mirror normal 1 0 0 flip"});
  EXPECT_EQ(test.document().rest().row(0), -before.row(0));
  EXPECT_GT(test.measure("volume"), 0);
  test.run({"mirror normal 1 0 0 flip"});
  EXPECT_EQ(test.document().rest(), before);
  EXPECT_THAT(test.fault_of("mirror normal 1 0 0 flip keep").what(), HasSubstr("leave out `keep`"));
}

TEST(ShapeCommands, DuplicatesMakeARing) {
  TestSession test({"new box 1 1 1 at 2 -0.5 0", "duplicate rotate 60 count 5"});
  EXPECT_EQ(subdiv::components(*test.state().solid).count, 6);
  EXPECT_NEAR(test.document().rest().rowwise().mean().head<2>().norm(), 0, 1e-12);
  EXPECT_THAT(test.fault_of("duplicate").what(), HasSubstr("give a way"));
}

TEST(ShapeCommands, SmoothLeavesPinsAndMovesTheBodyAsItsRest) {
  TestSession test({"new box 3 3 3", "pin where z > 0.9", "move 0 0 0.2 where z > 0.5 and z < 0.9"});
  const Eigen::Matrix3Xd before = test.document().rest();
  test.run({"select cells where x > -1", "smooth times 4 shrink"});
  const Eigen::Matrix3Xd after = test.document().rest();
  EXPECT_EQ(after, test.document().positions());
  for (const std::uint32_t v : test.state().pins->control_points) EXPECT_EQ(after.col(v), before.col(v));
  EXPECT_GT((after - before).norm(), 0.01);
}

std::vector<std::uint32_t> boundary_vertices(TestSession& test) {
  std::vector<std::uint32_t> vertices;
  for (const subdiv::VertexId v : test.state().solid->vertices())
    if (test.state().solid->is_boundary(v)) vertices.push_back(v.value);
  return vertices;
}

TEST(ShapeCommands, ProjectTakesTheBoundaryToASurface) {
  TestSession test({"new box 4 4 4 size 2 2 2 at -1 -1 -1", "project ball 1.2 where x > -9"});
  for (const std::uint32_t v : boundary_vertices(test))
    EXPECT_NEAR(test.document().rest().col(v).norm(), 1.2, 1e-12) << v;
  test.run({"new sphere radius 1 around 32 at 0 0 -1", "save ball.obj", "new box 4 4 4 size 2 2 2 at -1 -1 -1",
            "project ball.obj amount 0.5 where x > -9"});
  for (const std::uint32_t v : boundary_vertices(test)) EXPECT_LT(test.document().rest().col(v).norm(), 1.4);
  EXPECT_THAT(test.fault_of("project").what(), HasSubstr("found neither"));
}

TEST(ShapeCommands, SolidifyFillsASavedSurface) {
  std::vector<std::string> printed;
  SessionOptions options;
  options.print = [&](const std::string& message) { printed.push_back(message); };
  TestSession test({"new torus around 16 along 32", "save ring.obj"}, options);
  const double volume = test.measure("volume");
  test.run({"solidify ring.obj cells 14"});
  EXPECT_NEAR(test.measure("volume"), volume, 0.15 * volume);
  EXPECT_EQ(subdiv::boundary_surface(*test.state().solid).genus, 1);
  ASSERT_FALSE(printed.empty());
  test.run({"levels 1"});
  EXPECT_THAT(test.fault_of("solidify ring.obj cells 4 size 1").what(), HasSubstr("leave one out"));
  EXPECT_EQ(test.fault_of("solidify ring.obj size 1e-4").code(), ErrorCode::limit_exceeded);
  EXPECT_EQ(test.fault_of("solidify nothing.obj").code(), ErrorCode::not_found);
}

}  // namespace
}  // namespace argil::sculpt
