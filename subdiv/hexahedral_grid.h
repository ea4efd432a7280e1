#pragma once
// Hexahedra as boxes of a grid: a frame for each, which of its sides are boundary, and which vertices have the
// neighbourhood and the rules of a grid, inside it or where it ends (METHODS §2).

#include <array>
#include <optional>
#include <span>

#include "subdiv/incidence.h"
#include "subdiv/neighbourhood.h"

namespace argil::subdiv {

/// The eight vertices of a hexahedron, index 4i + 2j + k: one bit a direction.
using Box = std::array<VertexId, 8>;
inline constexpr std::array<unsigned, 3> k_direction_bit{4, 2, 1};

/// In the frame of box_vertices(); nothing if the cell is no hexahedron.
[[nodiscard]] std::optional<Box> find_box(const Solid& solid, CellId cell);
/// Index of a vertex in a box, 8 if it is not there.
[[nodiscard]] inline unsigned place_in_box(const Box& box, VertexId v) {
  unsigned i = 0;
  while (i < 8 && box[i] != v) ++i;
  return i;
}

/// Which of the six sides of a hexahedron are boundary: [direction][0 low, 1 high].
using BoxSides = std::array<std::array<bool, 2>, 3>;
[[nodiscard]] BoxSides boundary_sides(const Solid& solid, CellId cell, const Box& box);

class HexahedralGrid {
 public:
  /// Cost O(cell corners), in parallel. The solid must outlive the grid.
  explicit HexahedralGrid(const Solid& solid);

  bool is_hexahedron(CellId c) const { return boxes_[c][0].valid(); }
  const Box& box(CellId hexahedron) const { return boxes_[hexahedron]; }
  std::span<const CellId> cells(VertexId v) const { return incidence_.cells(v); }
  CellClass classify(CellId c) const;

 private:
  static constexpr std::uint8_t k_not_regular = 255;
  // In how many directions the grid ends at a vertex whose rules are those of a tensor product, or k_not_regular.
  std::uint8_t count_sides(VertexId v) const;

  const Solid& solid_;
  Incidence incidence_;
  CellData<Box> boxes_;
  VertexData<std::uint8_t> sides_from_vertex_;
};

}  // namespace argil::subdiv
