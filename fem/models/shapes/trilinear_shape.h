#pragma once
// Gradients of trilinear hexahedra and of pyramids, axis by axis: a fifth of the work that their tables would take.

#include "fem/elements/element_kind.h"
#include "fem/models/shapes/packet_nodes.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// 2×2×2 points, corners 4i + 2j + k. Slopes along an axis do not depend on that coordinate: four of them serve
/// eight points.
class TrilinearShape {
 public:
  static constexpr int k_points = 8;
  explicit ARGIL_LANES_INLINE TrilinearShape(const ElementKind&) {}
  ARGIL_LANES_INLINE int point_count() const { return k_points; }

  ARGIL_LANES_INLINE void gather(const double* x, const std::uint32_t* nodes) {
    const LaneVector first = gather_node(x, nodes, 0);
#pragma GCC unroll 8
    for (int node = 1; node < 8; ++node) corners_[node] = minus(gather_node(x, nodes, node), first);
    corners_[0] = {{broadcast(0), broadcast(0), broadcast(0)}};
  }
  ARGIL_LANES_INLINE void differentiate() {
#pragma GCC unroll 8
    for (int axis = 0; axis < 3; ++axis)
#pragma GCC unroll 8
      for (int i = 0; i < 3; ++i) {
        Lanes edge[4];
#pragma GCC unroll 8
        for (int e = 0; e < 4; ++e) edge[e] = corners_[corner(axis, e, 1)].m[i] - corners_[corner(axis, e, 0)].m[i];
#pragma GCC unroll 8
        for (int first = 0; first < 2; ++first) {  // along the second of the two remaining axes
          const Lanes slope = edge[2 * first + 1] - edge[2 * first], start = edge[2 * first];
          edge[2 * first] = start + k_near * slope;
          edge[2 * first + 1] = start + k_far * slope;
        }
#pragma GCC unroll 8
        for (int second = 0; second < 2; ++second) {
          const Lanes slope = edge[2 + second] - edge[second];
          slopes_[axis][second].m[i] = edge[second] + k_near * slope;
          slopes_[axis][2 + second].m[i] = edge[second] + k_far * slope;
        }
      }
  }
  ARGIL_LANES_INLINE void gradient(int point, LaneMatrix& result) const {
#pragma GCC unroll 8
    for (int axis = 0; axis < 3; ++axis)
#pragma GCC unroll 8
      for (int i = 0; i < 3; ++i) result.m[3 * i + axis] = slopes_[axis][face_point(axis, point)].m[i];
  }
  ARGIL_LANES_INLINE void clear() {
#pragma GCC unroll 8
    for (auto& axis : slopes_)
#pragma GCC unroll 8
      for (LaneVector& slope : axis)
#pragma GCC unroll 8
        for (Lanes& x : slope.m) x = broadcast(0);
  }
  ARGIL_LANES_INLINE void add(int point, const LaneMatrix& stress) {
#pragma GCC unroll 8
    for (int axis = 0; axis < 3; ++axis)
#pragma GCC unroll 8
      for (int i = 0; i < 3; ++i) slopes_[axis][face_point(axis, point)].m[i] += stress.m[3 * i + axis];
  }
  ARGIL_LANES_INLINE void integrate() {
#pragma GCC unroll 8
    for (LaneVector& c : corners_)
#pragma GCC unroll 8
      for (Lanes& x : c.m) x = broadcast(0);
#pragma GCC unroll 8
    for (int axis = 0; axis < 3; ++axis)
#pragma GCC unroll 8
      for (int i = 0; i < 3; ++i) {
        Lanes edge[4];
#pragma GCC unroll 8
        for (int second = 0; second < 2; ++second) {
          const Lanes low = slopes_[axis][second].m[i], high = slopes_[axis][2 + second].m[i];
          edge[2 + second] = k_near * low + k_far * high;
          edge[second] = (low + high) - edge[2 + second];
        }
#pragma GCC unroll 8
        for (int first = 0; first < 2; ++first) {
          const Lanes low = edge[2 * first], high = edge[2 * first + 1];
          edge[2 * first + 1] = k_near * low + k_far * high;
          edge[2 * first] = (low + high) - edge[2 * first + 1];
        }
#pragma GCC unroll 8
        for (int e = 0; e < 4; ++e) {
          corners_[corner(axis, e, 1)].m[i] += edge[e];
          corners_[corner(axis, e, 0)].m[i] -= edge[e];
        }
      }
  }
  ARGIL_LANES_INLINE void scatter(FourDoubles* slots) const {
#pragma GCC unroll 8
    for (int node = 0; node < 8; ++node) store_node(slots, node, corners_[node]);
  }

 protected:
  static constexpr double k_near = 0.21132486540518713;  // (1 − 1/√3)/2
  static constexpr double k_far = 0.78867513459481287;

  /// Corner at `end` of the axis, e = 2 (first other axis) + (second other axis).
  static constexpr int corner(int axis, int e, int end) {
    return axis == 0 ? 4 * end + e : axis == 1 ? 4 * (e >> 1) + 2 * end + (e & 1) : 2 * e + end;
  }
  static constexpr int face_point(int axis, int point) {
    return axis == 0 ? (point & 3) : axis == 1 ? 2 * (point >> 2) + (point & 1) : point >> 1;
  }

  LaneVector corners_[8];
  LaneVector slopes_[3][4];
};

/// A trilinear hexahedron whose four top corners are the apex.
class PyramidShape : public TrilinearShape {
 public:
  using TrilinearShape::TrilinearShape;
  ARGIL_LANES_INLINE void gather(const double* x, const std::uint32_t* nodes) {
    const LaneVector first = gather_node(x, nodes, 0);
    corners_[0] = {{broadcast(0), broadcast(0), broadcast(0)}};
    corners_[4] = minus(gather_node(x, nodes, 1), first);
    corners_[6] = minus(gather_node(x, nodes, 2), first);
    corners_[2] = minus(gather_node(x, nodes, 3), first);
    const LaneVector apex = minus(gather_node(x, nodes, 4), first);
#pragma GCC unroll 8
    for (int top = 1; top < 8; top += 2) corners_[top] = apex;
  }
  ARGIL_LANES_INLINE void scatter(FourDoubles* slots) const {
    store_node(slots, 0, corners_[0]);
    store_node(slots, 1, corners_[4]);
    store_node(slots, 2, corners_[6]);
    store_node(slots, 3, corners_[2]);
    LaneVector apex;
#pragma GCC unroll 8
    for (int i = 0; i < 3; ++i)
      apex.m[i] = (corners_[1].m[i] + corners_[3].m[i]) + (corners_[5].m[i] + corners_[7].m[i]);
    store_node(slots, 4, apex);
  }
};

#pragma GCC diagnostic pop

}  // namespace argil::fem
