#include "fem/models/spring_lattice.h"

#include <fmt/format.h>

#include <algorithm>

#include "fem/models/mass_spring_kernels.h"
#include "subdiv/error.h"
#include "subdiv/sort_unique.h"

namespace argil::fem {
namespace {

SpringKind kind_of(std::size_t spring) {
  if (spring < k_edge_springs) return SpringKind::edge;
  return spring < k_edge_springs + k_face_springs ? SpringKind::face_diagonal : SpringKind::inner_diagonal;
}

bool has(DiagonalSprings diagonals, SpringKind kind) {
  switch (kind) {
    case SpringKind::edge:
      return true;
    case SpringKind::face_diagonal:
      return diagonals != DiagonalSprings::inner;
    case SpringKind::inner_diagonal:
      return diagonals != DiagonalSprings::faces;
  }
  return false;
}

}  // namespace

std::vector<LatticeSpring> spring_lattice(std::span<const ElementBlock> blocks, DiagonalSprings diagonals,
                                          std::span<const std::uint8_t> keep_cells) {
  std::vector<LatticeSpring> springs;
  for (const ElementBlock& block : blocks) {
    if (block.kind != &trilinear_hexahedron())
      throw Error(ErrorCode::unsupported,
                  fmt::format("springs stand in trilinear hexahedra, but this body has {} elements of kind {}; use "
                              "the default space and cells that are boxes",
                              block.element_count(), block.kind->name));
    for (std::size_t element = 0; element < block.element_count(); ++element) {
      if (!keep_cells.empty() && keep_cells[block.origins[element].cell] == 0) continue;
      const std::uint32_t* nodes = block.nodes.data() + element * 8;
      for (std::size_t s = 0; s < k_springs; ++s) {
        if (!has(diagonals, kind_of(s))) continue;
        const std::uint32_t a = nodes[spring_ends(s).from], b = nodes[spring_ends(s).to];
        springs.push_back({kind_of(s), std::min(a, b), std::max(a, b)});
      }
    }
  }
  subdiv::sort_unique(springs);
  return springs;
}

}  // namespace argil::fem
