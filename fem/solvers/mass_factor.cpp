#include "fem/solvers/mass_factor.h"

#include <Eigen/SparseCholesky>

#include "subdiv/error.h"

namespace argil::fem {

namespace {
constexpr double k_diagonal_shift = 1e-10;
}

struct MassFactor::Impl {
  std::vector<Eigen::Index> free_points;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor;
};

MassFactor::MassFactor(const Eigen::SparseMatrix<double>& matrix, const std::vector<std::uint8_t>& free)
    : impl_(std::make_unique<Impl>()) {
  std::vector<Eigen::Index> number(free.size(), -1);
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (!free[i]) continue;
    number[i] = static_cast<Eigen::Index>(impl_->free_points.size());
    impl_->free_points.push_back(static_cast<Eigen::Index>(i));
  }
  if (impl_->free_points.empty()) return;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(matrix.nonZeros()));
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
      const Eigen::Index a = number[static_cast<std::size_t>(it.row())],
                         b = number[static_cast<std::size_t>(column)];
      if (a >= 0 && b >= 0) entries.emplace_back(a, b, a == b ? (1 + k_diagonal_shift) * it.value() : it.value());
    }
  const auto size = static_cast<Eigen::Index>(impl_->free_points.size());
  Eigen::SparseMatrix<double> reduced(size, size);
  reduced.setFromTriplets(entries.begin(), entries.end());
  impl_->factor.compute(reduced);
  if (impl_->factor.info() != Eigen::Success)
    throw Error(ErrorCode::bad_input,
                "The mass of the body has no Cholesky factor, as an explicit step needs it: some control point "
                "carries no mass. Raise the density where it is very small, or take an implicit integrator.");
}
MassFactor::~MassFactor() = default;
MassFactor::MassFactor(MassFactor&&) noexcept = default;
MassFactor& MassFactor::operator=(MassFactor&&) noexcept = default;

Eigen::Matrix3Xd MassFactor::solve(const Eigen::Matrix3Xd& values) const {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, values.cols());
  if (impl_->free_points.empty()) return result;
  const auto size = static_cast<Eigen::Index>(impl_->free_points.size());
  Eigen::MatrixX3d right(size, 3);
  for (Eigen::Index k = 0; k < size; ++k)
    right.row(k) = values.col(impl_->free_points[static_cast<std::size_t>(k)]).transpose();
  const Eigen::MatrixX3d solved = impl_->factor.solve(right);
  for (Eigen::Index k = 0; k < size; ++k)
    result.col(impl_->free_points[static_cast<std::size_t>(k)]) = solved.row(k).transpose();
  return result;
}

}  // namespace argil::fem
