#include "fem/elements/gauss.h"

#include <cassert>
#include <cmath>

namespace argil::fem {

GaussRule gauss_rule(int point_count) {
  assert(point_count == 2 || point_count == 4);
  if (point_count == 2) {
    const double offset = 0.5 / std::sqrt(3.0);
    return {{0.5 - offset, 0.5 + offset}, {0.5, 0.5}};
  }
  const double near = 0.5 * std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
  const double far = 0.5 * std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double near_weight = (18 + std::sqrt(30.0)) / 72, far_weight = (18 - std::sqrt(30.0)) / 72;
  return {{0.5 - far, 0.5 - near, 0.5 + near, 0.5 + far}, {far_weight, near_weight, near_weight, far_weight}};
}

ElementKind make_element_kind(std::string_view name, int node_count, int points_per_axis,
                              decltype(ElementKind::evaluate) evaluate) {
  const GaussRule rule = gauss_rule(points_per_axis);
  ElementKind kind;
  kind.name = name;
  kind.node_count = node_count;
  kind.evaluate = evaluate;
  for (std::size_t a = 0; a < rule.points.size(); ++a)
    for (std::size_t b = 0; b < rule.points.size(); ++b)
      for (std::size_t c = 0; c < rule.points.size(); ++c) {
        kind.points.emplace_back(rule.points[a], rule.points[b], rule.points[c]);
        kind.weights.push_back(rule.weights[a] * rule.weights[b] * rule.weights[c]);
      }
  kind.point_count = static_cast<int>(kind.points.size());
  Eigen::VectorXd shapes;
  Eigen::Matrix3Xd gradients;
  for (const Eigen::Vector3d& point : kind.points) {
    evaluate(point, shapes, gradients);
    kind.shapes.insert(kind.shapes.end(), shapes.data(), shapes.data() + shapes.size());
    kind.gradients.insert(kind.gradients.end(), gradients.data(), gradients.data() + gradients.size());
  }
  return kind;
}

}  // namespace argil::fem
