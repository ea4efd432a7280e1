#pragma once
// An element kind is data: shape functions and their gradients at its quadrature points, in cell coordinates
// (u, v, w) in [0, 1]³.

#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace argil::fem {

struct ElementKind {
  std::string_view name;
  int node_count = 0;
  int point_count = 0;
  std::vector<double> shapes;           // [point * node_count + node]
  std::vector<double> gradients;        // [(point * node_count + node) * 3 + axis], with respect to (u, v, w)
  std::vector<double> weights;          // [point], summing to the volume of the cell: 1, of a simplex 1/6
  std::vector<Eigen::Vector3d> points;  // [point], (u, v, w)
  /// Shape functions and gradients (3 x node_count) at any (u, v, w).
  void (*evaluate)(const Eigen::Vector3d& uvw, Eigen::VectorXd& shapes, Eigen::Matrix3Xd& gradients) = nullptr;
};

/// Trilinear hexahedron, 2×2×2 Gauss. Node 4i + 2j + k at (i, j, k), the box order of subdiv::box_vertices.
[[nodiscard]] const ElementKind& trilinear_hexahedron();
/// Degenerate hexahedron (papers/004 §3.4.3): nodes 0–3 the base, counter-clockwise seen from the apex, node 4 the
/// apex. 2×2×2 Gauss of the collapsed hexahedron: base (u, v, 0), apex at w = 1.
[[nodiscard]] const ElementKind& pyramid();
/// Uniform tricubic B-spline on a 4×4×4 net, 4×4×4 Gauss; node 16i + 4j + k.
[[nodiscard]] const ElementKind& bspline_hexahedron();

}  // namespace argil::fem
