// What REFERENCES gives besides the quantity that the chart measures: rotations of the loaded end and the axial
// force of the twist, by quadratic tetrahedra with the law of the references.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cstdio>
#include <numbers>

#include "tests/tools/chart/runs.h"

namespace argil::chart {
namespace {

using Eigen::Vector3d;

/// What a measure finds in the run of a problem, which the chart's row does not hold.
std::vector<double> found_in(Problem problem, const std::string& in_space, int resolution,
                             const std::function<std::vector<double>(const Body&, const fem::Loads&)>& measure) {
  std::vector<double> found;
  problem.measure = [&](const Body& body, const fem::Loads& loads) { return found = measure(body, loads); };
  problem.reference = [&](double) { return found; };
  test::run(problem, "st_venant_kirchhoff", in_space, resolution);
  return found;
}

/// By which the nodes of the face x = 1 have turned about y in the mean (least squares) [degrees], down positive.
double end_rotation(const Body& body) {
  const Eigen::Matrix3Xd& rest = body.discretization.rest_nodes;
  const Eigen::Matrix3Xd x = fem::nodes(body.system, body.state.positions);
  std::vector<Eigen::Index> face;
  for (Eigen::Index n = 0; n < rest.cols(); ++n)
    if (rest(0, n) > 1 - 1e-9) face.push_back(n);
  const Eigen::Matrix3Xd from = rest(Eigen::all, face), to = x(Eigen::all, face);
  const Vector3d from_middle = from.rowwise().mean(), to_middle = to.rowwise().mean();
  const Eigen::Matrix3d product = (to.colwise() - to_middle) * (from.colwise() - from_middle).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  const Eigen::Matrix3d turn = u * svd.matrixV().transpose();
  return std::atan2(-turn(2, 0), turn(0, 0)) * 180 / std::numbers::pi;
}

TEST(ReferencesSlow, TipLoadsTurnTheEndAsTheyShould) {
  // REFERENCES §2. One cell through the thickness: at ν = 0 that gives the reference to 0.2 %; at ν = 0.3 the
  // clamped edges, whose limit is extrapolated, leave 0.4 % of the angles and 0.7 % of the displacements.
  const struct {
    const char* name;
    double poisson_ratio, x, z, degrees;
    double digit;  // half of the last printed one of x and z
  } cases[] = {
      {"tip_load_5", 0, -0.00205, -0.05848, 5.005, 5e-6},  {"tip_load_45", 0, -0.16335, -0.49779, 44.90, 5e-6},
      {"tip_load_80", 0, -0.54338, -0.81234, 80.54, 5e-6}, {"tip_load_5", 0.3, -0.0020, -0.0582, 4.98, 5e-5},
      {"tip_load_45", 0.3, -0.1622, -0.4961, 44.75, 5e-5}, {"tip_load_80", 0.3, -0.5412, -0.8115, 80.45, 5e-5}};
  for (const auto& c : cases) {
    Problem problem = problem_by_name(c.name);
    problem.material.poisson_ratio = c.poisson_ratio;
    const std::vector<double> found = found_in(problem, "tetrahedra", 1, [](const Body& body, const fem::Loads&) {
      const Vector3d u = displacement(body, {1, 0.05, 0.05});
      return std::vector<double>{u.x(), u.z(), end_rotation(body)};
    });
    ASSERT_EQ(found.size(), 3U);
    std::printf("%s, nu %.1f: %.5f %.5f m, %.3f degrees\n", c.name, c.poisson_ratio, found[0], found[1], found[2]);
    const double length = c.poisson_ratio == 0 ? 0.002 : 0.008, angle = c.poisson_ratio == 0 ? 0.001 : 0.005;
    EXPECT_NEAR(found[0], c.x, -length * c.x + c.digit) << c.name;
    EXPECT_NEAR(found[1], c.z, -length * c.z + c.digit) << c.name;
    EXPECT_NEAR(found[2], c.degrees, angle * c.degrees) << c.name;
  }
}

TEST(ReferencesSlow, TwistPullsItsGripsTogether) {
  // REFERENCES §3, two cells through the thickness: half a percent of the force.
  for (const auto& [name, force] : {std::pair{"twist_90", 8.03}, std::pair{"twist_180", 29.6}}) {
    const std::vector<double> found =
        found_in(problem_by_name(name), "tetrahedra", 2, [](const Body& body, const fem::Loads& loads) {
          const Eigen::Matrix3Xd reaction = fem::reactions(body.system, loads, body.state.positions);
          double pull = 0;
          for (Eigen::Index i = 0; i < reaction.cols(); ++i)
            if (body.rest(0, i) > 0.4 - 1e-9) pull += reaction(0, i);
          return std::vector<double>{pull};
        });
    ASSERT_EQ(found.size(), 1U);
    std::printf("%s: %.4f N along the axis\n", name, found[0]);
    EXPECT_NEAR(found[0], force, 0.005 * force) << name;
  }
}

}  // namespace
}  // namespace argil::chart
