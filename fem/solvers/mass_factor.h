#pragma once
// The consistent mass in the control points, factored: what explicit methods solve with at every step. One number a
// pair of control points serves the three axes.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>
#include <vector>

namespace argil::fem {

class MassFactor {
 public:
  /// Sparse Cholesky of `matrix` (symmetric, control points x control points) in the control points that are
  /// `free`. A mode that no element sees (a lone hexahedron's checkerboard, METHODS §1) is kept still by a share of
  /// 1e-10 of the diagonal. @throws Error (bad_input) if the matrix is not positive definite even then.
  MassFactor(const Eigen::SparseMatrix<double>& matrix, const std::vector<std::uint8_t>& free);
  ~MassFactor();
  MassFactor(MassFactor&&) noexcept;
  MassFactor& operator=(MassFactor&&) noexcept;

  /// matrix⁻¹ · values in the free control points, zero elsewhere; 3 x control points.
  [[nodiscard]] Eigen::Matrix3Xd solve(const Eigen::Matrix3Xd& values) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace argil::fem
