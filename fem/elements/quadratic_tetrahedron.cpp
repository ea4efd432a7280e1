#include "fem/elements/quadratic_tetrahedron.h"

#include <cmath>

namespace argil::fem {
namespace {

constexpr int k_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

void evaluate_tetrahedron(const Eigen::Vector3d& uvw, Eigen::VectorXd& shapes, Eigen::Matrix3Xd& gradients) {
  const double l[4] = {1 - uvw[0] - uvw[1] - uvw[2], uvw[0], uvw[1], uvw[2]};
  const Eigen::Vector3d slope[4] = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  shapes.resize(10);
  gradients.resize(3, 10);
  for (int i = 0; i < 4; ++i) {
    shapes[i] = l[i] * (2 * l[i] - 1);
    gradients.col(i) = (4 * l[i] - 1) * slope[i];
  }
  for (int e = 0; e < 6; ++e) {
    const int i = k_edges[e][0], j = k_edges[e][1];
    shapes[4 + e] = 4 * l[i] * l[j];
    gradients.col(4 + e) = 4 * (l[i] * slope[j] + l[j] * slope[i]);
  }
}

ElementKind make_quadratic_tetrahedron() {
  ElementKind kind;
  kind.name = "quadratic_tetrahedron";
  kind.node_count = 10;
  kind.point_count = 4;
  kind.evaluate = evaluate_tetrahedron;
  const double near = (5 - std::sqrt(5.0)) / 20, far = (5 + 3 * std::sqrt(5.0)) / 20;
  Eigen::VectorXd shapes;
  Eigen::Matrix3Xd gradients;
  for (int p = 0; p < 4; ++p) {
    Eigen::Vector3d point = Eigen::Vector3d::Constant(near);
    if (p > 0) point[p - 1] = far;
    kind.points.push_back(point);
    kind.weights.push_back(1.0 / 24);
    evaluate_tetrahedron(point, shapes, gradients);
    kind.shapes.insert(kind.shapes.end(), shapes.data(), shapes.data() + shapes.size());
    kind.gradients.insert(kind.gradients.end(), gradients.data(), gradients.data() + gradients.size());
  }
  return kind;
}

}  // namespace

const ElementKind& quadratic_tetrahedron() {
  static const ElementKind kind = make_quadratic_tetrahedron();
  return kind;
}

}  // namespace argil::fem
