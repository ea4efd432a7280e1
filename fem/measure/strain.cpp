#include "fem/measure/strain.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fem/measure/recovery.h"
#include "fem/models/lane_svd.h"
#include "fem/parallel.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {

Eigen::Matrix3d deformation_gradient(const ElementBlock& block, std::size_t element, int point,
                                     const Eigen::Matrix3Xd& nodes) {
  const ElementKind& kind = *block.kind;
  const std::uint32_t* names = &block.nodes[element * static_cast<std::size_t>(kind.node_count)];
  const double* gradients = &kind.gradients[static_cast<std::size_t>(point * kind.node_count) * 3];
  Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();
  for (int n = 0; n < kind.node_count; ++n)
    for (int axis = 0; axis < 3; ++axis)
      slopes.col(axis) += gradients[3 * n + axis] * (nodes.col(names[n]) - nodes.col(names[0]));
  return slopes * block.inverse_rest_jacobians[block.point_index(element, point)];
}

Eigen::Matrix3Xd principal_stretches(const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
  const int points = block.kind->point_count;
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(block.element_count()) * points);
  parallel_for(block.element_count(), 32, [&](std::size_t element) {
    for (int begin = 0; begin < points; begin += k_lanes) {
      LaneMatrix f;
      for (int lane = 0; lane < k_lanes; ++lane) {
        const Eigen::Matrix3d one = deformation_gradient(block, element, std::min(begin + lane, points - 1), nodes);
        for (int i = 0; i < 9; ++i) f.m[i][lane] = one(i / 3, i % 3);
      }
      LaneSvd svd;
      signed_svd(f, svd);
      for (int lane = 0; lane < std::min(k_lanes, points - begin); ++lane)
        for (int i = 0; i < 3; ++i)
          result(i, static_cast<Eigen::Index>(block.point_index(element, begin + lane))) = svd.sigma.m[i][lane];
    }
  });
  return result;
}

Eigen::VectorXd equivalent_strain(const ElementBlock& block, const Eigen::Matrix3Xd& nodes) {
  const Eigen::Matrix3Xd stretches = principal_stretches(block, nodes);
  Eigen::VectorXd result(stretches.cols());
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    // 2/3 |e'|² by differences, which do not cancel: |e'|² = Σ (σ_j − σ_k)²/3.
    const double a = stretches(0, i) - stretches(1, i), b = stretches(1, i) - stretches(2, i),
                 c = stretches(2, i) - stretches(0, i);
    result[i] = std::sqrt(2.0 / 9 * (a * a + b * b + c * c));
  }
  return result;
}

Eigen::VectorXd equivalent_strain(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes) {
  std::vector<Eigen::VectorXd> values;
  for (const ElementBlock& block : blocks) values.push_back(equivalent_strain(block, nodes));
  return recover_at_nodes(blocks, values, static_cast<std::size_t>(nodes.cols()));
}

}  // namespace argil::fem
