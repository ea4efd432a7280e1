#pragma once
// A subdivision scheme: where new points lie at smooth places, as affine combinations of the coarse vertices.
// Creases (cubic B-splines), corners and the blends of what is semi-sharp are common to all schemes
// (point_rules.h), and so is the split of cells (refinement_step.h). A new scheme is one file, an entry of RuleSet
// and one of make_scheme.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>

#include "subdiv/row_assembly.h"
#include "subdiv/rule_set.h"
#include "subdiv/skin.h"
#include "subdiv/star.h"

namespace argil::subdiv {

class Scheme {
 public:
  virtual ~Scheme() = default;

  // Each adds weight * the new point to a row. On the skin, `phase` says which faces are of the skin.
  virtual void add_cell_point(CellId c, double weight, RowBuilder& row) const = 0;
  virtual void add_interior_point(FaceId f, double weight, RowBuilder& row) const = 0;
  virtual void add_interior_point(EdgeId e, double weight, RowBuilder& row) const = 0;
  virtual void add_interior_point(VertexId v, double weight, RowBuilder& row) const = 0;
  virtual void add_skin_point(FaceId f, double weight, RowBuilder& row) const = 0;
  /// Of an edge where two faces of the skin meet.
  virtual void add_skin_point(EdgeId e, Phase phase, double weight, RowBuilder& row) const = 0;
  /// Of a vertex about which the faces of the skin make one ring.
  virtual void add_skin_point(VertexId v, Phase phase, double weight, RowBuilder& row) const = 0;

  // Rows that take the points of a star to those of the next level.
  virtual Eigen::MatrixXd interior_refinement(const Star& star) const = 0;
  /// `sharp_edge`: the place of the one crease that ends at the vertex, if one does.
  virtual Eigen::MatrixXd skin_refinement(const Star& star, std::optional<std::size_t> sharp_edge) const = 0;
  /// The weights of vertex, edge and face points in the limit of a smooth skin vertex with k edges, where a formula
  /// is known.
  virtual std::optional<std::array<double, 3>> skin_limit(double /*k*/) const { return std::nullopt; }
};

/// `solid` and `incidence` must outlive the scheme.
[[nodiscard]] std::unique_ptr<Scheme> make_scheme(RuleSet rules, const Solid& solid, const Incidence& incidence);

}  // namespace argil::subdiv
