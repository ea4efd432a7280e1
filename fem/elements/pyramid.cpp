#include "fem/elements/gauss.h"

namespace argil::fem {
namespace {

/// The trilinear hexahedron with the four nodes of its top face in one place.
void evaluate_pyramid(const Eigen::Vector3d& uvw, Eigen::VectorXd& shapes, Eigen::Matrix3Xd& gradients) {
  constexpr int k_corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const double below = 1 - uvw[2];
  shapes.resize(5);
  gradients.resize(3, 5);
  for (int node = 0; node < 4; ++node) {
    const bool right = k_corner[node][0], back = k_corner[node][1];
    const double u = right ? uvw[0] : 1 - uvw[0], v = back ? uvw[1] : 1 - uvw[1];
    shapes[node] = u * v * below;
    gradients.col(node) << (right ? v : -v) * below, (back ? u : -u) * below, -u * v;
  }
  shapes[4] = uvw[2];
  gradients.col(4) << 0, 0, 1;
}

}  // namespace

const ElementKind& pyramid() {
  static const ElementKind kind = make_element_kind("pyramid", 5, 2, evaluate_pyramid);
  return kind;
}

}  // namespace argil::fem
