#pragma once
// Sparse affine combinations, the rows of A in d = A p (paper 004 eq. 1): row i names the columns (control points
// or coarser vertices) that node i is made of. Rows are kept sorted by column, so that products have one order of
// summation.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace argil::subdiv {

struct StencilRow {
  std::span<const std::uint32_t> columns;
  std::span<const double> weights;
};

struct Stencils {
  std::size_t column_count = 0;
  std::vector<std::size_t> offsets{0};  // row i is [offsets[i], offsets[i+1])
  std::vector<std::uint32_t> columns;
  std::vector<double> weights;

  std::size_t row_count() const { return offsets.size() - 1; }
  StencilRow row(std::size_t i) const {
    const std::size_t n = offsets[i + 1] - offsets[i];
    return {{columns.data() + offsets[i], n}, {weights.data() + offsets[i], n}};
  }
  /// Appends a row; `row_columns` ascending and without repeats.
  void append(std::span<const std::uint32_t> row_columns, std::span<const double> row_weights);
  void append(const Stencils& other);

  static Stencils identity(std::size_t n);
};

/// `stencils * values`; values is 3 x columns, the result 3 x rows.
/// Cost O(entries), in parallel by rows; the result does not depend on the number of threads.
[[nodiscard]] Eigen::Matrix3Xd apply(const Stencils& stencils, const Eigen::Matrix3Xd& values);
/// The same for one number a column.
[[nodiscard]] Eigen::VectorXd apply(const Stencils& stencils, const Eigen::VectorXd& values);

/// fine * coarse: rows of `fine` expressed in the columns of `coarse`.
[[nodiscard]] Stencils compose(const Stencils& fine, const Stencils& coarse);

[[nodiscard]] Stencils transpose(const Stencils& stencils);

}  // namespace argil::subdiv
