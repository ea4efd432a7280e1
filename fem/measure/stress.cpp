#include "fem/measure/stress.h"

#include <vector>

#include "fem/measure/recovery.h"
#include "fem/measure/strain.h"

namespace argil::fem {

Eigen::VectorXd von_mises_stress(const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
  // s = 2μ e', so sqrt(3/2 s:s) = 3μ sqrt(2/3 e':e').
  Eigen::VectorXd result = equivalent_strain(block, nodes);
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] *= 3 * block.mu[static_cast<std::size_t>(i)];
  return result;
}

Eigen::VectorXd von_mises_stress(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes) {
  std::vector<Eigen::VectorXd> values;
  for (const ElementBlock& block : blocks) values.push_back(von_mises_stress(block, nodes));
  return recover_at_nodes(blocks, values, static_cast<std::size_t>(nodes.cols()));
}

}  // namespace argil::fem
