#pragma once
// Cutting rings of hexahedra: the sheet of hexahedra that are joined through edges parallel to one is cut into two
// layers.

#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// From each edge the cut goes on through every hexahedron at it to the three edges parallel to it, and so on. An
/// edge is cut at `fraction` from the end of its sheet on which the vertex of lower id of the lowest edge given
/// lies. Where sheets cross, or one crosses itself, hexahedra are cut into 4 or 8. Other cells that the sheet meets
/// keep whole and get the cut edges and faces. `next_edges` are the halves of the edges given; no edge need belong
/// to a hexahedron.
/// @throws Error before anything is changed: as `checked` (cuts.h); (bad_input) unless 0 < fraction < 1;
/// (bad_topology) naming an edge at which a sheet comes back the other way round (a Möbius band), unless fraction
/// is 1/2. Cost O(cells of the sheets and about them).
[[nodiscard]] Edit cut_rings(Transaction& transaction, std::span<const EdgeId> edges, double fraction);

}  // namespace argil::subdiv
