#pragma once
// Integer coordinates of the vertices of a refined grid: where they would lie if every cell split in half.

#include <array>
#include <vector>

#include "subdiv/radial_edge.h"
#include "subdiv/refinement.h"

namespace argil::subdiv::test {

/// Of the finest level's vertices, in cells of that level; `unit` are the control solid's integer coordinates.
inline std::vector<Eigen::Vector3i> grid_coordinates(const Refinement& refinement, const Eigen::Matrix3Xd& unit) {
  std::vector<Eigen::Vector3i> coordinates;
  for (Eigen::Index i = 0; i < unit.cols(); ++i) coordinates.push_back(unit.col(i).array().round().cast<int>());
  for (int level = 0; level < refinement.finest(); ++level) {
    const Solid& solid = refinement.levels[static_cast<std::size_t>(level)];
    std::vector<Eigen::Vector3i> fine;
    const auto add = [&](const auto& vertices) {
      Eigen::Vector3i sum(0, 0, 0);
      for (const VertexId v : vertices) sum += 2 * coordinates[v.index()];
      fine.push_back(sum / static_cast<int>(vertices.size()));
    };
    for (const VertexId v : solid.vertices()) add(std::array{v});
    for (const EdgeId e : solid.edges()) add(solid.edge_vertices(e));
    for (const FaceId f : solid.faces()) add(solid.face_vertices(f));
    for (const CellId c : solid.cells()) add(cell_vertices(solid, c));
    coordinates = std::move(fine);
  }
  return coordinates;
}

}  // namespace argil::subdiv::test
