#pragma once
// Sparse Cholesky factor of a symmetric positive definite matrix: supernodal by CHOLMOD where the program was built
// with it (and a serial BLAS, so that the bits are the same in every run), else Eigen's simplicial one, which is
// slow beyond a few thousand unknowns (METHODS §8).

#include <Eigen/SparseCore>
#include <memory>

namespace argil::fem {

class SymmetricFactor {
 public:
  SymmetricFactor();
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// Whether this build has CHOLMOD.
  [[nodiscard]] static bool is_supernodal();
  /// `matrix` holds at least its lower triangle, which is what is read. False if it is not positive definite.
  [[nodiscard]] bool compute(const Eigen::SparseMatrix<double>& matrix);
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace argil::fem
