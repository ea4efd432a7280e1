#include "fem/elements/gauss.h"

namespace argil::fem {
namespace {

void evaluate_trilinear(const Eigen::Vector3d& uvw, Eigen::VectorXd& shapes, Eigen::Matrix3Xd& gradients) {
  shapes.resize(8);
  gradients.resize(3, 8);
  for (int node = 0; node < 8; ++node) {
    const int corner[3] = {node >> 2, (node >> 1) & 1, node & 1};
    double value[3], slope[3];
    for (int axis = 0; axis < 3; ++axis) {
      value[axis] = corner[axis] ? uvw[axis] : 1 - uvw[axis];
      slope[axis] = corner[axis] ? 1 : -1;
    }
    shapes[node] = value[0] * value[1] * value[2];
    gradients.col(node) << slope[0] * value[1] * value[2], value[0] * slope[1] * value[2],
        value[0] * value[1] * slope[2];
  }
}

}  // namespace

const ElementKind& trilinear_hexahedron() {
  static const ElementKind kind = make_element_kind("trilinear_hexahedron", 8, 2, evaluate_trilinear);
  return kind;
}

}  // namespace argil::fem
