#pragma once
// Dense stiffness matrices of elements, one for all that are congruent (the same shape, side by side, and the same
// material), and their product: what papers/004 §3.4.5 keeps in every element.

#include <cstdint>
#include <map>
#include <vector>

#include "fem/element_block.h"

namespace argil::fem {

class ElementMatrices {
 public:
  /// Of elements with `node_count` nodes: matrices of 3 node_count, node-major (3 a + axis).
  explicit ElementMatrices(int node_count) : size_(3 * static_cast<std::size_t>(node_count)) {}

  /// Appends the matrix of the next element, `key` telling what it depends on: kept only if that is new.
  void append(const std::vector<std::int64_t>& key, const Eigen::MatrixXd& matrix);
  /// Shape (relative rest positions to 1e-9 of the element's extent) and material of an element.
  [[nodiscard]] static std::vector<std::int64_t> congruence_key(const ElementBlock& block, std::size_t element,
                                                                const Eigen::Matrix3Xd& rest_nodes);

  std::size_t size() const { return size_; }
  std::size_t distinct_count() const { return numbers_.size(); }
  /// Row by row.
  const double* matrix(std::size_t element) const { return values_.data() + matrix_of_[element] * size_ * size_; }
  /// result = K d of one element, both of size() numbers. Distinct matrices stream at the speed of memory.
  void product(std::size_t element, const double* d, double* result) const;

 private:
  std::size_t size_;
  std::map<std::vector<std::int64_t>, std::uint32_t> numbers_;
  std::vector<std::uint32_t> matrix_of_;  // [element]
  std::vector<double> values_;
};

/// result = matrix · d, the matrix row by row. The same bits on every processor.
void dense_product(const double* matrix, std::size_t size, const double* d, double* result);

}  // namespace argil::fem
