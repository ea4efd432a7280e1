#include "fem/models/local_frame_operator.h"

#include <Eigen/Geometry>
#include <algorithm>
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

/// Of |s₁ × s₂| and s₁ · s₂.
struct Angle {
  Angle(double area, double dot) {
    const double size = std::sqrt(area * area + dot * dot);  // |s₁| |s₂|
    if (!(size > 0)) return;
    cosine = dot / size;
    sine = area / size;
  }
  double cosine = 1, sine = 0;
};

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
    const Angle angle(first.cross(second).norm(), first.dot(second));
    *rest_measures++ = angle.cosine;
    *rest_measures++ = angle.sine;
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
    const double rest_cosine = *rest_measures++, rest_sine = *rest_measures++;
    const Eigen::Vector3d first = node(x, corner.first) - node(x, corner.at),
                          second = node(x, corner.second) - node(x, corner.at), cross = first.cross(second);
    const double area = cross.norm();
    if (!(area > 0)) continue;
    const Angle angle(area, first.dot(second));
    // Of θ₀ − θ, between −π and π, then of its half δ, without a trigonometric function.
    const double whole_cosine = rest_cosine * angle.cosine + rest_sine * angle.sine,
                 whole_sine = rest_sine * angle.cosine - rest_cosine * angle.sine;
    double cosine = std::sqrt(0.5 * std::max(0.0, 1 + whole_cosine)), sine;
    if (cosine > 0.5) {
      sine = 0.5 * whole_sine / cosine;
    } else {
      sine = std::copysign(std::sqrt(0.5 * (1 - whole_cosine)), whole_sine);
      cosine = 0.5 * std::abs(whole_sine / sine);
    }
    const double cosine_less_one = -sine * sine / (1 + cosine);
    // Both are at right angles to n: Rot(n, φ) s = cos φ s + sin φ n × s.
    add(corner.at, cosine_less_one * (first + second) + (sine / area) * cross.cross(second - first), 1);
  }
}

}  // namespace argil::fem
