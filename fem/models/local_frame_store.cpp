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

/// Row after row, so that memory is read from one end to the other; four sums side by side hide the latency of
/// adding.
ARGIL_LANES_INLINE void run_product(const double* matrix, std::size_t size, const double* d, double* result) {
  for (std::size_t row = 0; row < size; ++row, matrix += size) {
    Lanes sums[4] = {broadcast(0), broadcast(0), broadcast(0), broadcast(0)};
    std::size_t i = 0;
    for (; i + 16 <= size; i += 16)
      for (std::size_t k = 0; k < 4; ++k) sums[k] += load_four(matrix + i + 4 * k) * load_four(d + i + 4 * k);
    for (; i + 4 <= size; i += 4) sums[0] += load_four(matrix + i) * load_four(d + i);
    const Lanes sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    double total = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    for (; i < size; ++i) total += matrix[i] * d[i];
    result[row] = total;
  }
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
  if (!is_new) return;
  const Eigen::MatrixXd rows = matrix.transpose();
  values_.insert(values_.end(), rows.data(), rows.data() + size_ * size_);
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
