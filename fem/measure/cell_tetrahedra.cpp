#include "fem/measure/cell_tetrahedra.h"

#include <algorithm>

#include "subdiv/radial_edge.h"

namespace argil::fem {

using namespace subdiv;

namespace {

constexpr std::uint32_t k_none = 0xffffffffU;

std::uint32_t add_middle(CellTetrahedra& cut, std::vector<VertexId> vertices) {
  std::sort(vertices.begin(), vertices.end());
  std::vector<std::uint32_t> columns;
  for (const VertexId v : vertices) columns.push_back(v.value);
  const std::vector<double> weights(columns.size(), 1.0 / static_cast<double>(columns.size()));
  cut.points.append(columns, weights);
  return static_cast<std::uint32_t>(cut.points.row_count() - 1);
}

}  // namespace

CellTetrahedra cell_tetrahedra(const Solid& solid, const CellData<std::uint8_t>& kept) {
  CellTetrahedra cut;
  cut.points = Stencils::identity(solid.vertex_capacity());
  std::vector<std::uint32_t> middle_from_face(solid.face_capacity(), k_none);
  for (const CellId cell : solid.cells()) {
    if (kept.size() > 0 && kept[cell] == 0) continue;
    const std::uint32_t middle = add_middle(cut, cell_vertices(solid, cell));
    for (const FaceUseId use : solid.cell_face_uses(cell)) {
      const std::vector<VertexId> loop = use_vertices(solid, use);
      std::uint32_t& of_face = middle_from_face[face_of(use).index()];
      if (of_face == k_none) of_face = add_middle(cut, loop);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        cut.corners.push_back({loop[(i + 1) % loop.size()].value, loop[i].value, of_face, middle});
        cut.cells.push_back(cell.value);
      }
    }
  }
  return cut;
}

}  // namespace argil::fem
