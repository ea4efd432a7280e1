#include "fem/models/node_sums.h"

#include "fem/parallel.h"

namespace argil::fem {

NodeSums::NodeSums(std::span<const ElementBlock> blocks, std::size_t node_count) : begin_(node_count + 1, 0) {
  std::size_t total = 0;
  for (const ElementBlock& block : blocks) {
    block_begin_.push_back(total);
    node_counts_.push_back(static_cast<std::size_t>(block.kind->node_count));
    total += block.nodes.size();
    for (const std::uint32_t node : block.nodes) ++begin_[node + 1];
  }
  for (std::size_t n = 0; n < node_count; ++n) begin_[n + 1] += begin_[n];
  slots_.resize(total);
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  std::uint32_t slot = 0;
  for (const ElementBlock& block : blocks)
    for (const std::uint32_t node : block.nodes) slots_[next[node]++] = slot++;
}

void NodeSums::gather(const std::vector<double>& slots, Eigen::Matrix3Xd& result) const {
  const std::size_t nodes = begin_.size() - 1;
  result.resize(3, static_cast<Eigen::Index>(nodes));
  double* to = result.data();
  parallel_for(nodes, 512, [&](std::size_t node) {
    double x = 0, y = 0, z = 0;
    for (std::size_t i = begin_[node]; i < begin_[node + 1]; ++i) {
      const double* slot = slots.data() + 3 * static_cast<std::size_t>(slots_[i]);
      x += slot[0];
      y += slot[1];
      z += slot[2];
    }
    to[3 * node] = x;
    to[3 * node + 1] = y;
    to[3 * node + 2] = z;
  });
}

}  // namespace argil::fem
