#include "fem/element_block.h"

#include <Eigen/LU>

#include "fem/parallel.h"

namespace argil::fem {
namespace {

/// Fills the points of one element; returns the first bad one, or point_count.
int set_element_geometry(ElementBlock& block, std::size_t element, const Eigen::Matrix3Xd& rest_nodes) {
  const ElementKind& kind = *block.kind;
  const std::uint32_t* nodes = &block.nodes[element * static_cast<std::size_t>(kind.node_count)];
  const Eigen::Vector3d origin = rest_nodes.col(nodes[0]);
  int first_bad = kind.point_count;
  for (int point = kind.point_count - 1; point >= 0; --point) {
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (int a = 0; a < kind.node_count; ++a) {
      const double* gradient = &kind.gradients[static_cast<std::size_t>(point * kind.node_count + a) * 3];
      const Eigen::Vector3d x = rest_nodes.col(nodes[a]) - origin;
      for (int axis = 0; axis < 3; ++axis) jacobian.col(axis) += x * gradient[axis];
    }
    const double determinant = jacobian.determinant();
    const std::size_t index = block.point_index(element, point);
    if (determinant > 0) {
      block.inverse_rest_jacobians[index] = jacobian.inverse();
    } else {
      block.inverse_rest_jacobians[index].setZero();
      first_bad = point;
    }
    block.volumes[index] = kind.weights[static_cast<std::size_t>(point)] * determinant;
  }
  return first_bad;
}

}  // namespace

std::size_t set_rest_geometry(ElementBlock& block, const Eigen::Matrix3Xd& rest_nodes) {
  const std::size_t count = block.element_count();
  const std::size_t points = count * static_cast<std::size_t>(block.kind->point_count);
  block.inverse_rest_jacobians.resize(points);
  for (auto* values : {&block.volumes, &block.mu, &block.lambda, &block.density, &block.damping})
    values->resize(points);
  std::vector<int> first_bad(count);
  parallel_for(count, 64, [&](std::size_t e) { first_bad[e] = set_element_geometry(block, e, rest_nodes); });
  for (std::size_t e = 0; e < count; ++e)
    if (first_bad[e] < block.kind->point_count) return block.point_index(e, first_bad[e]);
  return k_no_point;
}

}  // namespace argil::fem
