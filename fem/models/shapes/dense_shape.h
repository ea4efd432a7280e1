#pragma once
// Gradients of any element kind from its tables, for kinds that have no shape of their own.

#include <memory>

#include "fem/elements/element_kind.h"
#include "fem/models/shapes/packet_nodes.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

class DenseShape {
 public:
  explicit DenseShape(const ElementKind& kind)
      : kind_(kind),
        nodes_(new LaneVector[static_cast<std::size_t>(kind.node_count)]),
        gradients_(new LaneMatrix[static_cast<std::size_t>(kind.point_count)]) {}
  ARGIL_LANES_INLINE int point_count() const { return kind_.point_count; }

  ARGIL_LANES_INLINE void gather(const double* x, const std::uint32_t* nodes) {
    for (int n = 0; n < kind_.node_count; ++n) nodes_[n] = gather_node(x, nodes, n);
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
