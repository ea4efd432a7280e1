#pragma once
// Measures of a solid: volume and inertia, quality of cells, what kinds there are. A face is fanned into triangles
// about the mean of its vertices, so that neighbouring cells share the same, possibly bent, face and the volumes of
// a solid's cells add up (exact for planar faces). `positions` is 3 x vertex capacity [m].

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>

#include "subdiv/build.h"

namespace argil::subdiv {

/// [m³]; negative for a cell that is inside out.
[[nodiscard]] double cell_volume(const Solid& solid, const Eigen::Matrix3Xd& positions, CellId cell);

/// At unit density, summed over the cells in the order of their ids.
struct MassProperties {
  double volume = 0;                                  // [m³]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   // [m]; the mean of the vertices where the volume is 0
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre, ∫ |r|² I − r rᵀ dV [m⁵]
};
[[nodiscard]] MassProperties mass_properties(const Solid& solid, const Eigen::Matrix3Xd& positions);

struct WorstCell {
  CellId cell;  // the first with the value
  double value = 0;
};
/// Verdict's scaled Jacobian of a hexahedron: the smallest determinant of the three unit edge vectors at its eight
/// corners and of the unit principal axes at its centre; 1 for a box, 0 where an edge vanishes.
[[nodiscard]] double scaled_jacobian(const Solid& solid, const Eigen::Matrix3Xd& positions, CellId hexahedron);
/// Smallest over the hexahedra; absent if there are none.
[[nodiscard]] std::optional<WorstCell> min_scaled_jacobian(const Solid& solid, const Eigen::Matrix3Xd& positions);

struct InvertedCells {
  std::size_t count = 0;
  CellId first;  // lowest id, invalid if there is none
};
/// Cells of negative volume.
[[nodiscard]] InvertedCells inverted_cells(const Solid& solid, const Eigen::Matrix3Xd& positions);

/// How many interior edges have so many faces.
[[nodiscard]] std::map<std::size_t, std::size_t> interior_edge_valences(const Solid& solid);
/// How many cells are of each kind, indexed by CellKind.
[[nodiscard]] std::array<std::size_t, 5> cell_kind_counts(const Solid& solid);

}  // namespace argil::subdiv
