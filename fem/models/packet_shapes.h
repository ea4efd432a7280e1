#pragma once
// Gradients at the quadrature points of four elements at once, and the transposed way back, for each element kind:
// from nodes x to ∂x/∂(u,v,w), from ∂Ψ/∂(∂x/∂(u,v,w)) to nodal forces. Tensor products are taken axis by axis;
// DenseShape takes the tables of any kind as they are.

#include <cstdint>
#include <memory>

#include "fem/elements/element_kind.h"
#include "fem/models/lanes.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// The vectors of four elements, relative to each element's first node so that far from the origin nothing is lost.
/// `nodes` holds 3 × the node index, [node * 4 + lane].
ARGIL_LANES_INLINE void gather_node(const double* x, const std::uint32_t* nodes, int node, LaneVector& to) {
  const std::uint32_t* n = nodes + k_lanes * node;
  for (unsigned axis = 0; axis < 3; ++axis)
    to.m[axis] = Lanes{x[n[0] + axis], x[n[1] + axis], x[n[2] + axis], x[n[3] + axis]};
}
ARGIL_LANES_INLINE LaneVector minus(const LaneVector& a, const LaneVector& b) {
  return {{a.m[0] - b.m[0], a.m[1] - b.m[1], a.m[2] - b.m[2]}};
}
ARGIL_LANES_INLINE void store_node(FourDoubles* slots, int node, const LaneVector& force) {
  for (int axis = 0; axis < 3; ++axis) store(slots + 3 * node + axis, force.m[axis]);
}

/// 2×2×2 points, corners 4i + 2j + k. Slopes along an axis do not depend on that coordinate: four of them serve
/// eight points.
class TrilinearShape {
 public:
  static constexpr int k_points = 8;
  explicit ARGIL_LANES_INLINE TrilinearShape(const ElementKind&) {}
  ARGIL_LANES_INLINE int point_count() const { return k_points; }

  ARGIL_LANES_INLINE void gather(const double* x, const std::uint32_t* nodes) {
    gather_node(x, nodes, 0, corners_[0]);
    for (int node = 1; node < 8; ++node) {
      gather_node(x, nodes, node, corners_[node]);
      corners_[node] = minus(corners_[node], corners_[0]);
    }
    corners_[0] = {{broadcast(0), broadcast(0), broadcast(0)}};
  }
  ARGIL_LANES_INLINE void differentiate() {
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) {
        Lanes edge[4];
        for (int e = 0; e < 4; ++e) edge[e] = corners_[corner(axis, e, 1)].m[i] - corners_[corner(axis, e, 0)].m[i];
        for (int first = 0; first < 2; ++first) {  // along the second of the two remaining axes
          const Lanes slope = edge[2 * first + 1] - edge[2 * first], start = edge[2 * first];
          edge[2 * first] = start + k_near * slope;
          edge[2 * first + 1] = start + k_far * slope;
        }
        for (int second = 0; second < 2; ++second) {
          const Lanes slope = edge[2 + second] - edge[second];
          slopes_[axis][second].m[i] = edge[second] + k_near * slope;
          slopes_[axis][2 + second].m[i] = edge[second] + k_far * slope;
        }
      }
  }
  ARGIL_LANES_INLINE void gradient(int point, LaneMatrix& result) const {
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) result.m[3 * i + axis] = slopes_[axis][face_point(axis, point)].m[i];
  }
  ARGIL_LANES_INLINE void clear() {
    for (auto& axis : slopes_)
      for (LaneVector& slope : axis)
        for (Lanes& x : slope.m) x = broadcast(0);
  }
  ARGIL_LANES_INLINE void add(int point, const LaneMatrix& stress) {
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) slopes_[axis][face_point(axis, point)].m[i] += stress.m[3 * i + axis];
  }
  ARGIL_LANES_INLINE void integrate() {
    for (LaneVector& c : corners_)
      for (Lanes& x : c.m) x = broadcast(0);
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) {
        Lanes edge[4];
        for (int second = 0; second < 2; ++second) {
          const Lanes low = slopes_[axis][second].m[i], high = slopes_[axis][2 + second].m[i];
          edge[2 + second] = k_near * low + k_far * high;
          edge[second] = (low + high) - edge[2 + second];
        }
        for (int first = 0; first < 2; ++first) {
          const Lanes low = edge[2 * first], high = edge[2 * first + 1];
          edge[2 * first + 1] = k_near * low + k_far * high;
          edge[2 * first] = (low + high) - edge[2 * first + 1];
        }
        for (int e = 0; e < 4; ++e) {
          corners_[corner(axis, e, 1)].m[i] += edge[e];
          corners_[corner(axis, e, 0)].m[i] -= edge[e];
        }
      }
  }
  ARGIL_LANES_INLINE void scatter(FourDoubles* slots) const {
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
    LaneVector node[5];
    for (int n = 0; n < 5; ++n) gather_node(x, nodes, n, node[n]);
    for (int n = 1; n < 5; ++n) node[n] = minus(node[n], node[0]);
    corners_[0] = {{broadcast(0), broadcast(0), broadcast(0)}};
    corners_[4] = node[1];
    corners_[6] = node[2];
    corners_[2] = node[3];
    for (int top = 1; top < 8; top += 2) corners_[top] = node[4];
  }
  ARGIL_LANES_INLINE void scatter(FourDoubles* slots) const {
    store_node(slots, 0, corners_[0]);
    store_node(slots, 1, corners_[4]);
    store_node(slots, 2, corners_[6]);
    store_node(slots, 3, corners_[2]);
    LaneVector apex;
    for (int i = 0; i < 3; ++i)
      apex.m[i] = (corners_[1].m[i] + corners_[3].m[i]) + (corners_[5].m[i] + corners_[7].m[i]);
    store_node(slots, 4, apex);
  }
};

/// 4×4×4 nodes and points, node and point 16i + 4j + k, with the one-dimensional tables of uniform cubic B-splines.
class TricubicShape {
 public:
  explicit TricubicShape(const ElementKind& kind) : work_(new Work) {
    // On the diagonal of the tables the other two axes factor out: their shape functions sum to one.
    const int n = kind.node_count;
    for (int p = 0; p < 4; ++p)
      for (int i = 0; i < 4; ++i) {
        work_->shape[p][i] = work_->slope[p][i] = 0;
        for (int rest = 0; rest < 16; ++rest) {
          const std::size_t entry = static_cast<std::size_t>(16 * p * n + 16 * i + rest);
          work_->shape[p][i] += kind.shapes[entry];
          work_->slope[p][i] += kind.gradients[3 * entry];
        }
      }
  }
  ARGIL_LANES_INLINE int point_count() const { return 64; }

  ARGIL_LANES_INLINE void gather(const double* x, const std::uint32_t* nodes) {
    LaneVector first;
    gather_node(x, nodes, 0, first);
    for (int n = 0; n < 64; ++n) {
      LaneVector node;
      gather_node(x, nodes, n, node);
      node = minus(node, first);
      for (int i = 0; i < 3; ++i) work_->nodes[i][n] = node.m[i];
    }
  }
  ARGIL_LANES_INLINE void differentiate() {
    Work& w = *work_;
    for (int i = 0; i < 3; ++i) {
      contract<1>(w.shape, w.nodes[i], w.stage[0]);
      contract<1>(w.slope, w.nodes[i], w.stage[1]);
      contract<4>(w.shape, w.stage[0], w.stage[2]);
      contract<16>(w.slope, w.stage[2], w.slopes[0][i]);
      contract<4>(w.slope, w.stage[0], w.stage[2]);
      contract<16>(w.shape, w.stage[2], w.slopes[1][i]);
      contract<4>(w.shape, w.stage[1], w.stage[2]);
      contract<16>(w.shape, w.stage[2], w.slopes[2][i]);
    }
  }
  ARGIL_LANES_INLINE void gradient(int point, LaneMatrix& result) const {
    for (int i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis) result.m[3 * i + axis] = work_->slopes[axis][i][point];
  }
  ARGIL_LANES_INLINE void clear() {}
  ARGIL_LANES_INLINE void add(int point, const LaneMatrix& stress) {
    for (int i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis) work_->slopes[axis][i][point] = stress.m[3 * i + axis];
  }
  ARGIL_LANES_INLINE void integrate() {
    Work& w = *work_;
    for (int i = 0; i < 3; ++i) {
      contract_transposed<16>(w.slope, w.slopes[0][i], w.stage[0]);
      contract_transposed<4>(w.shape, w.stage[0], w.stage[1]);
      contract_transposed<16>(w.shape, w.slopes[1][i], w.stage[0]);
      contract_transposed<4>(w.slope, w.stage[0], w.stage[2]);
      for (int n = 0; n < 64; ++n) w.stage[1][n] += w.stage[2][n];
      contract_transposed<1>(w.shape, w.stage[1], w.nodes[i]);
      contract_transposed<16>(w.shape, w.slopes[2][i], w.stage[0]);
      contract_transposed<4>(w.shape, w.stage[0], w.stage[1]);
      contract_transposed<1>(w.slope, w.stage[1], w.stage[2]);
      for (int n = 0; n < 64; ++n) w.nodes[i][n] += w.stage[2][n];
    }
  }
  ARGIL_LANES_INLINE void scatter(FourDoubles* slots) const {
    for (int n = 0; n < 64; ++n)
      store_node(slots, n, {{work_->nodes[0][n], work_->nodes[1][n], work_->nodes[2][n]}});
  }

 private:
  struct Work {
    double shape[4][4], slope[4][4];  // [point][node]
    Lanes nodes[3][64], slopes[3][3][64], stage[3][64];
  };

  /// Along the axis of this stride: result[point] = Σ table[point][node] · values[node].
  template <int Stride>
  static ARGIL_LANES_INLINE void contract(const double (&table)[4][4], const Lanes* values, Lanes* result) {
    for (int line = 0; line < 16; ++line) {
      const int begin = line % Stride + line / Stride * 4 * Stride;
      const Lanes v0 = values[begin], v1 = values[begin + Stride], v2 = values[begin + 2 * Stride],
                  v3 = values[begin + 3 * Stride];
      for (int p = 0; p < 4; ++p)
        result[begin + p * Stride] = table[p][0] * v0 + table[p][1] * v1 + table[p][2] * v2 + table[p][3] * v3;
    }
  }
  template <int Stride>
  static ARGIL_LANES_INLINE void contract_transposed(const double (&table)[4][4], const Lanes* values,
                                                     Lanes* result) {
    for (int line = 0; line < 16; ++line) {
      const int begin = line % Stride + line / Stride * 4 * Stride;
      const Lanes v0 = values[begin], v1 = values[begin + Stride], v2 = values[begin + 2 * Stride],
                  v3 = values[begin + 3 * Stride];
      for (int n = 0; n < 4; ++n)
        result[begin + n * Stride] = table[0][n] * v0 + table[1][n] * v1 + table[2][n] * v2 + table[3][n] * v3;
    }
  }

  std::unique_ptr<Work> work_;
};

/// Any kind, from its tables.
class DenseShape {
 public:
  explicit DenseShape(const ElementKind& kind)
      : kind_(kind),
        nodes_(new LaneVector[static_cast<std::size_t>(kind.node_count)]),
        gradients_(new LaneMatrix[static_cast<std::size_t>(kind.point_count)]) {}
  ARGIL_LANES_INLINE int point_count() const { return kind_.point_count; }

  ARGIL_LANES_INLINE void gather(const double* x, const std::uint32_t* nodes) {
    for (int n = 0; n < kind_.node_count; ++n) gather_node(x, nodes, n, nodes_[n]);
    for (int n = kind_.node_count - 1; n >= 0; --n) nodes_[n] = minus(nodes_[n], nodes_[0]);
  }
  ARGIL_LANES_INLINE void differentiate() {
    clear();
    for (int p = 0; p < kind_.point_count; ++p)
      for (int n = 0; n < kind_.node_count; ++n) {
        const double* slope = table(p, n);
        for (int i = 0; i < 3; ++i)
          for (int axis = 0; axis < 3; ++axis) gradients_[p].m[3 * i + axis] += slope[axis] * nodes_[n].m[i];
      }
  }
  ARGIL_LANES_INLINE void gradient(int point, LaneMatrix& result) const { result = gradients_[point]; }
  ARGIL_LANES_INLINE void clear() {
    for (int p = 0; p < kind_.point_count; ++p)
      for (Lanes& x : gradients_[p].m) x = broadcast(0);
  }
  ARGIL_LANES_INLINE void add(int point, const LaneMatrix& stress) {
    for (int i = 0; i < 9; ++i) gradients_[point].m[i] += stress.m[i];
  }
  ARGIL_LANES_INLINE void integrate() {
    for (int n = 0; n < kind_.node_count; ++n) {
      for (Lanes& x : nodes_[n].m) x = broadcast(0);
      for (int p = 0; p < kind_.point_count; ++p) {
        const double* slope = table(p, n);
        const Lanes* g = gradients_[p].m;
        for (int i = 0; i < 3; ++i)
          nodes_[n].m[i] += slope[0] * g[3 * i] + slope[1] * g[3 * i + 1] + slope[2] * g[3 * i + 2];
      }
    }
  }
  ARGIL_LANES_INLINE void scatter(FourDoubles* slots) const {
    for (int n = 0; n < kind_.node_count; ++n) store_node(slots, n, nodes_[n]);
  }

 private:
  ARGIL_LANES_INLINE const double* table(int point, int node) const {
    return kind_.gradients.data() + static_cast<std::size_t>(point * kind_.node_count + node) * 3;
  }

  const ElementKind& kind_;
  std::unique_ptr<LaneVector[]> nodes_;
  std::unique_ptr<LaneMatrix[]> gradients_;
};

#pragma GCC diagnostic pop

}  // namespace argil::fem
