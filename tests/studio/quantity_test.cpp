#include "tools/studio/quantity.h"

#include <gtest/gtest.h>

#include "subdiv/error.h"

namespace argil::studio {
namespace {

TEST(Quantity, TakesUnitsAndArithmetic) {
  EXPECT_DOUBLE_EQ(parse_quantity("2 mm", "m", "m"), 0.002);
  EXPECT_DOUBLE_EQ(parse_quantity("1/3", "m", "m"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(parse_quantity("1/3", "m", "mm"), 1e-3 / 3);  // in the unit that stood there
  EXPECT_DOUBLE_EQ(parse_quantity("2 mm + 1 cm", "m", "m"), 0.012);
  EXPECT_DOUBLE_EQ(parse_quantity("3/100 MPa", "Pa", "Pa"), 3e4);
  EXPECT_DOUBLE_EQ(parse_quantity("2 mm * 3", "m", "m"), 0.006);
  EXPECT_DOUBLE_EQ(parse_quantity("(3 + 0.5) kPa", "Pa", "Pa"), 3500);
  EXPECT_DOUBLE_EQ(parse_quantity("-2^2", "", ""), -4);
  EXPECT_DOUBLE_EQ(parse_quantity("1.2 g/cm³", "kg/m^3", "kg/m³"), 1200);
  EXPECT_DOUBLE_EQ(parse_quantity("2e5", "Pa", "Pa"), 2e5);
}

TEST(Quantity, RefusesWhatIsNone) {
  for (const char* wrong : {"", "two", "1 +", "2 kg", "(1", "1/0", "nan", "3 3"})
    EXPECT_THROW((void)parse_quantity(wrong, "m", "m"), Error) << wrong;
}

TEST(Quantity, ShowsThreeDigitsInAPrefixThatKeepsThemShort) {
  const auto words = [](double value, const char* unit) {
    const Quantity q = shown(value, unit);
    return q.number + ' ' + q.unit;
  };
  EXPECT_EQ(words(0.15, "m"), "0.15 m");
  EXPECT_EQ(words(0.002, "m"), "2 mm");
  EXPECT_EQ(words(2e5, "Pa"), "200 kPa");
  EXPECT_EQ(words(412.4, "N/m"), "412 N/m");
  EXPECT_EQ(words(0, "Pa"), "0 Pa");
  EXPECT_EQ(words(-9.81, "m/s²"), "-9.81 m/s²");
}

TEST(Quantity, WhatIsShownForEditingReadsBack) {
  for (const double value : {0.15, 1.0 / 3, 2e5, 1e-5, 12345.678})
    EXPECT_NEAR(parse_quantity(editable(value, "Pa"), "Pa", shown(value, "Pa").unit), value, 1e-9 * value);
}

}  // namespace
}  // namespace argil::studio
