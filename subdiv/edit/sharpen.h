#pragma once
// Sharp edges, vertices and faces, within a transaction. Faces inside the solid that are sharp make a sheet; edges
// and vertices are sharp on the boundary and on sheets. Sharpness is 0 (smooth) to k_infinitely_sharp; between, it
// lasts for so many refinements.

#include <span>

#include "subdiv/transaction.h"

namespace argil::subdiv {

/// Gives every edge, vertex or face the sharpness. Edges and vertices that a sheet leaves when it is made smooth
/// become smooth.
/// @throws Error before anything is changed: (bad_input) for a sharpness out of range; (unsupported) naming an edge
/// or vertex inside the solid that is on no sheet, or a boundary face (0 is taken in both cases); (not_found)
/// naming a dead one. Cost O(what is named and about it).
void sharpen(Transaction& transaction, std::span<const EdgeId> edges, double sharpness);
void sharpen(Transaction& transaction, std::span<const VertexId> vertices, double sharpness);
void sharpen(Transaction& transaction, std::span<const FaceId> faces, double sharpness);

}  // namespace argil::subdiv
