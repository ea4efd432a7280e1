#pragma once
// Sums small square blocks into a sparse matrix whose pattern is not known beforehand. Blocks keep the order in
// which they were first named, so the sums do not depend on the table that finds them.

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace argil::fem {

class BlockAccumulator {
 public:
  /// Blocks of `block_size` x `block_size`, 1 for mass, 3 for stiffness.
  explicit BlockAccumulator(int block_size);

  /// The block at (row, column), column-major, zero when first named. Valid until the next call.
  double* block(std::uint32_t row, std::uint32_t column);

  /// Square matrix of `size` blocks a side. Entries equal to zero stay in the pattern.
  [[nodiscard]] Eigen::SparseMatrix<double> matrix(std::size_t size) const;

 private:
  void grow();

  std::size_t values_per_block_;
  int block_size_;
  std::vector<std::uint64_t> keys_;   // in order of first naming: column << 32 | row
  std::vector<double> values_;        // values_per_block_ a key
  std::vector<std::uint32_t> slots_;  // open addressing, key number + 1, 0 where empty
};

}  // namespace argil::fem
