#include "subdiv/cell_kinds.h"

namespace argil::subdiv {

std::size_t vertex_count(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedron:
      return 4;
    case CellKind::pyramid:
      return 5;
    case CellKind::wedge:
      return 6;
    case CellKind::hexahedron:
      return 8;
    case CellKind::polyhedron:
      break;
  }
  return 0;
}

std::span<const std::uint8_t> face_table(CellKind kind) {
  static constexpr std::uint8_t k_tetrahedron[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3};
  static constexpr std::uint8_t k_pyramid[] = {4, 0, 3, 2, 1, 3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 0, 4};
  static constexpr std::uint8_t k_wedge[] = {3, 0, 1, 2, 3, 3, 5, 4, 4, 0, 3, 4, 1, 4, 1, 4, 5, 2, 4, 2, 5, 3, 0};
  static constexpr std::uint8_t k_hexahedron[] = {4, 0, 3, 2, 1, 4, 4, 5, 6, 7, 4, 0, 1, 5, 4,
                                                  4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0, 4, 7};
  switch (kind) {
    case CellKind::tetrahedron:
      return k_tetrahedron;
    case CellKind::pyramid:
      return k_pyramid;
    case CellKind::wedge:
      return k_wedge;
    case CellKind::hexahedron:
      return k_hexahedron;
    case CellKind::polyhedron:
      break;
  }
  return {};
}

std::string_view name(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedron:
      return "tetrahedron";
    case CellKind::pyramid:
      return "pyramid";
    case CellKind::wedge:
      return "wedge";
    case CellKind::hexahedron:
      return "hexahedron";
    case CellKind::polyhedron:
      break;
  }
  return "polyhedron";
}

}  // namespace argil::subdiv
