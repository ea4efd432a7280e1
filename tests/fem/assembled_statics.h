#pragma once
// Static equilibrium of a model's own nodes by Newton's method on the assembled tangent, coordinates held one by
// one: a path to the answer that shares nothing with the integrators.

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <stdexcept>

#include "fem/models/force_model.h"

namespace argil::fem::test {

using Held = Eigen::Array<bool, 3, Eigen::Dynamic>;

inline Eigen::SparseMatrix<double> assemble(const Tangent& tangent, const Held& held) {
  std::vector<Eigen::Triplet<double>> entries;
  tangent.element_tangents([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
    for (Eigen::Index j = 0; j < stiffness.cols(); ++j)
      for (Eigen::Index i = 0; i < stiffness.rows(); ++i) {
        const std::uint32_t a = nodes[static_cast<std::size_t>(i / 3)], b = nodes[static_cast<std::size_t>(j / 3)];
        if (!held(i % 3, a) && !held(j % 3, b))
          entries.emplace_back(static_cast<int>(3 * a + i % 3), static_cast<int>(3 * b + j % 3), stiffness(i, j));
      }
  });
  for (Eigen::Index n = 0; n < held.cols(); ++n)
    for (Eigen::Index i = 0; i < 3; ++i)
      if (held(i, n)) entries.emplace_back(static_cast<int>(3 * n + i), static_cast<int>(3 * n + i), 1.0);
  Eigen::SparseMatrix<double> matrix(3 * held.cols(), 3 * held.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Equilibrium under `loads` from `start`, whose held coordinates stay. @throws std::runtime_error if 30 steps do
/// not reach 1e-9 of the largest force met.
inline Eigen::Matrix3Xd equilibrium(const ForceModel& model, const Held& held, const Eigen::Matrix3Xd& loads,
                                    Eigen::Matrix3Xd x) {
  Eigen::Matrix3Xd force;
  double scale = loads.cwiseAbs().maxCoeff();
  for (int step = 0; step < 30; ++step) {
    model.forces(x, force);
    scale = std::max(scale, force.cwiseAbs().maxCoeff());
    force += loads;
    for (Eigen::Index n = 0; n < x.cols(); ++n)
      for (Eigen::Index i = 0; i < 3; ++i)
        if (held(i, n)) force(i, n) = 0;
    if (step > 0 && force.cwiseAbs().maxCoeff() <= 1e-9 * scale) return x;
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(assemble(*model.tangent(x, Projection::none), held));
    if (factor.info() != Eigen::Success)
      factor.compute(assemble(*model.tangent(x, Projection::positive_semidefinite), held));
    const Eigen::VectorXd change = factor.solve(Eigen::Map<const Eigen::VectorXd>(force.data(), force.size()));
    x += Eigen::Map<const Eigen::Matrix3Xd>(change.data(), 3, x.cols());
  }
  throw std::runtime_error("no equilibrium");
}

}  // namespace argil::fem::test
