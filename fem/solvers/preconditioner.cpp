#include "fem/solvers/preconditioner.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "fem/solvers/rest_operator.h"
#include "fem/solvers/supernodal.h"

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

class FactorPreconditioner : public Preconditioner {
 public:
  FactorPreconditioner(const RestOperator& rest, const Eigen::SparseMatrix<double>& inertia,
                       const std::vector<AnchorSpring>& springs, const std::vector<std::uint8_t>& free)
      : number_from_point_(free.size(), -1) {
    for (std::size_t i = 0; i < free.size(); ++i) {
      if (!free[i]) continue;
      number_from_point_[i] = static_cast<Eigen::Index>(free_points_.size());
      free_points_.push_back(static_cast<Eigen::Index>(i));
    }
    factor_.compute(matrix(rest, inertia, springs));
  }
  bool succeeded() const { return factor_.info() == Eigen::Success; }
  PreconditionerKind kind() const override { return PreconditionerKind::factor; }
  void apply(const Eigen::Matrix3Xd& r, Eigen::Matrix3Xd& z) const override {
    Eigen::VectorXd values(size());
    for (std::size_t k = 0; k < free_points_.size(); ++k)
      values.segment<3>(3 * static_cast<Eigen::Index>(k)) = r.col(free_points_[k]);
    factor_.solveInPlace(values);
    z.setZero(3, r.cols());
    for (std::size_t k = 0; k < free_points_.size(); ++k)
      z.col(free_points_[k]) = values.segment<3>(3 * static_cast<Eigen::Index>(k));
  }

 private:
  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(free_points_.size()); }

  /// S₀ of the free control points, lower triangle.
  Eigen::MatrixXd matrix(const RestOperator& rest, const Eigen::SparseMatrix<double>& inertia,
                         const std::vector<AnchorSpring>& springs) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size(), size());
    const auto add = [&](Eigen::Index i, Eigen::Index j, Eigen::Index r, Eigen::Index s, double value) {
      const Eigen::Index a = number_from_point_[static_cast<std::size_t>(i)],
                         b = number_from_point_[static_cast<std::size_t>(j)];
      if (a >= 0 && b >= 0) result(3 * a + r, 3 * b + s) += value;
    };
    for (Eigen::Index column = 0; column < rest.stiffness.outerSize(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(rest.stiffness, column); it; ++it)
        add(it.row() / 3, column / 3, it.row() % 3, column % 3, it.value());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (Eigen::Index column = 0; column < inertia.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator it(inertia, column); it; ++it)
          add(it.row(), column, axis, axis, it.value());
      for (const AnchorSpring& spring : springs)
        for (std::size_t e = 0; e < spring.control_points.size(); ++e)
          for (std::size_t g = 0; g < spring.control_points.size(); ++g)
            add(spring.control_points[e], spring.control_points[g], axis, axis,
                spring.stiffness * spring.weights[e] * spring.weights[g]);
    }
    result.diagonal() *= 1 + k_diagonal_shift;
    return result;
  }

  std::vector<Eigen::Index> free_points_, number_from_point_;
  Eigen::LLT<Eigen::MatrixXd> factor_;  // reads the lower triangle only
};

}  // namespace

std::string_view word(PreconditionerKind kind) {
  switch (kind) {
    case PreconditionerKind::factor:
      return "factor";
    case PreconditionerKind::jacobi:
      return "jacobi";
    case PreconditionerKind::supernodal:
      return "supernodal";
    case PreconditionerKind::none:
      return "none";
  }
  return "";
}

std::unique_ptr<Preconditioner> make_preconditioner(PreconditionerKind kind, const RestOperator& rest,
                                                    const Eigen::SparseMatrix<double>& inertia,
                                                    const std::vector<AnchorSpring>& springs,
                                                    const std::vector<std::uint8_t>& free) {
  if (kind == PreconditionerKind::factor) {
    auto factor = std::make_unique<FactorPreconditioner>(rest, inertia, springs, free);
    if (factor->succeeded()) return factor;
  }
  if (kind == PreconditionerKind::supernodal)
    if (auto factor = make_supernodal(rest, inertia, free)) return factor;
  return std::make_unique<JacobiPreconditioner>(rest, inertia, springs, free);
}

}  // namespace argil::fem
