// Frequencies against converged ones (REFERENCES §6), a dense solver and closed forms; the largest frequency
// against the figures of METHODS §5.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "fem/spectrum/largest_frequency.h"
#include "fem/spectrum/modes.h"
#include "subdiv/error.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem::test {
namespace {

constexpr Material k_bar_material{1e6, 0.3, 1000};
const std::vector<double> k_cantilever{.40872, .60863, 2.4886, 3.5863, 4.196, 6.6817};
const std::vector<double> k_free{2.5437, 3.7170, 6.7516, 8.339, 9.4899, 12.597};

/// Frequencies [Hz] of the bar of REFERENCES §6, in nx × 2 × 2 control cells refined once.
std::vector<double> bar_frequencies(int nx, int n, bool clamped, int count, Space space) {
  const double h = 1.0 / nx;
  SimulatedSolid solid(box(nx, n, n, {1.0, 0.08, 0.12}), 1, k_bar_material, {.space = space});
  if (clamped) solid.fix([&](const Eigen::Vector3d& x) { return x[0] < 1e-3 * h; });
  const Modes modes = lowest_modes(pencil(solid.system, {}, solid.rest), solid.system.rows->column_count, count);
  std::vector<double> result;
  for (std::size_t i = 0; i < modes.squares.size(); ++i) result.push_back(frequency(modes, i));
  return result;
}

double worst_error(const std::vector<double>& found, const std::vector<double>& expected, std::size_t skip) {
  double worst = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    worst = std::max(worst, std::abs(found[i + skip] / expected[i] - 1));
  return worst;
}

// Ritz values in a conforming space lie above the true ones, and errors of a square fall with h² (trilinear). The
// coarse torsion (one element across at first) is what the first bound leaves room for.
TEST(Modes, CantileverFallsToTheReferenceInTheDefaultSpace) {
  const auto coarse = bar_frequencies(16, 2, true, 6, Space::standard);
  const auto fine = bar_frequencies(32, 4, true, 6, Space::standard);
  for (std::size_t i = 0; i < k_cantilever.size(); ++i) {
    EXPECT_GT(fine[i], 0.9995 * k_cantilever[i]) << i;
    EXPECT_LT(fine[i], coarse[i]) << i;
  }
  EXPECT_LT(worst_error(coarse, k_cantilever, 0), 0.09);  // 0.0848: torsion
  EXPECT_LT(worst_error(fine, k_cantilever, 0), 0.016);   // 0.0147
}

TEST(Modes, FreeBarHasSixZerosAndFallsToTheReference) {
  const auto coarse = bar_frequencies(16, 2, false, 12, Space::standard);
  const auto fine = bar_frequencies(32, 4, false, 12, Space::standard);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(fine[i], 0) << i;
  for (std::size_t i = 0; i < k_free.size(); ++i) {
    EXPECT_GT(fine[i + 6], 0.9995 * k_free[i]) << i;
    EXPECT_LT(fine[i + 6], coarse[i + 6]) << i;
  }
  EXPECT_LT(worst_error(fine, k_free, 6), 0.016);  // 0.0141
}

// The same control points, but the bending modes are four to eight times nearer; the slight lack of continuity at
// the sides (METHODS §3) leaves no bound from below.
TEST(Modes, CubicSpaceIsNearerToTheReferenceWithTheSameUnknowns) {
  const auto plain = bar_frequencies(16, 2, true, 4, Space::standard);
  const auto cubic = bar_frequencies(16, 2, true, 4, Space::cubic);
  const auto free_cubic = bar_frequencies(16, 2, false, 8, Space::cubic);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT(std::abs(cubic[i] / k_cantilever[i] - 1), 0.55 * std::abs(plain[i] / k_cantilever[i] - 1)) << i;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(free_cubic[i], 0) << i;
  EXPECT_NEAR(free_cubic[6], k_free[0], 0.005 * k_free[0]);  // 2.553
  EXPECT_NEAR(free_cubic[7], k_free[1], 0.005 * k_free[1]);  // 3.7324
}

// A square section and a cube have multiple frequencies, which Lanczos from one vector loses. The dense solver is
// Eigen's own; 1e-9 of the largest found is what the residuals promise.
TEST(Modes, IterationFindsWhatTheDenseSolverFindsWithAllMultiplicities) {
  SimulatedSolid solid(box(4, 4, 4, {1, 1, 1}), 1, {1e4, 0.3, 100});
  const Pencil both = pencil(solid.system, {}, solid.rest);
  ASSERT_GT(both.mass.rows(), 300);  // so that it iterates
  const Modes modes = lowest_modes(both, solid.system.rows->column_count, 24);
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(both.stiffness).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd mass = Eigen::MatrixXd(both.mass).selfadjointView<Eigen::Lower>();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(stiffness, mass, Eigen::EigenvaluesOnly);
  for (std::size_t i = 0; i < 24; ++i)
    EXPECT_NEAR(modes.squares[i], dense.eigenvalues()[static_cast<Eigen::Index>(i)], 1e-9 * modes.squares[23]) << i;
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_LT(modes.residuals[i], 1e-6) << i;
    for (std::size_t j = 0; j <= i; ++j) {
      const Eigen::Matrix3Xd momentum = modes.shapes[j] * *solid.system.mass;
      EXPECT_NEAR(modes.shapes[i].cwiseProduct(momentum).sum(), i == j, 1e-9);
    }
  }
  // The largest one, by other means.
  const LargestFrequency largest = largest_frequency(solid.system, {}, solid.rest, 1e-8);
  EXPECT_NEAR(largest.value * largest.value, dense.eigenvalues()[dense.eigenvalues().size() - 1],
              1e-7 * largest.value * largest.value);
}

// A mass on a spring that everything hangs on: ω² = k/m of the rigid motion along each axis.
TEST(Modes, SoftSpringsAboutTheCentreGiveTheFrequenciesOfARigidBody) {
  SimulatedSolid solid(box(2, 2, 2, {1, 1, 1}), 1, {1e9, 0.3, 500});
  AnchorSpring spring;
  spring.stiffness = 300;
  spring.target = Eigen::Vector3d(0.5, 0.5, 0.5);
  for (std::uint32_t i = 0; i < 27; ++i) {
    spring.control_points.push_back(i);
    spring.weights.push_back(1.0 / 27);
  }
  const AnchorSpring springs[] = {spring};
  const Modes modes = lowest_modes(pencil(solid.system, springs, solid.rest), 27, 6);
  const double square = 300 / solid.discretization.total_mass;
  // Three rotations about the centre, which the spring does not feel, then three translations; the body is so stiff
  // that its own strain changes the square by 1e-6 of itself.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(frequency(modes, i), 0);
  for (std::size_t i = 3; i < 6; ++i) EXPECT_NEAR(modes.squares[i] / square, 1, 1e-4) << i;
}

// A slender bar that is pressed together beyond Euler's load bends out: its lowest square is below zero.
TEST(Modes, CompressedColumnIsUnstable) {
  SimulatedSolid solid(box(8, 1, 1, {1, 0.05, 0.05}), 1, {1e6, 0.0, 1000});
  solid.fix([](const Eigen::Vector3d& x) { return x[0] < 1e-9 || x[0] > 1 - 1e-9; });
  Eigen::Matrix3Xd pressed = solid.rest;
  pressed.row(0) *= 0.9;  // clamped ends: 4π² r²/L² = 0.0082 is the strain that it bears
  const Modes rest = lowest_modes(pencil(solid.system, {}, solid.rest), solid.system.rows->column_count, 2);
  EXPECT_GT(rest.squares[0], rest.rounding);
  const Modes modes = lowest_modes(pencil(solid.system, {}, pressed), solid.system.rows->column_count, 2);
  EXPECT_LT(modes.squares[0], -modes.rounding);
  EXPECT_LT(frequency(modes, 0), 0);
}

TEST(Modes, SayWhatIsWrong) {
  SimulatedSolid solid(box(1, 1, 1, {1, 1, 1}, false), 1);
  // A lone smooth hexahedron: A has rank 7 of 8 (METHODS §1).
  EXPECT_THROW(static_cast<void>(lowest_modes(pencil(solid.system, {}, solid.rest), 8, 3)), Error);
  EXPECT_THROW(static_cast<void>(largest_frequency(solid.system, {}, solid.rest)), Error);
  EXPECT_THROW(static_cast<void>(pencil(solid.system, {}, solid.rest, 1000.0)), Error);
  solid.fix([](const Eigen::Vector3d&) { return true; });
  EXPECT_THROW(static_cast<void>(pencil(solid.system, {}, solid.rest)), Error);
}

/// κ = ω_max² ρ h² / E of plain trilinear hexahedra, n a side.
double kappa(int n, double poisson_ratio) {
  SimulatedSolid solid(box(n, n, n, {1, 1, 1}), 0, {1, poisson_ratio, 1});
  const double value = largest_frequency(solid.system, {}, solid.rest).value;
  return value * value / (n * n);
}

// METHODS §5 with consistent mass: one free cell 30 and 600 exactly; four and more cells thick 26.7 and 365, which
// bodies approach from above and pass a little (27.17, 26.40 and 385, 369 at 4 and 6 cells).
TEST(LargestFrequency, IsThatOfMethods) {
  EXPECT_NEAR(kappa(1, 0.3), 30, 1e-5 * 30);
  EXPECT_NEAR(kappa(1, 0.49), 600, 1e-5 * 600);
  EXPECT_NEAR(kappa(4, 0.3), 26.7, 0.02 * 26.7);
  EXPECT_NEAR(kappa(6, 0.3), 26.7, 0.02 * 26.7);
  EXPECT_NEAR(kappa(4, 0.49), 365, 0.06 * 365);
  EXPECT_NEAR(kappa(6, 0.49), 365, 0.02 * 365);
}

}  // namespace
}  // namespace argil::fem::test
