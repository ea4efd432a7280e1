#pragma once
// The cells at one vertex, cut out of their solid: at every level to come, the points about the vertex depend on
// nothing else.

#include "subdiv/rule_set.h"
#include "subdiv/solid.h"
#include "subdiv/stencils.h"

namespace argil::subdiv {

struct LocalStar {
  Solid solid;
  VertexId centre;
  Stencils rows;                             // vertices of `solid` in the vertices that the star was cut from
  std::vector<VertexId> vertex_from_column;  // ascending; what the columns of `rows` are
};

/// Sharpness comes along; what the cut lays bare is sharp, which the points about the centre do not see.
[[nodiscard]] LocalStar cut_out_star(const Solid& solid, VertexId v);
/// Refined once, and cut out again about the same vertex. @throws what refine() throws.
[[nodiscard]] LocalStar refined(const LocalStar& star, RuleSet rules);

}  // namespace argil::subdiv
