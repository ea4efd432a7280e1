#pragma once
// Abaqus and CalculiX input files (.inp): the mesh of one part, and its sets.
// Held: *NODE, *ELEMENT of C3D4, C3D5 (a pyramid, which CalculiX lacks), C3D6, C3D8 and their variants (C3D8R,
// C3D8I …), *NSET and *ELSET (GENERATE, names of other sets), NSET= on *NODE and ELSET= on *ELEMENT. Keywords do
// not tell capitals from small letters, nor do names of sets. Passed over: flat elements, and what is not mesh
// (materials, steps, …). Refused by name: *INCLUDE, generated nodes and elements, several parts or instances,
// curved elements. Abaqus' wedge winds against VTK's: corners 1, 2 and 4, 5 are exchanged on the way; the other
// kinds agree. Points and cells are numbered in the order of the file's own numbers.

#include <string>
#include <string_view>

#include "io/volume_mesh.h"

namespace argil::io {

/// @throws Error (bad_input, unsupported), `where` is "name:line:column".
[[nodiscard]] VolumeMesh read_abaqus(std::string_view text, std::string_view name);

/// @throws Error (unsupported) naming what the format cannot hold.
[[nodiscard]] std::string abaqus_text(const VolumeMesh& mesh, const WriteOptions& options = {});

}  // namespace argil::io
