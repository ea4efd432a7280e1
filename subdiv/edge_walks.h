#pragma once
// Walks from edge to edge that follow the grain of quadrilaterals and hexahedra: loops run straight on through
// regular vertices, rings run across to the parallel edges.

#include <span>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

/// The loops through `seeds`, with them, ascending. On the boundary a loop goes on over a vertex of four boundary
/// edges and four quadrilaterals to the edge opposite; inside, over an interior vertex of six edges and twelve
/// quadrilaterals. It ends at any other vertex, where boundary sheets meet, and where it closes. Cost O(result).
[[nodiscard]] std::vector<EdgeId> edge_loops(const Solid& solid, std::span<const EdgeId> seeds);

/// The rings through `seeds`, with them, ascending: from a boundary edge across the quadrilaterals of its boundary
/// sheet, from an interior edge through hexahedra and across their faces, which gives the whole sheet of parallel
/// edges, those on the boundary included. Rings do not leap over where cells touch in an edge only. Cost O(result,
/// log).
[[nodiscard]] std::vector<EdgeId> edge_rings(const Solid& solid, std::span<const EdgeId> seeds);

}  // namespace argil::subdiv
