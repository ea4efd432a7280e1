#include "fem/elements/gauss.h"

namespace argil::fem {
namespace {

void cubic_bspline(double t, double value[4], double slope[4]) {
  const double s = 1 - t;
  value[0] = s * s * s / 6;
  value[1] = (3 * t * t * t - 6 * t * t + 4) / 6;
  value[2] = (3 * s * s * s - 6 * s * s + 4) / 6;
  value[3] = t * t * t / 6;
  slope[0] = -s * s / 2;
  slope[1] = (3 * t * t - 4 * t) / 2;
  slope[2] = -(3 * s * s - 4 * s) / 2;
  slope[3] = t * t / 2;
}

void evaluate_bspline(const Eigen::Vector3d& uvw, Eigen::VectorXd& shapes, Eigen::Matrix3Xd& gradients) {
  double value[3][4], slope[3][4];
  for (int axis = 0; axis < 3; ++axis) cubic_bspline(uvw[axis], value[axis], slope[axis]);
  shapes.resize(64);
  gradients.resize(3, 64);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        const int node = 16 * i + 4 * j + k;
        shapes[node] = value[0][i] * value[1][j] * value[2][k];
        gradients.col(node) << slope[0][i] * value[1][j] * value[2][k], value[0][i] * slope[1][j] * value[2][k],
            value[0][i] * value[1][j] * slope[2][k];
      }
}

}  // namespace

const ElementKind& bspline_hexahedron() {
  static const ElementKind kind = make_element_kind("bspline_hexahedron", 64, 4, evaluate_bspline);
  return kind;
}

}  // namespace argil::fem
