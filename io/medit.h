#pragma once
// MEDIT .mesh, ASCII, versions 1 to 4 (they differ only in their binary form), three dimensions.
// Held: tetrahedra, hexahedra, prisms, pyramids, and one integer a vertex or cell, its reference, which is the
// field "reference" (absent where all are zero). Not held: polyhedra, other fields. Passed over: surfaces, edges,
// normals and marks, by their known shape. The file lists cells kind by kind, so cells of mixed kinds change their
// order on writing. MEDIT's prism winds against VTK's wedge: corners 1, 2 and 4, 5 are exchanged on the way.

#include <string>
#include <string_view>

#include "io/volume_mesh.h"

namespace argil::io {

/// @throws Error (bad_input, unsupported), `where` is "name:line:column".
[[nodiscard]] VolumeMesh read_medit(std::string_view text, std::string_view name);

/// @throws Error (unsupported) naming what MEDIT cannot hold.
[[nodiscard]] std::string medit_text(const VolumeMesh& mesh, const WriteOptions& options = {});
/// Whether it is the one field that MEDIT holds.
[[nodiscard]] bool is_medit_reference(const NamedField& field);

}  // namespace argil::io
