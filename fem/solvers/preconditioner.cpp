#include "fem/solvers/preconditioner.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include "fem/solvers/rest_operator.h"

namespace argil::fem {

namespace {

/// Control modes that no element sees (a lone hexahedron's checkerboard, METHODS §1) leave S₀ singular; this share
/// of its diagonal makes it definite without being felt elsewhere.
constexpr double k_diagonal_shift = 1e-10;

class JacobiPreconditioner : public Preconditioner {
 public:
  JacobiPreconditioner(const RestOperator& rest, const Eigen::SparseMatrix<double>& inertia,
                       const std::vector<AnchorSpring>& springs, const std::vector<std::uint8_t>& free)
      : inverses_(rest.diagonal) {
    for (std::size_t i = 0; i < inverses_.size() && inertia.size() > 0; ++i)
      inverses_[i].diagonal().array() += inertia.coeff(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
    for (const AnchorSpring& spring : springs)
      for (std::size_t e = 0; e < spring.control_points.size(); ++e)
        inverses_[spring.control_points[e]].diagonal().array() +=
            spring.stiffness * spring.weights[e] * spring.weights[e];
    for (std::size_t i = 0; i < inverses_.size(); ++i) {
      Eigen::Matrix3d& block = inverses_[i];
      const double size = block.trace();
      if (!free[i] || !(size > 0)) {
        block = free[i] ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : Eigen::Matrix3d(Eigen::Matrix3d::Zero());
        continue;
      }
      block.diagonal().array() += k_diagonal_shift * size;
      block = block.inverse().eval();
    }
  }
  PreconditionerKind kind() const override { return PreconditionerKind::jacobi; }
  void apply(const Eigen::Matrix3Xd& r, Eigen::Matrix3Xd& z) const override {
    z.resize(3, r.cols());
    for (Eigen::Index i = 0; i < r.cols(); ++i)
      z.col(i).noalias() = inverses_[static_cast<std::size_t>(i)] * r.col(i);
  }

 private:
  std::vector<Eigen::Matrix3d> inverses_;
};

/// S₀ of the free control points, lower triangle, numbered as `free_points` lists them.
Eigen::SparseMatrix<double> free_matrix(const RestOperator& rest, const Eigen::SparseMatrix<double>& inertia,
                                        const std::vector<AnchorSpring>& springs,
                                        const std::vector<int>& number_from_point, Eigen::Index size) {
  std::vector<Eigen::Triplet<double, int>> triplets;
  const auto add = [&](std::size_t i, std::size_t j, int r, int s, double value) {
    const int a = number_from_point[i], b = number_from_point[j];
    if (a < 0 || b < 0) return;
    const int row = 3 * a + r, column = 3 * b + s;
    if (row >= column) triplets.emplace_back(row, column, row == column ? (1 + k_diagonal_shift) * value : value);
  };
  for (Eigen::Index column = 0; column < rest.stiffness.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(rest.stiffness, column); it; ++it)
      add(static_cast<std::size_t>(it.row() / 3), static_cast<std::size_t>(column / 3),
          static_cast<int>(it.row() % 3), static_cast<int>(column % 3), it.value());
  for (Eigen::Index column = 0; column < inertia.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(inertia, column); it; ++it)
      for (int axis = 0; axis < 3; ++axis)
        add(static_cast<std::size_t>(it.row()), static_cast<std::size_t>(column), axis, axis, it.value());
  for (const AnchorSpring& spring : springs)
    for (std::size_t e = 0; e < spring.control_points.size(); ++e)
      for (std::size_t g = 0; g < spring.control_points.size(); ++g)
        for (int axis = 0; axis < 3; ++axis)
          add(spring.control_points[e], spring.control_points[g], axis, axis,
              spring.stiffness * spring.weights[e] * spring.weights[g]);
  Eigen::SparseMatrix<double> result(size, size);
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

class FactorPreconditioner : public Preconditioner {
 public:
  FactorPreconditioner(const RestOperator& rest, const Eigen::SparseMatrix<double>& inertia,
                       const std::vector<AnchorSpring>& springs, const std::vector<std::uint8_t>& free) {
    std::vector<int> number_from_point(free.size(), -1);
    for (std::size_t i = 0; i < free.size(); ++i) {
      if (!free[i]) continue;
      number_from_point[i] = static_cast<int>(free_points_.size());
      free_points_.push_back(static_cast<Eigen::Index>(i));
    }
    const auto size = 3 * static_cast<Eigen::Index>(free_points_.size());
    const auto matrix = free_matrix(rest, inertia, springs, number_from_point, size);
    dense_ = static_cast<std::size_t>(size) < k_largest_dense_factor;
    if (dense_) {
      dense_factor_.compute(Eigen::MatrixXd(matrix));
    } else {
      sparse_factor_.compute(matrix);
    }
  }
  bool succeeded() const { return (dense_ ? dense_factor_.info() : sparse_factor_.info()) == Eigen::Success; }
  PreconditionerKind kind() const override { return PreconditionerKind::factor; }
  void apply(const Eigen::Matrix3Xd& r, Eigen::Matrix3Xd& z) const override {
    Eigen::VectorXd values(3 * static_cast<Eigen::Index>(free_points_.size()));
    for (std::size_t k = 0; k < free_points_.size(); ++k)
      values.segment<3>(3 * static_cast<Eigen::Index>(k)) = r.col(free_points_[k]);
    if (dense_) {
      dense_factor_.solveInPlace(values);
    } else {
      values = sparse_factor_.solve(values).eval();
    }
    z.setZero(3, r.cols());
    for (std::size_t k = 0; k < free_points_.size(); ++k)
      z.col(free_points_[k]) = values.segment<3>(3 * static_cast<Eigen::Index>(k));
  }

 private:
  bool dense_ = false;
  std::vector<Eigen::Index> free_points_;
  Eigen::LLT<Eigen::MatrixXd> dense_factor_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> sparse_factor_;
};

}  // namespace

PreconditionerKind preconditioner_kind(std::size_t unknowns) {
  return unknowns <= k_largest_factor ? PreconditionerKind::factor : PreconditionerKind::jacobi;
}

std::unique_ptr<Preconditioner> make_preconditioner(PreconditionerKind kind, const RestOperator& rest,
                                                    const Eigen::SparseMatrix<double>& inertia,
                                                    const std::vector<AnchorSpring>& springs,
                                                    const std::vector<std::uint8_t>& free) {
  if (kind == PreconditionerKind::factor) {
    auto factor = std::make_unique<FactorPreconditioner>(rest, inertia, springs, free);
    if (factor->succeeded()) return factor;
  }
  return std::make_unique<JacobiPreconditioner>(rest, inertia, springs, free);
}

}  // namespace argil::fem
