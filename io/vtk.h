#pragma once
// Legacy VTK files (.vtk), versions 2.0 to 5.1, ASCII and BINARY (big endian), DATASET UNSTRUCTURED_GRID.
// Read: cells in the classic and in the 5.1 form (OFFSETS, CONNECTIVITY), polyhedra as face streams; point and cell
// SCALARS, VECTORS, NORMALS, TENSORS, TEXTURE_COORDINATES, FIELD, GLOBAL_IDS. Passed over, as is usual: the data
// set's own FIELD (before POINTS), METADATA and colour tables. Refused by name: kinds of cell and of number not
// held. Written: version 4.2, ASCII (shortest decimals that read back exactly) or BINARY, fields as FIELD arrays.
// Sets of points and cells are arrays of 0 and 1 named "set:NAME".

#include <string>
#include <string_view>

#include "io/volume_mesh.h"

namespace argil::io {

/// @throws Error (bad_input, unsupported), `where` is "name:line:column", in binary data "name: byte N".
[[nodiscard]] VolumeMesh read_vtk(std::string_view bytes, std::string_view name);

[[nodiscard]] std::string vtk_text(const VolumeMesh& mesh, const WriteOptions& options = {});

}  // namespace argil::io
