#pragma once
// Sums over the elements at each node of vectors that elements have written to slots of their own, one a node of
// each element; in the order of blocks and elements, so that the number of threads does not matter.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fem/element_block.h"

namespace argil::fem {

class NodeSums {
 public:
  NodeSums(std::span<const ElementBlock> blocks, std::size_t node_count);

  std::size_t slot_count() const { return slots_.size(); }
  /// First slot of an element of block b; its nodes follow.
  std::size_t slot(std::size_t b, std::size_t element) const { return block_begin_[b] + element * node_counts_[b]; }
  /// `slots` are slot_count() vectors of three.
  void gather(const std::vector<double>& slots, Eigen::Matrix3Xd& result) const;

 private:
  std::vector<std::size_t> block_begin_, node_counts_;
  std::vector<std::size_t> begin_;    // [node], one more ends the last
  std::vector<std::uint32_t> slots_;  // by node
};

}  // namespace argil::fem
