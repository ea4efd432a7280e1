#pragma once
// Gradients of tricubic elements by sum factorisation: one axis after the other.

#include <memory>

#include "fem/elements/element_kind.h"
#include "fem/models/shapes/packet_nodes.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

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
    const LaneVector first = gather_node(x, nodes, 0);
    for (int n = 0; n < 64; ++n) {
      const LaneVector node = minus(gather_node(x, nodes, n), first);
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

#pragma GCC diagnostic pop

}  // namespace argil::fem
