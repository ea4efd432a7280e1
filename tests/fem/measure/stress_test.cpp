#include "fem/measure/stress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace argil::fem {
namespace {

using Density = std::function<double(const Eigen::Vector3d&)>;

constexpr double k_mu = 3e4, k_lambda = 7e4;

// METHODS §4, in principal stretches.
double corotational(const Eigen::Vector3d& s) {
  const Eigen::Vector3d e = s.array() - 1;
  return k_mu * e.squaredNorm() + 0.5 * k_lambda * e.sum() * e.sum();
}
double neo_hookean(const Eigen::Vector3d& s) {
  const double mu = 4 * k_mu / 3, lambda = k_lambda + 5 * k_mu / 6, alpha = 1 + mu / lambda - mu / (4 * lambda);
  const double square = s.squaredNorm(), change = s.prod() - alpha;
  return mu / 2 * (square - 3) + lambda / 2 * change * change - mu / 2 * std::log(square + 1);
}
double st_venant_kirchhoff(const Eigen::Vector3d& s) {
  const Eigen::Vector3d e = 0.5 * (s.array().square() - 1);
  return k_mu * e.squaredNorm() + 0.5 * k_lambda * e.sum() * e.sum();
}

double isochoric_neo_hookean(const Eigen::Vector3d& s) {
  const double bulk = k_lambda + 2 * k_mu / 3, j = s.prod(), square = s.squaredNorm(), change = j - 1;
  double factor = std::pow(j, -2.0 / 3), barrier = 0;
  if (j < 0.1) {
    const double d = j / 0.1 - 1;
    factor = std::pow(0.1, -2.0 / 3) * (1 - 2 * d / 3);
    barrier = 3 * d * d;
  }
  return k_mu / 2 * (factor * square - 3 + barrier) + bulk / 2 * change * change;
}

TEST(StressLaw, IsTheDerivativeOfTheEnergyByEachStretch) {
  const std::pair<const char*, Density> laws[] = {{"corotational", corotational},
                                                  {"linear", corotational},
                                                  {"stable_neo_hookean", neo_hookean},
                                                  {"st_venant_kirchhoff", st_venant_kirchhoff},
                                                  {"neo_hookean", isochoric_neo_hookean}};
  for (const auto& [name, density] : laws)
    for (const Eigen::Vector3d& stretches :
         {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1.4, 1.1, 0.7), Eigen::Vector3d(2, 0.9, -0.3)}) {
      const Eigen::Vector3d found = stress_law(name)(stretches, k_mu, k_lambda);
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double h = 1e-5;
        Eigen::Vector3d more = stretches, less = stretches;
        more[i] += h;
        less[i] -= h;
        // Central differences: h² times third derivatives of the order of the moduli, and rounding over h.
        EXPECT_NEAR(found[i], (density(more) - density(less)) / (2 * h), 1e-7 * k_lambda * 10) << name << ' ' << i;
      }
    }
}

TEST(StressLaw, OfEveryModelIsHookesAtSmallStrain) {
  const Eigen::Vector3d strain(2e-7, -1e-7, 3e-7);
  const Eigen::Vector3d hooke = (2 * k_mu * strain).array() + k_lambda * strain.sum();
  for (const char* name :
       {"corotational", "stable_neo_hookean", "neo_hookean", "st_venant_kirchhoff", "mass_spring"})
    EXPECT_LT((stress_law(name)(strain.array() + 1, k_mu, k_lambda) - hooke).norm(), 1e-5 * hooke.norm()) << name;
}

}  // namespace
}  // namespace argil::fem
