#pragma once
// The operator R of papers/004 §3.2.2 as METHODS §4 makes it precise: how far each node of an element is displaced,
// judged by the lengths of its edges and the angles of its faces alone. Per node i
//   Σ over edges (1 − l₀/l)(x_i − x_j)  +  Σ over corners (i; a, b) of  Rot(n, −δ) s₁ − s₁ + Rot(n, +δ) s₂ − s₂,
// s₁ = x_a − x_i, s₂ = x_b − x_i, n their normal, δ = (θ₀ − θ)/2 (papers/004, Fig. 3: a′ − a and b′ − b).
// It turns with the body. It is zero in the mirror image of the rest state, which is a spurious rest state
// therefore.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fem/elements/element_kind.h"

namespace argil::fem {

/// Edges and corners of the faces of an element kind: of the hexahedron; of the 27 cells of a tricubic net; of a
/// pyramid, where the corners at the apex are left out: there the degenerate hexahedron has an edge of no length.
struct LocalTopology {
  struct Edge {
    int from, to;
  };
  struct Corner {
    int at, first, second;
  };
  std::vector<Edge> edges;
  std::vector<Corner> corners;

  /// A length an edge, cosine and sine of an angle a corner.
  [[nodiscard]] std::size_t measure_count() const { return edges.size() + 2 * corners.size(); }
};
[[nodiscard]] const LocalTopology& local_topology(const ElementKind& kind);

/// Rest lengths [m] of the edges, then cosine and sine of the rest angles of the corners, at measure_count() places
/// of `rest_measures`. `x` is the element's nodes, 3 · node_count.
void local_rest_measures(const LocalTopology& topology, const double* x, double* rest_measures);
/// R d, 3 · node_count, overwriting. Edges of no length and corners without a normal are left out. Cost: three
/// square roots a corner.
void local_displacements(const LocalTopology& topology, int node_count, const double* rest_measures,
                         const double* x, double* result);

}  // namespace argil::fem
