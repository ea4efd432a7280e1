// Plastic strain as a field that is shown, measured and written: against the return mapping of homogeneous
// deformations.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/shown_fields.h"
#include "sessions.h"
#include "sharp_box.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double k_mu = 1e5 / 2.6;

std::vector<std::string> box(const std::string& plasticity, const std::vector<std::string>& more = {}) {
  std::vector<std::string> lines = sharp_box("2 2 2 size 0.1 0.1 0.1", {plasticity});
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

Eigen::Matrix3d shear(double gamma) {
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  map(0, 1) = gamma;
  return map;
}

/// What a file says of its arrays, before their values.
std::string arrays_of(TestSession& test, const std::string& name) {
  const std::string text = test.folder().text_of(name);
  return text.substr(0, text.find("<AppendedData"));
}

TEST(PlasticStrainField, OfAShearedBoxIsThatOfTheReturnMapping) {
  for (const double gamma : {0.05, 0.4, 1.0}) {
    SCOPED_TRACE(gamma);
    TestSession test(box("plasticity yield 2000"));
    test.deform(shear(gamma));
    test.run({"pin where 1 > 0", "step 1"});
    // Simple shear has the stretches exp(±a), a = asinh(γ / 2): equivalent logarithmic strain 2a / √3. What the
    // yield stress leaves elastic is yield / 3μ of it.
    const double expected = std::max(0.0, 2 / std::sqrt(3.0) * std::asinh(gamma / 2) - 2000 / (3 * k_mu));
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(test.measure("plastic_strain_min"), expected, 1e-12);
    EXPECT_NEAR(test.measure("plastic_strain_max"), expected, 1e-12);
  }
}

TEST(PlasticStrainField, FadesInAsTheBodyCreeps) {
  TestSession test(box("plasticity creep 0.2"));
  test.deform(shear(0.2));
  test.run({"pin where 1 > 0"});
  const double all = 2 / std::sqrt(3.0) * std::asinh(0.1);
  for (int i = 1; i <= 5; ++i) {
    test.run({"step 1 dt 0.1"});
    EXPECT_NEAR(test.measure("plastic_strain_mean"), all * (1 - std::exp(-i * 0.1 / 0.2)), 1e-12);
  }
}

TEST(PlasticStrainField, IsKnownInCubicSpaceToo) {
  TestSession test({"new box 5 5 5 size 0.1 0.1 0.1", "levels 1", "space cubic", "set young_modulus 1e5",
                    "plasticity yield 2000"});
  test.deform(shear(0.4));
  test.run({"pin where 1 > 0", "step 1"});
  const double expected = 2 / std::sqrt(3.0) * std::asinh(0.2) - 2000 / (3 * k_mu);
  EXPECT_NEAR(test.measure("plastic_strain_min"), expected, 1e-10);
  EXPECT_NEAR(test.measure("plastic_strain_max"), expected, 1e-10);
  // Its stress is not, and a file does without.
  test.run({"save flowed.vtu"});
  EXPECT_FALSE(test.document().stress_is_known());
  const std::string file = arrays_of(test, "flowed.vtu");
  EXPECT_THAT(file, HasSubstr("\"plastic_strain\""));
  EXPECT_THAT(file, Not(HasSubstr("\"stress\"")));
}

TEST(PlasticStrainField, IsZeroWhereNothingFlowsAndHasALegend) {
  TestSession test(box("plasticity yield 1e9", {"step 3", "save elastic.vtu"}));
  EXPECT_EQ(test.measure("plastic_strain_max"), 0);
  const ShownField field = shown_field(test.document(), "plastic_strain");
  EXPECT_EQ(field.title, "plastic strain");
  EXPECT_EQ(field.unit, "%");  // as strains are shown; files and measures have the number itself
  EXPECT_TRUE(field.values.isZero(0));
  EXPECT_THAT(arrays_of(test, "elastic.vtu"), HasSubstr("\"plastic_strain\""));
}

TEST(PlasticStrainField, IsOnlyWhereTheBodyYielded) {
  TestSession test({"new box 8 1 1 size 0.8 0.1 0.1", "levels 1", "set young_modulus 1e5", "set damping 20",
                    "plasticity yield 1500", "pin where x < 0.001", "gravity 0 0 -4", "step 60"});
  EXPECT_GT(test.measure("plastic_strain_max where x < 0.15"), 0.001) << "at its root it bends";
  EXPECT_EQ(test.measure("plastic_strain_max where x > 0.6"), 0) << "its end carries nothing";
}

}  // namespace
}  // namespace argil::sculpt
