#include "fem/measure/stress.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fem/measure/recovery.h"
#include "fem/measure/strain.h"
#include "fem/parallel.h"

namespace argil::fem {

namespace {

Eigen::Vector3d corotational(const Eigen::Vector3d& s, double mu, double lambda) {
  const double pressure = lambda * ((s[0] - 1) + (s[1] - 1) + (s[2] - 1));
  return {2 * mu * (s[0] - 1) + pressure, 2 * mu * (s[1] - 1) + pressure, 2 * mu * (s[2] - 1) + pressure};
}

Eigen::Vector3d stable_neo_hookean(const Eigen::Vector3d& s, double mu, double lambda) {
  const double mu_s = 4 * mu / 3, lambda_s = lambda + 5 * mu / 6;
  const double alpha = 1 + mu_s / lambda_s - mu_s / (4 * lambda_s);
  const double shear = mu_s * (1 - 1 / (1 + s[0] * s[0] + s[1] * s[1] + s[2] * s[2]));
  const double volume = lambda_s * (s[0] * s[1] * s[2] - alpha);
  return {shear * s[0] + volume * s[1] * s[2], shear * s[1] + volume * s[2] * s[0],
          shear * s[2] + volume * s[0] * s[1]};
}

Eigen::Vector3d st_venant_kirchhoff(const Eigen::Vector3d& s, double mu, double lambda) {
  const Eigen::Vector3d green{0.5 * (s[0] * s[0] - 1), 0.5 * (s[1] * s[1] - 1), 0.5 * (s[2] * s[2] - 1)};
  const double pressure = lambda * (green[0] + green[1] + green[2]);
  return {s[0] * (2 * mu * green[0] + pressure), s[1] * (2 * mu * green[1] + pressure),
          s[2] * (2 * mu * green[2] + pressure)};
}

/// Ψ of laws/neo_hookean_law.h by the principal stretches, continued below J = 0.1 as there.
Eigen::Vector3d neo_hookean(const Eigen::Vector3d& s, double mu, double lambda) {
  constexpr double k_least_volume = 0.1;
  const double j = s[0] * s[1] * s[2], at = std::max(j, k_least_volume), below = j - at;
  const double whole = 1 / std::cbrt(at * at), slope = -2.0 / 3 * whole / at, factor = whole + below * slope;
  const double barrier_slope = 6 * below / (k_least_volume * k_least_volume);
  const double square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
  const double volume = 0.5 * mu * (slope * square + barrier_slope) + (lambda + 2.0 / 3 * mu) * (j - 1);
  return {mu * factor * s[0] + volume * s[1] * s[2], mu * factor * s[1] + volume * s[2] * s[0],
          mu * factor * s[2] + volume * s[0] * s[1]};
}

}  // namespace

StressLaw stress_law(std::string_view model) {
  if (model == "stable_neo_hookean") return stable_neo_hookean;
  if (model == "st_venant_kirchhoff") return st_venant_kirchhoff;
  if (model == "neo_hookean") return neo_hookean;
  return corotational;
}

Eigen::Matrix3Xd principal_stresses(const ElementBlock& block, const Eigen::Matrix3Xd& nodes, StressLaw law) {
  Eigen::Matrix3Xd result = principal_stretches(block, nodes);
  parallel_for(static_cast<std::size_t>(result.cols()), 1024, [&](std::size_t i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Eigen::Vector3d stretches = result.col(column);
    Eigen::Vector3d stresses = law(stretches, block.mu[i], block.lambda[i]);
    if (!block.prestress.empty()) stresses += block.prestress[i] * stretches;
    result.col(column) = stresses;
  });
  return result;
}

Eigen::VectorXd von_mises_stress(const ElementBlock& block, const Eigen::Matrix3Xd& nodes, StressLaw law) {
  const Eigen::Matrix3Xd stresses = principal_stresses(block, nodes, law ? law : corotational);
  Eigen::VectorXd result(stresses.cols());
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    // 3/2 |s|² by differences: |s|² = Σ (T_j − T_k)²/3.
    const double a = stresses(0, i) - stresses(1, i), b = stresses(1, i) - stresses(2, i),
                 c = stresses(2, i) - stresses(0, i);
    result[i] = std::sqrt(0.5 * (a * a + b * b + c * c));
  }
  return result;
}

Eigen::VectorXd von_mises_stress(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes,
                                 StressLaw law) {
  std::vector<Eigen::VectorXd> values;
  for (const ElementBlock& block : blocks) values.push_back(von_mises_stress(block, nodes, law));
  return recover_at_nodes(blocks, values, static_cast<std::size_t>(nodes.cols()));
}

}  // namespace argil::fem
