#include "fem/solvers/block_accumulator.h"

namespace argil::fem {

namespace {

std::size_t scramble(std::uint64_t key) {
  key ^= key >> 31;
  key *= 0x9e3779b97f4a7c15ULL;
  return static_cast<std::size_t>(key ^ (key >> 29));
}

}  // namespace

BlockAccumulator::BlockAccumulator(int block_size)
    : values_per_block_(static_cast<std::size_t>(block_size) * static_cast<std::size_t>(block_size)),
      block_size_(block_size),
      slots_(1024, 0) {}

double* BlockAccumulator::block(std::uint32_t row, std::uint32_t column) {
  const std::uint64_t key = (static_cast<std::uint64_t>(column) << 32) | row;
  const std::size_t mask = slots_.size() - 1;
  std::size_t s = scramble(key) & mask;
  while (slots_[s] != 0) {
    if (keys_[slots_[s] - 1] == key) return values_.data() + values_per_block_ * (slots_[s] - 1);
    s = (s + 1) & mask;
  }
  keys_.push_back(key);
  values_.resize(values_.size() + values_per_block_, 0.0);
  slots_[s] = static_cast<std::uint32_t>(keys_.size());
  if (2 * keys_.size() > slots_.size()) grow();
  return values_.data() + values_per_block_ * (keys_.size() - 1);
}

void BlockAccumulator::grow() {
  slots_.assign(2 * slots_.size(), 0);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    std::size_t s = scramble(keys_[k]) & mask;
    while (slots_[s] != 0) s = (s + 1) & mask;
    slots_[s] = static_cast<std::uint32_t>(k + 1);
  }
}

Eigen::SparseMatrix<double> BlockAccumulator::matrix(std::size_t size) const {
  std::vector<Eigen::Triplet<double, int>> triplets;
  triplets.reserve(values_.size());
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    const int row = static_cast<int>(keys_[k] & 0xffffffffU) * block_size_;
    const int column = static_cast<int>(keys_[k] >> 32) * block_size_;
    for (int j = 0; j < block_size_; ++j)
      for (int i = 0; i < block_size_; ++i)
        triplets.emplace_back(row + i, column + j,
                              values_[values_per_block_ * k + static_cast<std::size_t>(j * block_size_ + i)]);
  }
  const auto n = static_cast<Eigen::Index>(size) * block_size_;
  Eigen::SparseMatrix<double> result(n, n);
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

}  // namespace argil::fem
