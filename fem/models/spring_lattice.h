#pragma once
// The springs of a mass–spring body as lines between nodes, for pictures (papers/001, Figs. 1 and 4). Springs of
// neighbours add (METHODS §4), so that a line may stand for those of several cubes. What a model adds to them, its
// volume energy, corrections and hourglass springs, is no spring between two nodes and has no line.

#include <cstdint>
#include <span>
#include <vector>

#include "fem/element_block.h"
#include "fem/models/mass_spring.h"

namespace argil::fem {

enum class SpringKind { edge, face_diagonal, inner_diagonal };

struct LatticeSpring {
  SpringKind kind = SpringKind::edge;
  std::uint32_t from = 0, to = 0;  // rows of the node table, from < to
  auto operator<=>(const LatticeSpring&) const = default;
};

/// Each spring once, edges first, then face diagonals, then inner ones, each by `from`, then `to`. `keep_cells`
/// says which cells of the finest level to take, by id; empty: all.
/// @throws Error (unsupported) naming an element kind other than trilinear hexahedra. Cost O(elements log
/// elements).
[[nodiscard]] std::vector<LatticeSpring> spring_lattice(std::span<const ElementBlock> blocks,
                                                        DiagonalSprings diagonals,
                                                        std::span<const std::uint8_t> keep_cells = {});

}  // namespace argil::fem
