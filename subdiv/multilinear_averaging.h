#pragma once
// Bajaj, Schaefer, Warren and Xu, "A subdivision scheme for hexahedral meshes" (The Visual Computer 18, 2002):
// cells split multilinearly (vertices stay, the new points are centroids of edges, faces and cells), then every
// point moves to the mean of the centroids of the fine cells about it; on the skin, of the fine quadrilaterals of
// the skin.
//
// Where the paper is silent: the fine cell at a corner with k edges has 2k + 2 vertices, and its centroid is their
// mean, unweighted; a vertex of the skin sees all its quadrilaterals alike, whatever the number of sides they came
// from.

#include "subdiv/scheme.h"

namespace argil::subdiv {

[[nodiscard]] std::unique_ptr<Scheme> make_multilinear_averaging(const Solid& solid, const Incidence& incidence);

}  // namespace argil::subdiv
