#pragma once
// What every kernel over packets of four elements does at their quadrature points: material, deformation gradient,
// and which singular value decomposition is called for which set of instructions.

#include "fem/models/corotational_kernels.h"
#include "fem/models/lane_polar.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

// Long and, but for tangents, rarely needed: out of line, once for each set of instructions.
struct Baseline {
  static __attribute__((noinline)) void svd(const LaneMatrix& f, LaneSvd& result) { signed_svd(f, result); }
};
#if defined(__x86_64__)
struct Avx2 {
  static __attribute__((noinline, target("avx2"))) void svd(const LaneMatrix& f, LaneSvd& result) {
    signed_svd(f, result);
  }
};
#endif

struct PointMaterial {
  Lanes mu, lambda;
};

ARGIL_LANES_INLINE PointMaterial material(const PacketArguments& a, std::size_t packet, std::size_t point,
                                          std::size_t points) {
  PointMaterial m;
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    const std::size_t element = packet * k_lanes + lane;
    const std::size_t index = (element < a.element_count ? element : a.element_count - 1) * points + point;
    m.mu[lane] = a.mu[index];
    m.lambda[lane] = a.lambda[index];
  }
  return m;
}

/// Runs body(point, index of the point, rest jacobian, ∂x/∂X) at every point of one packet.
template <class Shape, class Body>
ARGIL_LANES_INLINE void at_points(const PacketArguments& a, std::size_t packet, const Shape& shape,
                                  const Body& body) {
  const std::size_t points = static_cast<std::size_t>(shape.point_count());
  for (std::size_t p = 0; p < points; ++p) {
    const std::size_t index = packet * points + p;
    const LaneMatrix jacobian = load_matrix(a.jacobians + 9 * index);
    LaneMatrix gradient;
    shape.gradient(static_cast<int>(p), gradient);
    body(p, index, jacobian, product(gradient, jacobian));
  }
}

ARGIL_LANES_INLINE const std::uint32_t* packet_nodes(const PacketArguments& a, std::size_t packet) {
  return a.nodes + packet * static_cast<std::size_t>(a.kind->node_count) * k_lanes;
}
ARGIL_LANES_INLINE FourDoubles* packet_slots(const PacketArguments& a, std::size_t packet) {
  return a.slots + packet * static_cast<std::size_t>(a.kind->node_count) * 3;
}
ARGIL_LANES_INLINE Lanes sum(const LaneVector& a) {
  return a.m[0] + a.m[1] + a.m[2];
}
ARGIL_LANES_INLINE Lanes inner(const LaneMatrix& a, const LaneMatrix& b) {
  Lanes result = a.m[0] * b.m[0];
  for (int i = 1; i < 9; ++i) result += a.m[i] * b.m[i];
  return result;
}

#pragma GCC diagnostic pop

}  // namespace argil::fem
