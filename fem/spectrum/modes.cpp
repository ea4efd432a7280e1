#include "fem/spectrum/modes.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fem/solvers/symmetric_factor.h"
#include "fem/spectrum/start_vectors.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index k_block = 8;
constexpr Index k_dense = 300;  // unknowns up to which all modes are found at once
constexpr int k_restarts = 300;

struct Ritz {
  VectorXd squares;
  MatrixXd vectors;
};

Ritz dense_modes(const Pencil& pencil, Index count) {
  const MatrixXd stiffness = MatrixXd(pencil.stiffness).selfadjointView<Eigen::Lower>();
  const MatrixXd mass = MatrixXd(pencil.mass).selfadjointView<Eigen::Lower>();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> all(stiffness, mass);
  return {all.eigenvalues().head(count), all.eigenvectors().leftCols(count)};
}

/// Grows a basis V, orthonormal in M̃, by T = (K̃ − σM̃)⁻¹ M̃ block after block, and keeps H = Vᵀ M̃ T V.
class BlockLanczos {
 public:
  BlockLanczos(const Pencil& pencil, const SymmetricFactor& shifted, Index capacity)
      : mass_(pencil.mass), shifted_(shifted), v_(pencil.mass.rows(), capacity + k_block), h_(capacity, capacity) {
    h_.setZero();
    MatrixXd start(v_.rows(), k_block);
    for (double& value : start.reshaped()) value = random_.next();
    append(start);
  }

  /// Fills the basis to its capacity.
  void expand() {
    while (done_ + k_block <= h_.cols()) {
      const MatrixXd right = mass_.selfadjointView<Eigen::Lower>() * v_.middleCols(done_, k_block);
      MatrixXd next = shifted_.solve(right);
      const MatrixXd mass_next = mass_.selfadjointView<Eigen::Lower>() * next;
      const MatrixXd h = v_.leftCols(size_).transpose() * mass_next;
      for (Index j = 0; j < k_block; ++j)
        for (Index i = 0; i < std::min(size_, h_.rows()); ++i) h_(i, done_ + j) = h_(done_ + j, i) = h(i, j);
      done_ += k_block;
      coupling_ = append(next);
    }
  }

  /// The best Ritz pairs of T, largest first, with the residuals of the vectors.
  void solve() {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(h_.topLeftCorner(done_, done_));
    values_ = ritz.eigenvalues().reverse();
    rotation_ = ritz.eigenvectors().rowwise().reverse();
  }
  double residual(Index i) const {
    return (coupling_ * rotation_.col(i).tail(k_block)).norm() / std::abs(values_[i]);
  }
  MatrixXd vectors(Index count) const { return v_.leftCols(done_) * rotation_.leftCols(count); }

  /// Keeps the best `kept` Ritz vectors and the block that comes next.
  void restart(Index kept) {
    const MatrixXd best = vectors(kept);
    const MatrixXd next = v_.middleCols(done_, k_block);
    v_.leftCols(kept) = best;
    v_.middleCols(kept, k_block) = next;
    size_ = kept + k_block;
    done_ = kept;
    h_.setZero();
    h_.topLeftCorner(kept, kept).diagonal() = values_.head(kept);
  }

 private:
  /// Makes `block` orthonormal to the basis and in itself, and appends it; a column that depends on the others
  /// gives way to a new one. Returns how the block is made of what was appended.
  MatrixXd append(MatrixXd block) {
    MatrixXd coefficients = MatrixXd::Zero(k_block, k_block);
    const Index begin = size_;
    for (Index j = 0; j < k_block; ++j) {
      VectorXd column = block.col(j);
      for (int attempt = 0;; ++attempt) {
        const double before = std::sqrt(std::max(0.0, inner(column, column)));
        for (int pass = 0; pass < 2; ++pass) {
          const VectorXd mass_column = mass_.selfadjointView<Eigen::Lower>() * column;
          const VectorXd h = v_.leftCols(size_).transpose() * mass_column;
          column.noalias() -= v_.leftCols(size_) * h;
          if (attempt == 0)
            for (Index i = begin; i < size_; ++i) coefficients(i - begin, j) += h[i];
        }
        const double after = std::sqrt(std::max(0.0, inner(column, column)));
        if (after > 1e-12 * before && after > 0) {
          if (attempt == 0) coefficients(j, j) = after;
          v_.col(size_++) = column / after;
          break;
        }
        for (double& value : column) value = random_.next();
      }
    }
    return coefficients;
  }
  double inner(const VectorXd& a, const VectorXd& b) const {
    return a.dot(mass_.selfadjointView<Eigen::Lower>() * b);
  }

  const Eigen::SparseMatrix<double>& mass_;
  const SymmetricFactor& shifted_;
  StartVectors random_;
  MatrixXd v_, h_;
  Index size_ = 0;  // columns of the basis
  Index done_ = 0;  // of which T has been applied to
  MatrixXd coupling_;
  VectorXd values_;
  MatrixXd rotation_;
};

Ritz iterated_modes(const Pencil& pencil, Index count, double mean_square, double tolerance) {
  SymmetricFactor factor;
  double shift = -1e-6 * mean_square;
  while (!factor.compute(pencil.stiffness - shift * pencil.mass)) {
    shift *= 8;
    if (!(-shift < 1e6 * mean_square))
      throw Error(ErrorCode::not_converged,
                  "the stiffness has no Cholesky factor, however far it is shifted; look for cells that are inside "
                  "out or for values that are not finite");
  }
  const Index size = pencil.mass.rows();
  const Index capacity = std::min(size / k_block, (2 * count + 5 * k_block) / k_block + 1) * k_block;
  const Index kept = std::min(count + k_block, capacity - k_block);
  BlockLanczos lanczos(pencil, factor, capacity);
  for (int restart = 0; restart < k_restarts; ++restart) {
    lanczos.expand();
    lanczos.solve();
    Index converged = 0;
    while (converged < count && lanczos.residual(converged) <= tolerance) ++converged;
    if (converged == count) {
      Ritz result;
      result.vectors = lanczos.vectors(count);
      result.squares.resize(count);
      for (Index i = 0; i < count; ++i) {
        const VectorXd v = result.vectors.col(i);
        result.squares[i] = v.dot(pencil.stiffness.selfadjointView<Eigen::Lower>() * v) /
                            v.dot(pencil.mass.selfadjointView<Eigen::Lower>() * v);
      }
      return result;
    }
    lanczos.restart(kept);
  }
  throw Error(ErrorCode::not_converged,
              fmt::format("{} modes were not found in {} restarts; ask for fewer, or lower the contrast of the "
                          "stiffness",
                          count, k_restarts));
}

}  // namespace

Modes lowest_modes(const Pencil& pencil, std::size_t control_point_count, int count, double tolerance) {
  if (count < 1) throw Error(ErrorCode::bad_input, fmt::format("expected at least 1 mode, found {}", count));
  const Index size = pencil.mass.rows();
  const Index wanted = std::min<Index>(count, size);
  double stiffness = 0, mass = 0;
  for (Index i = 0; i < size; ++i) {
    stiffness += pencil.stiffness.coeff(i, i);
    mass += pencil.mass.coeff(i, i);
  }
  const double mean_square = stiffness / mass;
  {
    // A motion without mass has no place in what follows; one axis tells.
    Eigen::SparseMatrix<double> one_axis(size / 3, size / 3);
    std::vector<Eigen::Triplet<double>> entries;
    for (Index c = 0; c < size; c += 3)
      for (Eigen::SparseMatrix<double>::InnerIterator it(pencil.mass, c); it; ++it)
        entries.emplace_back(static_cast<int>(it.row() / 3), static_cast<int>(c / 3), it.value());
    one_axis.setFromTriplets(entries.begin(), entries.end());
    std::vector<std::uint32_t> all(static_cast<std::size_t>(size / 3));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
    const InverseMass check(one_axis, all);
  }
  const bool dense = size <= std::max<Index>(k_dense, 4 * wanted);
  const Ritz ritz = dense ? dense_modes(pencil, wanted) : iterated_modes(pencil, wanted, mean_square, tolerance);

  std::vector<Index> order(static_cast<std::size_t>(wanted));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return ritz.squares[a] < ritz.squares[b]; });
  Modes modes;
  modes.rounding = 64 * std::numeric_limits<double>::epsilon() * static_cast<double>(size) * mean_square;
  for (const Index i : order) {
    VectorXd v = ritz.vectors.col(i);
    Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    v *= (v[largest] < 0 ? -1 : 1) / std::sqrt(v.dot(pencil.mass.selfadjointView<Eigen::Lower>() * v));
    const VectorXd force = pencil.stiffness.selfadjointView<Eigen::Lower>() * v;
    const VectorXd momentum = pencil.mass.selfadjointView<Eigen::Lower>() * v;
    modes.squares.push_back(ritz.squares[i]);
    modes.residuals.push_back((force - ritz.squares[i] * momentum).norm() /
                              std::max(force.norm(), mean_square * momentum.norm() * 1e-6));
    Eigen::Matrix3Xd shape = Eigen::Matrix3Xd::Zero(3, static_cast<Index>(control_point_count));
    for (std::size_t p = 0; p < pencil.control_points.size(); ++p)
      shape.col(pencil.control_points[p]) = v.segment<3>(3 * static_cast<Index>(p));
    modes.shapes.push_back(std::move(shape));
  }
  return modes;
}

double frequency(const Modes& modes, std::size_t mode) {
  const double square = modes.squares[mode];
  if (std::abs(square) <= modes.rounding) return 0;
  return (square < 0 ? -1 : 1) * std::sqrt(std::abs(square)) / (2 * std::numbers::pi);
}

}  // namespace argil::fem
