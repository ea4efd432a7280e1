#pragma once
// OpenVolumeMesh files (.ovm), ASCII: vertices, edges, faces by half-edges, polyhedra by half-faces.
// A half-face of a cell is seen clockwise from outside (its normal points into the cell), as OpenVolumeMesh
// assumes. Held: properties of vertices and cells (VProp, CProp) of one number, or of 2 to 4 (vec3d …), as fields;
// of type bool named "set:NAME", at faces too, as sets. Other properties are passed over. Cells come back as
// tetrahedra, hexahedra, wedges and pyramids where they are such and the cells make a solid, their corners from the
// lowest one.

#include <string>
#include <string_view>

#include "io/volume_mesh.h"

namespace argil::io {

/// @throws Error (bad_input, unsupported), `where` is "name:line:column".
[[nodiscard]] VolumeMesh read_ovm(std::string_view text, std::string_view name);

/// @throws Error (unsupported) naming what the format cannot hold; what `subdiv::build` throws where the cells do
/// not make a solid, since their faces must be shared.
[[nodiscard]] std::string ovm_text(const VolumeMesh& mesh, const WriteOptions& options = {});

[[nodiscard]] bool ovm_holds_field(const NamedField& field);

}  // namespace argil::io
