// The rectangle of papers/001 §3.1: its constants as measured, whatever its shape and Poisson's ratio.

#include "fem/springs_2d.h"

#include <gtest/gtest.h>

#include <cmath>

#include "subdiv/error.h"

namespace argil::fem {
namespace {

// Central differences with steps of 1e-6: 1e-12 of truncation, 1e-10 of rounding.
constexpr double k_tolerance = 1e-8;

TEST(SpringRectangle, HasTheConstantsOfTheMaterialForEveryShape) {
  for (const double poisson : {-0.2, 0.0, 0.2, 0.3, 0.45, 0.9})
    for (const double ratio : {0.4, 1.0, 1.5, 3.0}) {
      const SpringRectangle r{0.1 * ratio, 0.1, 1000, poisson};
      const RectangleConstants found = measure(r);
      EXPECT_NEAR(found.young_along_length / 1000, 1, k_tolerance) << poisson << ' ' << ratio;
      EXPECT_NEAR(found.young_along_height / 1000, 1, k_tolerance) << poisson << ' ' << ratio;
      EXPECT_NEAR(found.poisson_along_length, poisson, k_tolerance);
      EXPECT_NEAR(found.poisson_along_height, poisson, k_tolerance);
      EXPECT_NEAR(found.shear_modulus * 2 * (1 + poisson) / 1000, 1, k_tolerance);
    }
}

TEST(SpringRectangle, NeedsNoCorrectionAtOneThirdOnly) {
  // Papers/001 names 0.3 as the value that springs alone can have; its F⊥ vanishes at 1/3.
  for (const double poisson : {0.0, 0.3, 1.0 / 3, 0.45}) {
    const RectangleConstants found = measure({0.1, 0.1, 1000, poisson, 0});
    const bool exact = std::abs(found.young_along_length / 1000 - 1) < k_tolerance &&
                       std::abs(found.poisson_along_length - poisson) < k_tolerance;
    EXPECT_EQ(exact, poisson == 1.0 / 3) << poisson;
    EXPECT_NEAR(found.shear_modulus * 2 * (1 + poisson) / 1000, 1, k_tolerance) << "diagonals alone shear";
  }
}

TEST(SpringRectangle, PrintedForceOnceANodeIsHalfOfWhatIsNeeded) {
  const auto poisson_with = [](double corrections) {
    return measure({0.1, 0.1, 1000, 0.1, corrections}).poisson_along_length;
  };
  const double none = poisson_with(0) - 0.1, once = poisson_with(1) - 0.1;
  EXPECT_GT(std::abs(none), 0.02);
  EXPECT_NEAR(once / none, 0.5, 0.06);  // not exactly: the response is not linear in the correction
}

TEST(SpringRectangle, KeepsItsForcesUnderTurnsAndInBalance) {
  const SpringRectangle r{0.15, 0.1, 1000, 0.2};
  RectangleNodes x = rest_nodes(r);
  x(0, 1) += 0.03;
  x(1, 2) -= 0.02;
  x(1, 3) += 0.01;
  const RectangleNodes f = forces(r, x);
  Eigen::Matrix2d turn;
  turn << std::cos(2.0), -std::sin(2.0), std::sin(2.0), std::cos(2.0);
  EXPECT_LE((forces(r, turn * x) - turn * f).norm(), 1e-13 * f.norm());
  EXPECT_LE(f.rowwise().sum().norm(), 1e-13 * f.norm());
  double moment = 0;
  for (int n = 0; n < 4; ++n) moment += x(0, n) * f(1, n) - x(1, n) * f(0, n);
  EXPECT_NEAR(moment, 0, 1e-14 * f.norm());
  EXPECT_EQ(forces(r, rest_nodes(r)).norm(), 0);
}

TEST(SpringRectangle, RefusesWhatIsNoRectangle) {
  EXPECT_THROW(static_cast<void>(rectangle_springs({0, 1, 1, 0.3})), Error);
  EXPECT_THROW(static_cast<void>(rectangle_springs({1, 1, -1, 0.3})), Error);
  EXPECT_THROW(static_cast<void>(rectangle_springs({1, 1, 1, 1.0})), Error);
}

}  // namespace
}  // namespace argil::fem
