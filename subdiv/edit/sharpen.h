#pragma once
// Sharp edges and corners of the boundary, within a transaction. Sharpness is all or nothing: 0 or
// k_infinitely_sharp.

#include <span>

#include "subdiv/transaction.h"

namespace argil::subdiv {

/// Gives every edge, or vertex, the sharpness.
/// @throws Error before anything is changed: (unsupported) for a sharpness other than 0 or k_infinitely_sharp, and
/// naming an interior edge or vertex (0 is taken there); (not_found) naming a dead one.
void sharpen(Transaction& transaction, std::span<const EdgeId> edges, double sharpness);
void sharpen(Transaction& transaction, std::span<const VertexId> vertices, double sharpness);

}  // namespace argil::subdiv
