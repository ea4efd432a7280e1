#include "fem/models/local_frame_store.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "fem/models/lanes.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

ARGIL_LANES_INLINE Lanes load_four(const double* from) {
  Lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}

/// result += the products of `k_columns` columns, so that the result is loaded and stored once for all of them.
template <std::size_t k_columns>
ARGIL_LANES_INLINE void add_columns(const double* columns, std::size_t size, const double* d, double* result) {
  std::size_t i = 0;
  for (; i + 4 <= size; i += 4) {
    Lanes sum = load_four(result + i);
    for (std::size_t c = 0; c < k_columns; ++c) sum += d[c] * load_four(columns + c * size + i);
    std::memcpy(result + i, &sum, sizeof sum);
  }
  for (; i < size; ++i)
    for (std::size_t c = 0; c < k_columns; ++c) result[i] += d[c] * columns[c * size + i];
}

ARGIL_LANES_INLINE void run_product(const double* matrix, std::size_t size, const double* d, double* result) {
  for (std::size_t i = 0; i < size; ++i) result[i] = 0;
  std::size_t first = 0;
  for (; first + 12 <= size; first += 12) add_columns<12>(matrix + first * size, size, d + first, result);
  for (; first < size; first += 3) add_columns<3>(matrix + first * size, size, d + first, result);
}

__attribute__((flatten)) void baseline_product(const double* matrix, std::size_t size, const double* d,
                                               double* result) {
  run_product(matrix, size, d, result);
}
#if defined(__x86_64__)
__attribute__((target("avx2"), flatten)) void avx2_product(const double* matrix, std::size_t size, const double* d,
                                                           double* result) {
  run_product(matrix, size, d, result);
}
#endif

}  // namespace

void dense_product(const double* matrix, std::size_t size, const double* d, double* result) {
#if defined(__x86_64__)
  static const auto chosen = __builtin_cpu_supports("avx2") ? avx2_product : baseline_product;
#else
  static const auto chosen = baseline_product;
#endif
  chosen(matrix, size, d, result);
}

void ElementMatrices::append(const std::vector<std::int64_t>& key, const Eigen::MatrixXd& matrix) {
  const auto [place, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(numbers_.size()));
  matrix_of_.push_back(place->second);
  if (is_new) values_.insert(values_.end(), matrix.data(), matrix.data() + size_ * size_);
}

std::vector<std::int64_t> ElementMatrices::congruence_key(const ElementBlock& block, std::size_t element,
                                                          const Eigen::Matrix3Xd& rest_nodes) {
  const auto nodes = static_cast<std::size_t>(block.kind->node_count);
  const auto points = static_cast<std::size_t>(block.kind->point_count);
  const std::uint32_t* of = block.nodes.data() + element * nodes;
  const Eigen::Vector3d origin = rest_nodes.col(of[0]);
  double extent = 0;
  for (std::size_t n = 1; n < nodes; ++n)
    for (int axis = 0; axis < 3; ++axis)
      extent = std::max(extent, std::abs(rest_nodes(axis, of[n]) - origin[axis]));
  // The extent with a relative step of about 1e-9, so that it is the same for elements that differ by rounding.
  const double step = std::ldexp(1.0, std::ilogb(extent) - 30);
  std::vector<std::int64_t> key;
  key.push_back(std::ilogb(step));
  for (std::size_t n = 1; n < nodes; ++n)
    for (int axis = 0; axis < 3; ++axis)
      key.push_back(static_cast<std::int64_t>(std::llround((rest_nodes(axis, of[n]) - origin[axis]) / step)));
  for (std::size_t q = element * points; q < (element + 1) * points; ++q) {
    key.push_back(std::bit_cast<std::int64_t>(block.mu[q]));
    key.push_back(std::bit_cast<std::int64_t>(block.lambda[q]));
  }
  return key;
}

void ElementMatrices::product(std::size_t element, const double* d, double* result) const {
  dense_product(matrix(element), size_, d, result);
}

}  // namespace argil::fem
