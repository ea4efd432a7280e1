#pragma once
// Where MacCracken–Joy refinement puts the new points (METHODS §1), as affine combinations of the coarse vertices.
// With c = centroid of a cell, a = of a face, m = of an edge, bars = means over everything incident:
//   cell c; interior face (c₀ + c₁ + 2a)/4; interior edge (c̄ + 2ā + (n−3)m)/n; interior vertex (c̄ + 3ā + 3m̄ + v)/8;
//   boundary, on the boundary surface alone: face a; edge (v₀ + v₁ + a₀ + a₁)/4, sharp m;
//   vertex (ā + 2m̄ + (k−3)v)/k, crease (6v + v₀ + v₁)/8, corner v.

#include "subdiv/incidence.h"
#include "subdiv/maccracken_joy.h"
#include "subdiv/row_assembly.h"

namespace argil::subdiv {

class PointRules {
 public:
  /// @throws Error as refine() does, if some rule is missing. The solid must outlive the rules.
  explicit PointRules(const Solid& solid);

  const Incidence& incidence() const { return incidence_; }
  /// Of a boundary vertex.
  BoundaryVertexRule rule(VertexId v) const { return vertex_rule_[v]; }

  // Each adds weight * the new point to a row.
  void add_vertex_point(VertexId v, double weight, RowBuilder& row) const;
  void add_edge_point(EdgeId e, double weight, RowBuilder& row) const;
  void add_face_point(FaceId f, double weight, RowBuilder& row) const;
  void add_cell_point(CellId c, double weight, RowBuilder& row) const;

 private:
  void check_elements() const;
  void check_interior_edges() const;
  void set_boundary_rules();

  const Solid* solid_;
  Incidence incidence_;
  VertexData<BoundaryVertexRule> vertex_rule_;
};

}  // namespace argil::subdiv
