#include "fem/measure/recovery.h"

namespace argil::fem {

Eigen::VectorXd recover_at_nodes(std::span<const ElementBlock> blocks,
                                 std::span<const Eigen::VectorXd> point_values, std::size_t node_count) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(node_count));
  Eigen::VectorXd weights = sums;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const ElementBlock& block = blocks[b];
    const ElementKind& kind = *block.kind;
    const auto node_total = static_cast<std::size_t>(kind.node_count);
    for (std::size_t element = 0; element < block.element_count(); ++element)
      for (int point = 0; point < kind.point_count; ++point) {
        const std::size_t index = block.point_index(element, point);
        if (block.mu[index] == 0 && block.lambda[index] == 0) continue;
        const double* shapes = &kind.shapes[static_cast<std::size_t>(point) * node_total];
        for (std::size_t n = 0; n < node_total; ++n) {
          const double weight = block.volumes[index] * shapes[n];
          const std::uint32_t node = block.nodes[element * node_total + n];
          weights[node] += weight;
          sums[node] += weight * point_values[b][static_cast<Eigen::Index>(index)];
        }
      }
  }
  for (Eigen::Index i = 0; i < sums.size(); ++i) sums[i] = weights[i] > 0 ? sums[i] / weights[i] : 0;
  return sums;
}

}  // namespace argil::fem
