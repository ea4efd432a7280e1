#include "fem/solvers/supernodal.h"

#include "fem/solvers/rest_operator.h"
#include "fem/solvers/symmetric_factor.h"

namespace argil::fem {

namespace {

constexpr double k_diagonal_shift = 1e-10;  // as in the dense factor

class Supernodal : public Preconditioner {
 public:
  Supernodal(const RestOperator& rest, const Eigen::SparseMatrix<double>& inertia,
             const std::vector<std::uint8_t>& free) {
    std::vector<Eigen::Index> number(free.size(), -1);
    for (std::size_t i = 0; i < free.size(); ++i) {
      if (!free[i]) continue;
      number[i] = static_cast<Eigen::Index>(free_points_.size());
      free_points_.push_back(static_cast<Eigen::Index>(i));
    }
    succeeded_ = factor_.compute(lower_triangle(rest, inertia, number));
  }

  bool succeeded() const { return succeeded_; }
  PreconditionerKind kind() const override { return PreconditionerKind::supernodal; }
  void apply(const Eigen::Matrix3Xd& r, Eigen::Matrix3Xd& z) const override {
    Eigen::MatrixXd right(size(), 1);
    Eigen::Index row = 0;
    for (const Eigen::Index point : free_points_)
      for (int axis = 0; axis < 3; ++axis) right(row++, 0) = r(axis, point);
    const Eigen::MatrixXd solved = factor_.solve(right);
    z.setZero(3, r.cols());
    row = 0;
    for (const Eigen::Index point : free_points_)
      for (int axis = 0; axis < 3; ++axis) z(axis, point) = solved(row++, 0);
  }

 private:
  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(free_points_.size()); }

  Eigen::SparseMatrix<double> lower_triangle(const RestOperator& rest, const Eigen::SparseMatrix<double>& inertia,
                                             const std::vector<Eigen::Index>& number) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(rest.stiffness.nonZeros() + 3 * inertia.nonZeros()));
    const auto add = [&](Eigen::Index i, Eigen::Index j, Eigen::Index r, Eigen::Index s, double value) {
      const Eigen::Index a = number[static_cast<std::size_t>(i)], b = number[static_cast<std::size_t>(j)];
      if (a < 0 || b < 0 || 3 * a + r < 3 * b + s) return;
      entries.emplace_back(3 * a + r, 3 * b + s, a == b && r == s ? (1 + k_diagonal_shift) * value : value);
    };
    for (Eigen::Index column = 0; column < rest.stiffness.outerSize(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(rest.stiffness, column); it; ++it)
        add(it.row() / 3, column / 3, it.row() % 3, column % 3, it.value());
    for (Eigen::Index column = 0; column < inertia.outerSize(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(inertia, column); it; ++it)
        for (Eigen::Index axis = 0; axis < 3; ++axis) add(it.row(), column, axis, axis, it.value());
    Eigen::SparseMatrix<double> result(size(), size());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  std::vector<Eigen::Index> free_points_;
  SymmetricFactor factor_;
  bool succeeded_ = false;
};

}  // namespace

bool has_supernodal() {
  return SymmetricFactor::is_supernodal();
}

std::unique_ptr<Preconditioner> make_supernodal(const RestOperator& rest,
                                                const Eigen::SparseMatrix<double>& inertia,
                                                const std::vector<std::uint8_t>& free) {
  if (!has_supernodal()) return nullptr;
  auto result = std::make_unique<Supernodal>(rest, inertia, free);
  if (!result->succeeded()) return nullptr;
  return result;
}

}  // namespace argil::fem
