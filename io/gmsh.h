#pragma once
// Gmsh meshes (.msh), versions 4.1 and 2.2, ASCII and binary (either byte order when reading).
// Held: tetrahedra, hexahedra, prisms, pyramids of first order; physical groups of points, surfaces and volumes as
// sets of points, faces and cells; $NodeData and $ElementData of one time step. Surfaces are faces where a group
// names them, else passed over; lines are passed over, and so are sections that say nothing about cells. Refused by
// name: curved elements, polyhedra, partitioned and parametric meshes. Gmsh's prism winds against VTK's wedge
// (its first triangle faces the second): corners 1, 2 and 4, 5 are exchanged on the way; the other kinds agree.
// Written: nodes and cells tagged from 1 in their order (4.1: grouped by the sets they are in and by kind, so cells
// of mixed kinds may change their order on reading back what other programs wrote, not what Argil did: the tags
// tell).

#include <string>
#include <string_view>

#include "io/volume_mesh.h"

namespace argil::io {

/// @throws Error (bad_input, unsupported), `where` is "name:line:column", in binary parts "name: byte N".
[[nodiscard]] VolumeMesh read_gmsh(std::string_view bytes, std::string_view name);

/// @throws Error (unsupported) naming what Gmsh cannot hold.
[[nodiscard]] std::string gmsh_bytes(const VolumeMesh& mesh, const WriteOptions& options = {});

/// Gmsh shows data of 1, 3 or 9 components.
[[nodiscard]] bool gmsh_holds_field(const NamedField& field);

}  // namespace argil::io
