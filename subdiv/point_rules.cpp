#include "subdiv/point_rules.h"

#include <fmt/format.h>

#include "subdiv/error.h"
#include "subdiv/maccracken_joy.h"
#include "subdiv/multilinear_averaging.h"

namespace argil::subdiv {

namespace {

std::string name(const Solid& solid, EdgeId e) {
  const auto& ends = solid.edge_vertices(e);
  return fmt::format("edge {} (vertices {} and {})", e.value, ends[0].value, ends[1].value);
}
std::string name(const Solid&, VertexId v) {
  return fmt::format("vertex {}", v.value);
}
std::string name(const Solid&, FaceId f) {
  return fmt::format("face {}", f.value);
}

template <class IdType>
[[noreturn]] void refuse_without_cell(const Solid& solid, IdType id) {
  throw Error(
      ErrorCode::bad_topology,
      fmt::format("{} belongs to no cell: only cells can be refined; `remove dangling` sweeps it", name(solid, id)),
      name(solid, id));
}

}  // namespace

std::unique_ptr<Scheme> make_scheme(RuleSet rules, const Solid& solid, const Incidence& incidence) {
  return rules == RuleSet::multilinear_averaging ? make_multilinear_averaging(solid, incidence)
                                                 : make_maccracken_joy(solid, incidence);
}

PointRules::PointRules(const Solid& solid, RuleSet rules)
    : solid_(&solid),
      skin_(solid),
      incidence_(solid),
      scheme_(make_scheme(rules, solid, incidence_)),
      vertex_rule_(solid.vertex_capacity(), VertexRule::interior) {
  check_faces();
  check_edges();
  check_vertices();
  set_vertex_rules();
}

template <class IdType>
void PointRules::check_sharpness(IdType id, double sharpness) {
  if (sharpness == 0) return;
  if (!incidence_.on_skin(id))
    throw Error(
        ErrorCode::unsupported,
        fmt::format("{} is sharp inside the solid: only the boundary and sharp sheets of faces can be sharp; "
                    "set its sharpness to 0, or sharpen faces there",
                    name(*solid_, id)),
        name(*solid_, id));
  const double here = skin_.sharpness(id);
  semi_sharp_ = semi_sharp_ || is_semi_sharp(here);
  ending_ = ending_ || is_ending(here);
}

void PointRules::check_faces() {
  const Solid& s = *solid_;
  for (const FaceId f : s.faces()) {
    const bool front = s.owner(face_use(f, false)).valid(), back = s.owner(face_use(f, true)).valid();
    if (!front && !back) refuse_without_cell(s, f);
    if (front && back && s.face_sharpness(f) > 0) check_sharpness(f, s.face_sharpness(f));
  }
}

void PointRules::check_edges() {
  const Solid& s = *solid_;
  for (const EdgeId e : s.edges()) {
    if (s.edge_valence(e) == 0) refuse_without_cell(s, e);
    check_sharpness(e, s.edge_sharpness(e));
    if (s.edge_valence(e) > 2) continue;
    const bool inside =
        !incidence_.on_skin(e) || (parent_weight(e) < 1 && skin_.rule(e, Phase::child) == EdgeRule::interior);
    if (inside)
      throw Error(
          ErrorCode::bad_topology,
          fmt::format("{} lies inside the solid with {} faces: expected at least 3; split or merge the cells "
                      "about it",
                      name(s, e), s.edge_valence(e)),
          name(s, e));
  }
}

void PointRules::check_vertices() {
  const Solid& s = *solid_;
  for (const VertexId v : s.vertices()) {
    if (s.vertex_valence(v) == 0) refuse_without_cell(s, v);
    check_sharpness(v, s.vertex_sharpness(v));
  }
}

void PointRules::set_vertex_rules() {
  const Solid& s = *solid_;
  VertexData<std::uint8_t> too_few(s.vertex_capacity(), 0);
  parallel_for(s.vertex_capacity(), 1024, [&](std::size_t i) {
    const VertexId v{i};
    if (!incidence_.on_skin(v)) return;
    vertex_rule_[v] = skin_.rule(v, Phase::parent);
    const auto lacks_edges = [&](VertexRule rule, Phase phase) {
      return rule == VertexRule::smooth && skin_.edge_count(v, phase) < 3;
    };
    if (lacks_edges(vertex_rule_[v], Phase::parent) ||
        (parent_weight(v) < 1 && lacks_edges(skin_.rule(v, Phase::child), Phase::child)))
      too_few[v] = 1;
  });
  for (const VertexId v : s.vertices())
    if (too_few[v])
      throw Error(
          ErrorCode::bad_topology,
          fmt::format("{} is smooth and has 2 edges on the boundary: expected at least 3; make it a corner, its "
                      "edges sharp, or split a face at it",
                      name(s, v)),
          name(s, v));
}

EdgeRule PointRules::rule(EdgeId e) const {
  const std::size_t count = incidence_.skin_face_count(e);
  if (count == 0) return EdgeRule::interior;
  return count != 2 || skin_.sharpness(e) > 0 ? EdgeRule::crease : EdgeRule::smooth;
}

void PointRules::add_cell_point(CellId c, double weight, RowBuilder& row) const {
  scheme_->add_cell_point(c, weight, row);
}

void PointRules::add_face_point(FaceId f, double weight, RowBuilder& row) const {
  const double skin = incidence_.on_skin(f) ? std::min(skin_.sharpness(f), 1.0) : 0;
  if (skin > 0) scheme_->add_skin_point(f, weight * skin, row);
  if (skin < 1) scheme_->add_interior_point(f, weight * (1 - skin), row);
}

void PointRules::add_edge_point(EdgeId e, double weight, RowBuilder& row) const {
  const double parent = parent_weight(e);
  add(e, rule(e), Phase::parent, weight * parent, row);
  if (parent < 1) add(e, skin_.rule(e, Phase::child), Phase::child, weight * (1 - parent), row);
}

void PointRules::add_vertex_point(VertexId v, double weight, RowBuilder& row) const {
  const double parent = parent_weight(v);
  add(v, rule(v), Phase::parent, weight * parent, row);
  if (parent < 1) add(v, skin_.rule(v, Phase::child), Phase::child, weight * (1 - parent), row);
}

void PointRules::add(EdgeId e, EdgeRule rule, Phase phase, double weight, RowBuilder& row) const {
  switch (rule) {
    case EdgeRule::interior:
      scheme_->add_interior_point(e, weight, row);
      return;
    case EdgeRule::crease:
      row.add_mean(solid_->edge_vertices(e), weight);
      return;
    case EdgeRule::smooth:
      scheme_->add_skin_point(e, phase, weight, row);
      return;
  }
}

void PointRules::add(VertexId v, VertexRule rule, Phase phase, double weight, RowBuilder& row) const {
  switch (rule) {
    case VertexRule::interior:
      scheme_->add_interior_point(v, weight, row);
      return;
    case VertexRule::corner:
      row.add(v, weight);
      return;
    case VertexRule::crease:
      row.add(v, weight * 6 / 8);
      solid_->for_each_edge(v, [&](EdgeId e) {
        if (skin_.rule(e, phase) == EdgeRule::crease) row.add(solid_->other_vertex(e, v), weight / 8);
      });
      return;
    case VertexRule::smooth:
      scheme_->add_skin_point(v, phase, weight, row);
      return;
  }
}

}  // namespace argil::subdiv
