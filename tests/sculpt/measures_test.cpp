#include "sculpt/measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

// A bar of 0.4 × 0.1 × 0.1 m, E = 1e5, with its flat ends and sharp edges.
std::vector<std::string> bar(const std::string& space) {
  return {
      "new box 4 1 1 size 0.4 0.1 0.1", "select edges angle 30", "sharpen",           "levels 1", "space " + space,
      "set young_modulus 1e5",          "set density 500",       "pin where x < 0.01"};
}

TEST(MeasuresOfTopology, CountHandlesPartsAndPyramids) {
  TestSession test({"new box 5 3 1 size 5 3 1"});
  EXPECT_EQ(test.measure("genus"), 0);
  test.run({"remove where y > 1 and y < 2 and (x > 1 and x < 2 or x > 3 and x < 4)"});
  EXPECT_EQ(test.measure("genus"), 2);
  EXPECT_EQ(test.measure("components"), 1);
  test.run({"join pyramid at 9 0 0"});
  EXPECT_EQ(test.measure("components"), 2);
  test.run({"levels 1"});
  EXPECT_EQ(test.measure("pyramids"), 8);  // the apex has four edges: a cell of eight faces
  EXPECT_EQ(test.measure("elements"), 13 * 8 + 4 + 8);
}

class Measures : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Spaces, Measures, testing::Values("default", "cubic"));

TEST_P(Measures, ReactionsBalanceTheLoads) {
  TestSession session(bar(GetParam()));
  session.run({"gravity 1 2 -9.81", "solve"});
  const double mass = session.measure("mass");
  EXPECT_NEAR(mass, 2, 1e-12);
  // The solver stops at 1e-8 of the loads.
  EXPECT_NEAR(session.measure("reaction_x"), -mass * 1, 1e-6);
  EXPECT_NEAR(session.measure("reaction_y"), -mass * 2, 1e-6);
  EXPECT_NEAR(session.measure("reaction_z"), mass * 9.81, 1e-6);
  session.run({"force 0.3 0 -0.7 where x > 0.39", "force 0 0.2 0 at 0.21 0.03 0.04", "solve"});
  EXPECT_NEAR(session.measure("reaction_x"), -mass - 0.3, 1e-6);
  EXPECT_NEAR(session.measure("reaction_y"), -2 * mass - 0.2, 1e-6);
  EXPECT_NEAR(session.measure("reaction_z"), mass * 9.81 + 0.7, 1e-6);
  EXPECT_NEAR(session.measure("reaction_z where x < 0.01"), session.measure("reaction_z"), 1e-12);
  EXPECT_EQ(session.measure("reaction where x > 0.01"), 0);
}

TEST_P(Measures, SpringsThatHoldNodesAreAmongTheReactions) {
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2", "levels 1", std::string("space ") + GetParam(),
                       "select nodes where pz < 0.05", "pin stiffness 1e3", "gravity 0 0 -9.81", "solve"});
  const double weight = session.measure("mass") * 9.81;
  EXPECT_NEAR(session.measure("reaction_z"), weight, 1e-6 * weight);
  EXPECT_NEAR(session.measure("reaction_x"), 0, 1e-6 * weight);
}

TEST_P(Measures, APointForceDoesHalfItsWorkElastically) {
  TestSession session(bar(GetParam()));
  session.run({"model linear", "force 0.02 0.1 -0.3 at 0.31 0.06 0.05", "solve"});
  const double work = 0.5 * (0.02 * session.measure("displacement_x at 0.31 0.06 0.05") +
                             0.1 * session.measure("displacement_y at 0.31 0.06 0.05") -
                             0.3 * session.measure("displacement_z at 0.31 0.06 0.05"));
  EXPECT_GT(work, 0);
  EXPECT_NEAR(session.measure("elastic_energy"), work, 1e-6 * work);
  EXPECT_NEAR(session.measure("energy"), session.measure("elastic_energy"), 1e-15);
}

TEST_P(Measures, AStretchedBarHasTheStrainOfItsLoad) {
  TestSession session(bar(GetParam()));
  // ν = 0: uniform strain F/(EA) = 0.02 of the bar whose end is gripped; the equivalent strain, of
  // the deviator, is 2/3 of it.
  session.run({"set poisson_ratio 0", "force 20 0 0 where x > 0.39", "solve"});
  EXPECT_NEAR(session.measure("displacement_x at 0.4 0.05 0.05"), 0.008, 1e-8);
  EXPECT_NEAR(session.measure("displacement_x at 0.1 0.02 0.07"), 0.002, 1e-8);
  EXPECT_NEAR(session.measure("position_x at 0.1 0.02 0.07"), 0.102, 1e-8);
  EXPECT_NEAR(session.measure("strain_mean"), 2.0 / 3 * 0.02, 1e-4 * 0.02);
  EXPECT_NEAR(session.measure("strain_max"), 2.0 / 3 * 0.02, 1e-4 * 0.02);
  EXPECT_NEAR(session.measure("stress_mean"), 2000, 1);
  EXPECT_NEAR(session.measure("stress_max where x > 0.2"), 2000, 1);
  EXPECT_NEAR(session.measure("volume"), 0.004 * 1.02, 1e-9);
  EXPECT_NEAR(session.measure("max_displacement"), 0.008, 1e-8);
  EXPECT_NEAR(session.measure("elastic_energy"), 0.5 * 20 * 0.008, 1e-6);
}

TEST_P(Measures, ABodyInFreeFallHasTheMomentumOfItsWeight) {
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2", "levels 1", std::string("space ") + GetParam(),
                       "gravity 0 0 -10", "step 10 dt 0.01"});
  const double mass = session.measure("mass");
  EXPECT_NEAR(session.measure("time"), 0.1, 1e-15);
  EXPECT_NEAR(session.measure("momentum_z"), -mass, 1e-3 * mass);
  EXPECT_NEAR(session.measure("max_speed"), 1, 1e-3);
  EXPECT_NEAR(session.measure("kinetic_energy"), 0.5 * mass, 1e-3 * mass);
  EXPECT_NEAR(session.measure("elastic_energy"), 0, 1e-12);
}

TEST(Measures, CountsAreThoseOfTheSolid) {
  TestSession session({"new box 3 2 1", "levels 1", "pin where x = 0"});
  EXPECT_EQ(session.measure("control_cells"), 6);
  EXPECT_EQ(session.measure("cells"), 48);
  EXPECT_EQ(session.measure("elements"), 48);
  EXPECT_EQ(session.measure("unknowns"), 3 * (24 - 6));
}

TEST(Measures, ExpectationsThatFailAreCollected) {
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2", "select edges angle 30", "sharpen", "levels 1"});
  session.run(
      {"expect volume 0.008 within 1e-12", "expect volume 0.00801 within 1%", "expect mass above 7.9 below 8.1"});
  EXPECT_TRUE(session->failed().empty());
  session.run({"expect volume 0.00801 within 0.1%", "expect mass above 8.1", "expect mass 8 within 1 below 7.5"});
  ASSERT_EQ(session->failed().size(), 3U);
  EXPECT_THAT(session->failed()[0].message, HasSubstr("expected volume 0.00801 within 0.1% m^3, found 0.008"));
  EXPECT_THAT(session->failed()[1].message, HasSubstr("above 8.1"));
  EXPECT_EQ(session->failed()[0].where, "input:1:1");
  EXPECT_EQ(session->expectations, 6);
}

TEST(Measures, EveryMeasureOfTheTableCanBeTaken) {
  TestSession session(bar("default"));
  session.run({"gravity 0 0 -1", "step 2", "save itself.vtu"});
  for (const MeasureInfo& info : measure_table()) {
    const std::string asked = info.name + (info.against_reference ? " reference itself.vtu" : "");
    EXPECT_TRUE(std::isfinite(session.measure(asked + (info.at_point ? " at 0.2 0.05 0.05" : "")))) << info.name;
    if (info.over_nodes) {
      EXPECT_TRUE(std::isfinite(session.measure(asked + " where x < 0.2"))) << info.name;
    }
  }
  EXPECT_LT(session.measure("error_max reference itself.vtu"), 1e-12);
  const ReferenceShape itself(read_compared_mesh(session.folder().path() / "itself.vtu", 1000));
  for (const std::string& name : shown_field_names())
    EXPECT_EQ(shown_field(session.document(), name, &itself).values.size(),
              static_cast<Eigen::Index>(session.document().refinement().solid().vertex_capacity()));
}

}  // namespace
}  // namespace argil::sculpt
