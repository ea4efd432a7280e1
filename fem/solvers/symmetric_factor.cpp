#include "fem/solvers/symmetric_factor.h"

#ifdef ARGIL_HAS_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

namespace argil::fem {

struct SymmetricFactor::Factor {
#ifdef ARGIL_HAS_CHOLMOD
  Factor() {
    cholesky.cholmod().print = 0;
  }
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky;
#else
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky;
#endif
};

SymmetricFactor::SymmetricFactor() : factor_(std::make_unique<Factor>()) {}
SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

bool SymmetricFactor::is_supernodal() {
#ifdef ARGIL_HAS_CHOLMOD
  return true;
#else
  return false;
#endif
}

bool SymmetricFactor::compute(const Eigen::SparseMatrix<double>& matrix) {
  factor_->cholesky.compute(matrix);
  return factor_->cholesky.info() == Eigen::Success;
}

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  return factor_->cholesky.solve(right_hand_sides);
}

}  // namespace argil::fem
