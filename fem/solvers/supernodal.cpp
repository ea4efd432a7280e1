#include "fem/solvers/supernodal.h"

#include <Eigen/SparseCore>

#include "fem/solvers/rest_operator.h"

#ifdef ARGIL_HAS_CHOLMOD
#include <cholmod.h>
#endif

namespace argil::fem {

#ifdef ARGIL_HAS_CHOLMOD

namespace {

constexpr double k_diagonal_shift = 1e-10;  // as in the dense factor

class Supernodal : public Preconditioner {
 public:
  Supernodal(const RestOperator& rest, const Eigen::SparseMatrix<double>& inertia,
             const std::vector<std::uint8_t>& free) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.quick_return_if_not_posdef = 1;
    std::vector<Eigen::Index> number(free.size(), -1);
    for (std::size_t i = 0; i < free.size(); ++i) {
      if (!free[i]) continue;
      number[i] = static_cast<Eigen::Index>(free_points_.size());
      free_points_.push_back(static_cast<Eigen::Index>(i));
    }
    factor_matrix(lower_triangle(rest, inertia, number));
    right_ = cholmod_allocate_dense(size(), 1, size(), CHOLMOD_REAL, &common_);
  }
  ~Supernodal() override {
    cholmod_free_factor(&factor_, &common_);
    for (cholmod_dense** dense : {&right_, &solution_, &work_, &more_work_}) cholmod_free_dense(dense, &common_);
    cholmod_finish(&common_);
  }
  Supernodal(const Supernodal&) = delete;
  Supernodal& operator=(const Supernodal&) = delete;

  bool succeeded() const { return succeeded_; }
  PreconditionerKind kind() const override { return PreconditionerKind::supernodal; }
  void apply(const Eigen::Matrix3Xd& r, Eigen::Matrix3Xd& z) const override {
    double* values = static_cast<double*>(right_->x);
    for (std::size_t k = 0; k < free_points_.size(); ++k)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        values[3 * k + static_cast<std::size_t>(axis)] = r(axis, free_points_[k]);
    cholmod_solve2(CHOLMOD_A, factor_, right_, nullptr, &solution_, nullptr, &work_, &more_work_, &common_);
    const double* solved = static_cast<const double*>(solution_->x);
    z.setZero(3, r.cols());
    for (std::size_t k = 0; k < free_points_.size(); ++k)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        z(axis, free_points_[k]) = solved[3 * k + static_cast<std::size_t>(axis)];
  }

 private:
  std::size_t size() const { return 3 * free_points_.size(); }

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
    const auto n = static_cast<Eigen::Index>(size());
    Eigen::SparseMatrix<double> result(n, n);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  void factor_matrix(Eigen::SparseMatrix<double> lower) {
    cholmod_sparse view{};
    view.nrow = view.ncol = size();
    view.nzmax = static_cast<std::size_t>(lower.nonZeros());
    view.p = lower.outerIndexPtr();
    view.i = lower.innerIndexPtr();
    view.x = lower.valuePtr();
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    factor_ = cholmod_analyze(&view, &common_);
    if (!factor_) return;
    cholmod_factorize(&view, factor_, &common_);
    succeeded_ = common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  std::vector<Eigen::Index> free_points_;
  mutable cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  bool succeeded_ = false;
  mutable cholmod_dense *right_ = nullptr, *solution_ = nullptr, *work_ = nullptr, *more_work_ = nullptr;
};

}  // namespace

bool has_supernodal() {
  return true;
}

std::unique_ptr<Preconditioner> make_supernodal(const RestOperator& rest,
                                                const Eigen::SparseMatrix<double>& inertia,
                                                const std::vector<std::uint8_t>& free) {
  auto result = std::make_unique<Supernodal>(rest, inertia, free);
  if (!result->succeeded()) return nullptr;
  return result;
}

#else

bool has_supernodal() {
  return false;
}

std::unique_ptr<Preconditioner> make_supernodal(const RestOperator&, const Eigen::SparseMatrix<double>&,
                                                const std::vector<std::uint8_t>&) {
  return nullptr;
}

#endif

}  // namespace argil::fem
