#include "fem/discretization/linear_mesh.h"

#include "fmt/format.h"
#include "subdiv/build.h"
#include "subdiv/error.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"

namespace argil::fem {

using subdiv::CellId;
using subdiv::Solid;
using subdiv::VertexId;

namespace {

void check_quadrilateral(const Solid& solid, subdiv::FaceId face, CellId cell) {
  const std::size_t corners = solid.face_vertices(face).size();
  if (corners == 4) return;
  throw Error(
      ErrorCode::unsupported,
      fmt::format("Elements are made of hexahedra and of cells with quadrilateral faces, but a face of this "
                  "cell has {} corners. Refine at least once: levels 1.",
                  corners),
      fmt::format("level 0, cell {}", cell.value));
}

}  // namespace

void check_quadrilaterals(const Solid& solid) {
  for (const CellId c : solid.cells())
    for (const subdiv::FaceUseId use : solid.cell_face_uses(c)) check_quadrilateral(solid, subdiv::face_of(use), c);
}

LinearMesh mesh_linearly(const LinearCells& from) {
  LinearMesh mesh;
  mesh.centres.column_count = from.solid->vertex_capacity();
  for (const CellId c : from.cells) {
    const ElementOrigin origin{static_cast<std::uint16_t>(from.level), c.value, 0};
    if (subdiv::cell_kind(*from.solid, c) == subdiv::CellKind::hexahedron) {
      for (const VertexId v : subdiv::box_vertices(*from.solid, c)) mesh.hexahedra.push_back(v.value);
      mesh.hexahedron_origins.push_back(origin);
      continue;
    }
    const auto centre = static_cast<std::uint32_t>(mesh.centres.row_count());
    std::uint32_t part = 0;
    for (const subdiv::FaceUseId use : from.solid->cell_face_uses(c)) {
      check_quadrilateral(*from.solid, subdiv::face_of(use), c);
      const auto loop = subdiv::use_vertices(*from.solid, use);
      for (std::size_t i = 4; i-- > 0;) mesh.pyramids.push_back(loop[i].value);  // seen from inside
      mesh.pyramids.push_back(centre);
      mesh.pyramid_origins.push_back({origin.level, origin.cell, part++});
    }
    std::vector<std::uint32_t> columns;
    for (const VertexId v : subdiv::cell_vertices(*from.solid, c)) columns.push_back(v.value);
    mesh.centres.append(columns, std::vector<double>(columns.size(), 1.0 / static_cast<double>(columns.size())));
  }
  return mesh;
}

}  // namespace argil::fem
