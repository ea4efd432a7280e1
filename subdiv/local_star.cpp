#include "subdiv/local_star.h"

#include <algorithm>

#include "subdiv/radial_edge.h"
#include "subdiv/refinement_step.h"
#include "subdiv/skin.h"
#include "subdiv/sort_unique.h"
#include "subdiv/transaction.h"

namespace argil::subdiv {

namespace {

// The solid's vertices in `kept`, ascending; the cut's are numbered like them.
Solid cut(const Solid& solid, VertexId v, std::vector<VertexId>& kept) {
  const std::vector<CellId> cells = vertex_cells(solid, v);
  for (const CellId c : cells) {
    const auto vertices = cell_vertices(solid, c);
    kept.insert(kept.end(), vertices.begin(), vertices.end());
  }
  sort_unique(kept);
  const auto number = [&](VertexId w) {
    return VertexId{static_cast<std::size_t>(std::lower_bound(kept.begin(), kept.end(), w) - kept.begin())};
  };

  Solid result;
  Transaction edit(result);
  for (std::size_t i = 0; i < kept.size(); ++i) edit.add_vertex();
  for (const CellId c : cells) {
    std::vector<std::vector<VertexId>> loops;
    for (const FaceUseId use : solid.cell_face_uses(c)) {
      loops.push_back(use_vertices(solid, use));
      for (VertexId& w : loops.back()) w = number(w);
    }
    edit.add_cell(loops);
  }
  const Skin skin(solid);
  for (const CellId c : cells) {
    for (const EdgeId e : cell_edges(solid, c)) {
      const double sharpness = skin.sharpness(e);
      const auto& ends = solid.edge_vertices(e);
      if (sharpness > 0) edit.set_sharpness(*result.find_edge(number(ends[0]), number(ends[1])), sharpness);
    }
    for (const FaceUseId use : solid.cell_face_uses(c)) {
      const FaceId f = face_of(use);
      if (solid.is_boundary(f) || solid.face_sharpness(f) == 0) continue;
      std::vector<VertexId> loop;
      for (const VertexId w : solid.face_vertices(f)) loop.push_back(number(w));
      edit.set_sharpness(*result.find_face(loop), solid.face_sharpness(f));
    }
  }
  for (const VertexId w : kept)
    if (w == v)
      edit.set_sharpness(number(w), skin.sharpness(w));
    else if (result.is_boundary(number(w)))
      edit.set_sharpness(number(w), k_infinitely_sharp);
  (void)edit.commit();
  return result;
}

VertexId place(const std::vector<VertexId>& sorted, VertexId v) {
  return VertexId{static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), v) - sorted.begin())};
}

}  // namespace

LocalStar cut_out_star(const Solid& solid, VertexId v) {
  LocalStar star;
  star.solid = cut(solid, v, star.vertex_from_column);
  star.centre = place(star.vertex_from_column, v);
  star.rows = Stencils::identity(star.vertex_from_column.size());
  return star;
}

LocalStar refined(const LocalStar& star, RuleSet rules) {
  const RefinementStep step = refine(star.solid, rules);  // all ids are live, so vertices keep theirs
  const Stencils rows = compose(step.stencils, star.rows);
  LocalStar result;
  std::vector<VertexId> kept;
  result.solid = cut(step.fine, star.centre, kept);
  result.centre = place(kept, star.centre);
  result.rows.column_count = rows.column_count;
  for (const VertexId v : kept) result.rows.append(rows.row(v.index()).columns, rows.row(v.index()).weights);
  result.vertex_from_column = star.vertex_from_column;
  return result;
}

}  // namespace argil::subdiv
