#include "subdiv/point_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

bool is_infinitely_sharp(double sharpness) {
  return sharpness >= k_infinitely_sharp;
}

std::string name(const Solid& solid, EdgeId e) {
  const auto& ends = solid.edge_vertices(e);
  return fmt::format("edge {} (vertices {} and {})", e.value, ends[0].value, ends[1].value);
}
std::string name(VertexId v) {
  return fmt::format("vertex {}", v.value);
}

void check_sharpness(double sharpness, bool boundary, const std::string& where) {
  if (sharpness == 0) return;
  if (!is_infinitely_sharp(sharpness))
    throw Error(
        ErrorCode::unsupported,
        fmt::format("{} is semi-sharp: expected sharpness 0 or at least {}, found {}; set it to one of these",
                    where, k_infinitely_sharp, sharpness),
        where);
  if (!boundary)
    throw Error(
        ErrorCode::unsupported,
        fmt::format("{} is sharp inside the solid: only the boundary can be sharp; set its sharpness to 0", where),
        where);
}

// The boundary about a vertex: its boundary edges, how they are sharp, and into how many pieces that share no edge
// its boundary faces fall.
struct BoundaryStar {
  std::size_t edge_count = 0, sharp_count = 0, non_manifold_count = 0, piece_count = 0;
};

BoundaryStar boundary_star(const Solid& solid, VertexId v) {
  BoundaryStar star;
  std::vector<std::pair<FaceId, EdgeId>> sides;  // boundary faces at v, with each of their two edges at v
  solid.for_each_edge(v, [&](EdgeId e) {
    std::size_t count = 0;
    solid.for_each_face(e, [&](FaceId f) {
      if (!solid.is_boundary(f)) return;
      ++count;
      sides.push_back({f, e});
    });
    if (count == 0) return;
    ++star.edge_count;
    if (count > 2) ++star.non_manifold_count;
    if (count > 2 || is_infinitely_sharp(solid.edge_sharpness(e))) ++star.sharp_count;
  });

  std::vector<std::size_t> piece(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) piece[i] = i;
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = 0; j < sides.size(); ++j)
        if ((sides[i].first == sides[j].first || sides[i].second == sides[j].second) && piece[j] < piece[i]) {
          piece[i] = piece[j];
          changed = true;
        }
  }
  for (std::size_t i = 0; i < sides.size(); ++i) star.piece_count += piece[i] == i ? 1 : 0;
  return star;
}

// A vertex of a non-manifold edge stays a crease only where two such edges run through it and hold all sheets
// together; where sheets end, or touch in the vertex alone, no rule of one sheet suits the others.
BoundaryVertexRule rule_of(const BoundaryStar& star, bool sharp_vertex) {
  if (sharp_vertex || star.piece_count > 1) return BoundaryVertexRule::corner;
  if (star.non_manifold_count > 0)
    return star.non_manifold_count == 2 && star.sharp_count == 2 ? BoundaryVertexRule::crease
                                                                 : BoundaryVertexRule::corner;
  if (star.sharp_count > 2) return BoundaryVertexRule::corner;
  return star.sharp_count == 2 ? BoundaryVertexRule::crease : BoundaryVertexRule::smooth;
}

}  // namespace

bool is_sharp(const Solid& solid, EdgeId boundary_edge) {
  if (is_infinitely_sharp(solid.edge_sharpness(boundary_edge))) return true;
  std::size_t count = 0;
  solid.for_each_face(boundary_edge, [&](FaceId f) { count += solid.is_boundary(f) ? 1 : 0; });
  return count > 2;
}

BoundaryVertexRule boundary_vertex_rule(const Solid& solid, VertexId boundary_vertex) {
  return rule_of(boundary_star(solid, boundary_vertex),
                 is_infinitely_sharp(solid.vertex_sharpness(boundary_vertex)));
}

PointRules::PointRules(const Solid& solid)
    : solid_(&solid), incidence_(solid), vertex_rule_(solid.vertex_capacity(), BoundaryVertexRule::smooth) {
  check_elements();
  check_interior_edges();
  set_boundary_rules();
}

void PointRules::check_elements() const {
  const Solid& s = *solid_;
  for (const FaceId f : s.faces())
    if (!s.owner(face_use(f, false)).valid() && !s.owner(face_use(f, true)).valid())
      throw Error(ErrorCode::bad_topology,
                  fmt::format("face {} belongs to no cell: only cells can be refined; `remove dangling` sweeps it",
                              f.value),
                  fmt::format("face {}", f.value));
  for (const EdgeId e : s.edges())
    if (s.edge_valence(e) == 0)
      throw Error(
          ErrorCode::bad_topology,
          fmt::format("{} belongs to no cell: only cells can be refined; `remove dangling` sweeps it", name(s, e)),
          name(s, e));
  for (const VertexId v : s.vertices()) {
    if (s.vertex_valence(v) == 0)
      throw Error(
          ErrorCode::bad_topology,
          fmt::format("{} belongs to no cell: only cells can be refined; `remove dangling` sweeps it", name(v)),
          name(v));
    check_sharpness(s.vertex_sharpness(v), incidence_.is_boundary(v), name(v));
  }
}

void PointRules::check_interior_edges() const {
  const Solid& s = *solid_;
  for (const EdgeId e : s.edges()) {
    const bool boundary = incidence_.is_boundary(e);
    if (s.edge_sharpness(e) != 0) check_sharpness(s.edge_sharpness(e), boundary, name(s, e));
    if (!boundary && s.edge_valence(e) < 3)
      throw Error(
          ErrorCode::bad_topology,
          fmt::format("{} lies inside the solid with {} faces: expected at least 3; split or merge the cells "
                      "about it",
                      name(s, e), s.edge_valence(e)),
          name(s, e));
  }
}

void PointRules::set_boundary_rules() {
  const Solid& s = *solid_;
  VertexData<std::uint8_t> too_few(s.vertex_capacity(), 0);
  parallel_for(s.vertex_capacity(), 1024, [&](std::size_t i) {
    const VertexId v{i};
    if (!incidence_.is_boundary(v)) return;
    const BoundaryStar star = boundary_star(s, v);
    vertex_rule_[v] = rule_of(star, is_infinitely_sharp(s.vertex_sharpness(v)));
    too_few[v] = vertex_rule_[v] == BoundaryVertexRule::smooth && star.edge_count < 3 ? 1 : 0;
  });
  for (const VertexId v : s.vertices())
    if (too_few[v])
      throw Error(
          ErrorCode::bad_topology,
          fmt::format("{} is smooth and has 2 edges on the boundary: expected at least 3; make it a corner, its "
                      "edges sharp, or split a face at it",
                      name(v)),
          name(v));
}

void PointRules::add_cell_point(CellId c, double weight, RowBuilder& row) const {
  row.add_mean(incidence_.vertices(c), weight);
}

void PointRules::add_face_point(FaceId f, double weight, RowBuilder& row) const {
  if (solid_->is_boundary(f)) {
    row.add_mean(solid_->face_vertices(f), weight);
    return;
  }
  row.add_mean(solid_->face_vertices(f), weight / 2);
  add_cell_point(solid_->owner(face_use(f, false)), weight / 4, row);
  add_cell_point(solid_->owner(face_use(f, true)), weight / 4, row);
}

void PointRules::add_edge_point(EdgeId e, double weight, RowBuilder& row) const {
  const auto& ends = solid_->edge_vertices(e);
  if (incidence_.is_boundary(e)) {
    const bool sharp = incidence_.boundary_face_count(e) > 2 || is_infinitely_sharp(solid_->edge_sharpness(e));
    row.add_mean(ends, sharp ? weight : weight / 2);
    if (!sharp)
      solid_->for_each_face(e, [&](FaceId f) {
        if (solid_->is_boundary(f)) row.add_mean(solid_->face_vertices(f), weight / 4);
      });
    return;
  }
  const auto n = static_cast<double>(solid_->edge_valence(e));
  if (n != 3) row.add_mean(ends, weight * (n - 3) / n);
  solid_->for_each_face(e, [&](FaceId f) {
    row.add_mean(solid_->face_vertices(f), 2 * weight / (n * n));
    // About an interior edge every cell has two faces, so each is met twice.
    add_cell_point(solid_->owner(face_use(f, false)), weight / (2 * n * n), row);
    add_cell_point(solid_->owner(face_use(f, true)), weight / (2 * n * n), row);
  });
}

void PointRules::add_vertex_point(VertexId v, double weight, RowBuilder& row) const {
  const Solid& s = *solid_;
  if (!incidence_.is_boundary(v)) {
    // Every face at v has two edges there, so the loop over edges meets it twice.
    const auto edge_count = static_cast<double>(s.vertex_valence(v));
    std::size_t face_twice = 0;
    s.for_each_edge(v, [&](EdgeId e) { face_twice += s.edge_valence(e); });
    row.add(v, weight / 8);
    s.for_each_edge(v, [&](EdgeId e) {
      row.add_mean(s.edge_vertices(e), weight * 3 / (8 * edge_count));
      s.for_each_face(e, [&](FaceId f) {
        row.add_mean(s.face_vertices(f), weight * 3 / (8 * static_cast<double>(face_twice)));
      });
    });
    const auto cells = incidence_.cells(v);
    for (const CellId c : cells) add_cell_point(c, weight / (8 * static_cast<double>(cells.size())), row);
    return;
  }
  const auto for_each_boundary_edge = [&](auto visit) {
    s.for_each_edge(v, [&](EdgeId e) {
      if (incidence_.is_boundary(e)) visit(e);
    });
  };
  switch (rule(v)) {
    case BoundaryVertexRule::corner:
      row.add(v, weight);
      return;
    case BoundaryVertexRule::crease:
      row.add(v, weight * 6 / 8);
      for_each_boundary_edge([&](EdgeId e) {
        if (is_sharp(s, e)) row.add(s.other_vertex(e, v), weight / 8);
      });
      return;
    case BoundaryVertexRule::smooth:
      double k = 0;
      for_each_boundary_edge([&](EdgeId) { k += 1; });
      if (k != 3) row.add(v, weight * (k - 3) / k);
      for_each_boundary_edge([&](EdgeId e) {
        row.add_mean(s.edge_vertices(e), weight * 2 / (k * k));
        s.for_each_face(e, [&](FaceId f) {  // met twice, as above
          if (s.is_boundary(f)) row.add_mean(s.face_vertices(f), weight / (2 * k * k));
        });
      });
      return;
  }
}

}  // namespace argil::subdiv
