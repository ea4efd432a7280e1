#pragma once
// Cutting a face in two by an edge between two of its vertices.

#include <optional>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// Both cells at the face get the two halves; no vertex is made. `next_edges` is the new edge.
/// @throws Error before anything is changed: (not_found) for a face or vertex that is not there; (bad_input) for a
/// vertex that is not of the face, two that are neighbours on it, or two that an edge joins elsewhere. Cost O(cells
/// at the face).
[[nodiscard]] Edit cut_face(Transaction& transaction, FaceId face, VertexId from, VertexId to);

/// The one face that holds both vertices but not an edge between them, the boundary's before those inside. @throws
/// Error (bad_input) if there is none or more than one.
[[nodiscard]] FaceId face_between(const Solid& solid, VertexId from, VertexId to);

}  // namespace argil::subdiv
