#pragma once
// Where refinement puts the new points, as affine combinations of the coarse vertices: a scheme's rules at smooth
// places (scheme.h), on the skin as far as it is smooth; creases as cubic B-splines, edge (v₀ + v₁)/2 and vertex
// (6v + v₀ + v₁)/8; corners stay; and blends of these where something semi-sharp ends (skin.h).

#include "subdiv/incidence.h"
#include "subdiv/row_assembly.h"
#include "subdiv/scheme.h"
#include "subdiv/skin.h"

namespace argil::subdiv {

class PointRules {
 public:
  /// @throws Error as refine() does, if some rule is missing. The solid must outlive the rules.
  PointRules(const Solid& solid, RuleSet rules);

  const Incidence& incidence() const { return incidence_; }
  const Scheme& scheme() const { return *scheme_; }
  // As the parent has them.
  VertexRule rule(VertexId v) const { return vertex_rule_[v]; }
  bool is_crease(EdgeId e) const { return rule(e) == EdgeRule::crease; }
  bool is_semi_sharp_at(VertexId v) const { return semi_sharp_ && skin_.is_semi_sharp_at(v); }

  // Each adds weight * the new point to a row.
  void add_vertex_point(VertexId v, double weight, RowBuilder& row) const;
  void add_edge_point(EdgeId e, double weight, RowBuilder& row) const;
  void add_face_point(FaceId f, double weight, RowBuilder& row) const;
  void add_cell_point(CellId c, double weight, RowBuilder& row) const;

 private:
  EdgeRule rule(EdgeId e) const;
  // The weight of the parent's rule: less than 1 where something ends.
  template <class IdType>
  double parent_weight(IdType id) const {
    return ending_ ? skin_.parent_weight(id) : 1;
  }
  template <class IdType>
  void check_sharpness(IdType id, double sharpness);
  void check_faces();
  void check_edges();
  void check_vertices();
  void set_vertex_rules();
  void add(EdgeId e, EdgeRule rule, Phase phase, double weight, RowBuilder& row) const;
  void add(VertexId v, VertexRule rule, Phase phase, double weight, RowBuilder& row) const;

  const Solid* solid_;
  Skin skin_;
  Incidence incidence_;
  std::unique_ptr<const Scheme> scheme_;
  VertexData<VertexRule> vertex_rule_;
  bool semi_sharp_ = false, ending_ = false;  // anything at all
};

}  // namespace argil::subdiv
