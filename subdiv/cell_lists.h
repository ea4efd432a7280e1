#pragma once
// A volume mesh as files hold it: points and lists of cells, before it becomes a solid. `build` turns it into one.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace argil::subdiv {

/// Vertex orders are those of VTK (VTK_TETRA 10, VTK_HEXAHEDRON 12, VTK_WEDGE 13, VTK_PYRAMID 14, VTK_POLYHEDRON
/// 42).
enum class CellKind : std::uint8_t { tetrahedron, pyramid, wedge, hexahedron, polyhedron };

/// Cell c has kinds[c] and the numbers connectivity[offsets[c] … offsets[c+1]): its vertices, in VTK's order; of a
/// polyhedron its face stream: number of faces, then for each face its size and its vertices, seen
/// counter-clockwise from outside.
struct CellLists {
  Eigen::Matrix3Xd positions;  // 3 x V [m]
  std::vector<CellKind> kinds;
  std::vector<std::size_t> offsets{0};
  std::vector<std::uint32_t> connectivity;

  std::size_t cell_count() const { return kinds.size(); }
};

}  // namespace argil::subdiv
