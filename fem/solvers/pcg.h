#pragma once
// Preconditioned conjugate gradients in the control points, matrix-free and in double precision. Sums run in one
// order, so the bits do not depend on the number of threads.

#include <Eigen/Core>
#include <functional>

#include "fem/solvers/preconditioner.h"
#include "subdiv/progress.h"

namespace argil::fem {

/// result = matrix * direction, 3 x control points; columns that are not free must come out zero.
using LinearOperator = std::function<void(const Eigen::Matrix3Xd& direction, Eigen::Matrix3Xd& result)>;

struct LinearOutcome {
  int iterations = 0;
  double residual = 0;  // relative to the right-hand side, 2-norm
  bool converged = false;
  bool negative_curvature = false;  // the matrix is not positive definite; the solution so far is returned
};

/// Solves matrix · solution = right_hand_side from zero, to a relative residual. At the first direction of
/// non-positive curvature it stops; if that is the first of all, the solution is the preconditioned right-hand
/// side. What is told is how many of the digits asked for are there.
[[nodiscard]] LinearOutcome pcg(const LinearOperator& matrix, const Preconditioner& preconditioner,
                                const Eigen::Matrix3Xd& right_hand_side, Eigen::Matrix3Xd& solution,
                                double tolerance, int cap, const Progress& progress = {});

}  // namespace argil::fem
