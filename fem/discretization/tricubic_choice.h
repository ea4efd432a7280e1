#pragma once
// Which cells become tricubic elements, and at which level: the coarsest at which a cell is regular and the fields
// are trilinear over it (METHODS §2).

#include <vector>

#include "fem/discretization.h"

namespace argil::fem {

struct TricubicChoice {
  std::vector<std::vector<subdiv::CellId>> cells;  // per level, ascending
  std::vector<std::uint8_t> left;                  // per cell of the finest level: stays linear
};

[[nodiscard]] TricubicChoice choose_tricubic(const subdiv::Refinement& refinement, const NodalFields& fields);

/// Per level, the vertex of the finest level that every vertex becomes.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> finest_vertices(const subdiv::Refinement& refinement);

}  // namespace argil::fem
