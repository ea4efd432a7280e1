#include "fem/models/local_frame_operator.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

namespace argil::fem {
namespace {

/// A lattice of n³ nodes, node (i n + j) n + k: all edges, and the four corners of all its squares.
LocalTopology lattice(int n) {
  LocalTopology result;
  const int steps[3] = {n * n, n, 1};
  const auto coordinate = [&](int node, int axis) { return node / steps[axis] % n; };
  for (int axis = 0; axis < 3; ++axis)
    for (int node = 0; node < n * n * n; ++node)
      if (coordinate(node, axis) + 1 < n) result.edges.push_back({node, node + steps[axis]});
  for (int first = 0; first < 3; ++first)
    for (int second = first + 1; second < 3; ++second)
      for (int node = 0; node < n * n * n; ++node) {
        if (coordinate(node, first) + 1 == n || coordinate(node, second) + 1 == n) continue;
        const int loop[4] = {node, node + steps[first], node + steps[first] + steps[second], node + steps[second]};
        for (int c = 0; c < 4; ++c) result.corners.push_back({loop[c], loop[(c + 1) % 4], loop[(c + 3) % 4]});
      }
  return result;
}

LocalTopology pyramid_topology() {
  LocalTopology result;
  for (int base = 0; base < 4; ++base) {
    const int next = (base + 1) % 4, before = (base + 3) % 4;
    result.edges.push_back({base, next});
    result.edges.push_back({base, 4});
    result.corners.push_back({base, next, before});
    result.corners.push_back({base, next, 4});
    result.corners.push_back({base, 4, before});
  }
  return result;
}

Eigen::Vector3d node(const double* x, int n) {
  return {x[3 * n], x[3 * n + 1], x[3 * n + 2]};
}

}  // namespace

const LocalTopology& local_topology(const ElementKind& kind) {
  static const LocalTopology hexahedron = lattice(2), tricubic = lattice(4), pyramidal = pyramid_topology();
  if (&kind == &trilinear_hexahedron()) return hexahedron;
  if (&kind == &bspline_hexahedron()) return tricubic;
  assert(&kind == &pyramid());
  return pyramidal;
}

void local_rest_measures(const LocalTopology& topology, const double* x, double* rest_measures) {
  for (const auto& edge : topology.edges) *rest_measures++ = (node(x, edge.to) - node(x, edge.from)).norm();
  for (const auto& corner : topology.corners) {
    const Eigen::Vector3d first = node(x, corner.first) - node(x, corner.at),
                          second = node(x, corner.second) - node(x, corner.at);
    *rest_measures++ = std::atan2(first.cross(second).norm(), first.dot(second));
  }
}

void local_displacements(const LocalTopology& topology, int node_count, const double* rest_measures,
                         const double* x, double* result) {
  for (int i = 0; i < 3 * node_count; ++i) result[i] = 0;
  const auto add = [&](int n, const Eigen::Vector3d& value, double sign) {
    for (int axis = 0; axis < 3; ++axis) result[3 * n + axis] += sign * value[axis];
  };
  for (const auto& edge : topology.edges) {
    const Eigen::Vector3d along = node(x, edge.to) - node(x, edge.from);
    const double length = along.norm(), rest = *rest_measures++;
    if (length == 0) continue;
    const Eigen::Vector3d change = (1 - rest / length) * along;
    add(edge.to, change, 1);
    add(edge.from, change, -1);
  }
  for (const auto& corner : topology.corners) {
    const double rest = *rest_measures++;
    const Eigen::Vector3d first = node(x, corner.first) - node(x, corner.at),
                          second = node(x, corner.second) - node(x, corner.at), cross = first.cross(second);
    const double area = cross.norm();
    if (!(area > 0)) continue;
    const double half = 0.5 * (rest - std::atan2(area, first.dot(second)));
    const double sine = std::sin(half) / area, cosine = std::cos(half) - 1;
    // Both are at right angles to n: Rot(n, φ) s = cos φ s + sin φ n × s.
    add(corner.at, cosine * (first + second) + sine * cross.cross(second - first), 1);
  }
}

}  // namespace argil::fem
