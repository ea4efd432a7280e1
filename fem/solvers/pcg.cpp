#include "fem/solvers/pcg.h"

#include <algorithm>
#include <cmath>

namespace argil::fem {

namespace {

double dot(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cwiseProduct(b).sum();
}

}  // namespace

LinearOutcome pcg(const LinearOperator& matrix, const Preconditioner& preconditioner,
                  const Eigen::Matrix3Xd& right_hand_side, Eigen::Matrix3Xd& solution, double tolerance, int cap,
                  const Progress& progress) {
  LinearOutcome outcome;
  solution.setZero(3, right_hand_side.cols());
  const double start = right_hand_side.norm();
  if (start == 0) {
    outcome.converged = true;
    return outcome;
  }
  Eigen::Matrix3Xd residual = right_hand_side, preconditioned, product;
  preconditioner.apply(residual, preconditioned);
  Eigen::Matrix3Xd direction = preconditioned;
  double weighted = dot(residual, preconditioned);
  outcome.residual = 1;
  double digits = 0;  // of the residual, as a share of those asked for
  while (outcome.iterations < cap) {
    progress.at(digits);
    matrix(direction, product);
    ++outcome.iterations;
    const double curvature = dot(direction, product);
    if (!(curvature > 0)) {
      outcome.negative_curvature = true;
      if (outcome.iterations == 1) solution = direction;
      return outcome;
    }
    const double length = weighted / curvature;
    solution += length * direction;
    residual -= length * product;
    outcome.residual = residual.norm() / start;
    if (outcome.residual <= tolerance) {
      outcome.converged = true;
      return outcome;
    }
    digits = std::clamp(std::log(outcome.residual) / std::log(tolerance), digits, 1.0);
    preconditioner.apply(residual, preconditioned);
    const double next = dot(residual, preconditioned);
    direction = preconditioned + (next / weighted) * direction;
    weighted = next;
  }
  return outcome;
}

}  // namespace argil::fem
