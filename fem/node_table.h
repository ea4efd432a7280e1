#pragma once
// The one table of nodes (DESIGN.md): every point that an element may name, as a row of A in the control points.
// Rows stand in this order: vertices of level 0, 1, … K, virtual centres, phantoms, limit points. A level whose
// vertices no element names has no rows.

#include <Eigen/Core>
#include <vector>

#include "subdiv/stencils.h"

namespace argil::fem {

struct NodeTable {
  subdiv::Stencils rows;                 // node = rows * control points
  std::vector<std::size_t> level_begin;  // first row of level l's vertices; one more entry ends the last level
  std::size_t virtual_centre_begin = 0, phantom_begin = 0, limit_begin = 0;

  std::size_t node_count() const { return rows.row_count(); }
};

}  // namespace argil::fem
