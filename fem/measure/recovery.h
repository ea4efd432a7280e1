#pragma once
// From quadrature points to nodes: each node takes the average of the points of its elements, weighted by volume
// times shape function. A constant is recovered exactly; enough for pictures and files.

#include <Eigen/Core>
#include <span>

#include "fem/element_block.h"

namespace argil::fem {

/// `point_values[b]` has one value a point of blocks[b]. Points without stiffness (mu = lambda = 0) are left out; a
/// node that no other point sees gets 0. For tricubic elements the result belongs to control points: values between
/// them follow by the shape functions. Cost O(points · nodes of an element), in one thread and a fixed order.
[[nodiscard]] Eigen::VectorXd recover_at_nodes(std::span<const ElementBlock> blocks,
                                               std::span<const Eigen::VectorXd> point_values,
                                               std::size_t node_count);

}  // namespace argil::fem
