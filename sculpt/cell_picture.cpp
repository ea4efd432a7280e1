#include "sculpt/cell_picture.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "subdiv/error.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

using subdiv::CellData;
using subdiv::CellId;
using subdiv::FaceUseId;
using subdiv::Solid;
using subdiv::VertexId;

SceneSurface separate_cells(const Solid& solid, const Eigen::Matrix3Xd& positions, double size,
                            const CellData<std::uint8_t>& kept) {
  assert(static_cast<std::size_t>(positions.cols()) >= solid.vertex_capacity());
  assert(kept.size() == 0 || kept.size() >= solid.cell_capacity());
  SceneSurface surface;
  std::vector<std::uint32_t> vertices;  // of one cell, ascending
  for (const CellId cell : solid.cells()) {
    if (kept.size() > 0 && kept[cell] == 0) continue;
    vertices.clear();
    for (const FaceUseId use : solid.cell_face_uses(cell))
      for (const VertexId v : solid.face_vertices(subdiv::face_of(use))) vertices.push_back(v.value);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t v : vertices) middle += positions.col(v) / static_cast<double>(vertices.size());
    if (!middle.allFinite())
      throw Error(ErrorCode::bad_geometry,
                  "expected finite coordinates to draw, found one that is not; undo to the last good state",
                  "cell " + std::to_string(cell.value));
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (const std::uint32_t v : vertices) {
      surface.positions.push_back((middle + size * (positions.col(v) - middle)).cast<float>());
      surface.vertex_from_surface.push_back(v);
    }
    const auto corner = [&](VertexId v) {
      return first + static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v.value) -
                                                vertices.begin());
    };
    for (const FaceUseId use : solid.cell_face_uses(cell)) {
      const auto loop = solid.face_vertices(subdiv::face_of(use));
      for (std::size_t i = 0; i < loop.size(); ++i) {
        surface.corners.push_back(corner(loop[subdiv::is_back(use) ? loop.size() - 1 - i : i]));
        const std::uint32_t a = corner(loop[i]), b = corner(loop[(i + 1) % loop.size()]);
        surface.wire.push_back({std::min(a, b), std::max(a, b)});
      }
      surface.offsets.push_back(surface.corners.size());
      surface.cell_from_face.push_back(cell.value);
      surface.cut_faces.push_back(0);
    }
  }
  std::sort(surface.wire.begin(), surface.wire.end());
  surface.wire.erase(std::unique(surface.wire.begin(), surface.wire.end()), surface.wire.end());
  surface.sharp_edges = surface.wire;
  return surface;
}

void show_cell_kinds(Scene& scene, const Solid& solid) {
  SceneSurface& surface = scene.surface;
  const CellData<subdiv::CellClass> classes = subdiv::classify_cells(solid);
  const auto kind_of = [&](std::uint32_t cell) -> std::size_t {
    switch (classes[CellId{cell}]) {
      case subdiv::CellClass::regular_published:
        return 0;
      case subdiv::CellClass::regular_boundary:
        return 1;
      case subdiv::CellClass::extraordinary:
        return 2;
      case subdiv::CellClass::irregular:
        break;
    }
    return 3;
  };
  constexpr std::array k_names{"regular", "regular, at the boundary", "extraordinary", "irregular"};
  SceneLegend legend{"cells", "", 0, 10, ColourMap::kinds, std::vector<std::string>(k_names.size())};
  surface.values.assign(surface.positions.size(), 0);
  for (std::size_t face = 0; face + 1 < surface.offsets.size(); ++face) {
    const std::size_t kind = kind_of(surface.cell_from_face[face]);
    legend.names[kind] = k_names[kind];
    for (std::size_t c = surface.offsets[face]; c < surface.offsets[face + 1]; ++c)
      surface.values[surface.corners[c]] = static_cast<float>(kind);
  }
  scene.legend = std::move(legend);
}

}  // namespace argil::sculpt
