#pragma once
// Nodes of four elements at once, in and out of a shape. A shape (trilinear_shape.h, tricubic_shape.h,
// dense_shape.h) takes nodes x to the gradients ∂x/∂(u,v,w) at its quadrature points (gather, differentiate,
// gradient) and, the transposed way, ∂Ψ/∂(∂x/∂(u,v,w)) at the points to nodal forces (clear, add, integrate,
// scatter).

#include <cstdint>

#include "fem/models/lanes.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// The vectors of four elements, relative to each element's first node so that far from the origin nothing is lost.
/// `nodes` holds 3 × the node index, [node * 4 + lane].
ARGIL_LANES_INLINE LaneVector gather_node(const double* x, const std::uint32_t* nodes, int node) {
  const std::uint32_t* n = nodes + k_lanes * node;
  const double *a = x + n[0], *b = x + n[1], *c = x + n[2], *d = x + n[3];
  return {{Lanes{a[0], b[0], c[0], d[0]}, Lanes{a[1], b[1], c[1], d[1]}, Lanes{a[2], b[2], c[2], d[2]}}};
}
ARGIL_LANES_INLINE LaneVector minus(const LaneVector& a, const LaneVector& b) {
  return {{a.m[0] - b.m[0], a.m[1] - b.m[1], a.m[2] - b.m[2]}};
}
ARGIL_LANES_INLINE void store_node(FourDoubles* slots, int node, const LaneVector& force) {
  store(slots + 3 * node, force.m[0]);
  store(slots + 3 * node + 1, force.m[1]);
  store(slots + 3 * node + 2, force.m[2]);
}

#pragma GCC diagnostic pop

}  // namespace argil::fem
