#include "io/gmsh_elements.h"

#include <algorithm>
#include <cassert>

namespace argil::io {
namespace {

constexpr std::array k_elements{
    GmshElement{1, 1, 1, 2, "line"},
    GmshElement{2, 2, 1, 3, "triangle"},
    GmshElement{3, 2, 1, 4, "quadrilateral"},
    GmshElement{4, 3, 1, 4, "tetrahedron"},
    GmshElement{5, 3, 1, 8, "hexahedron"},
    GmshElement{6, 3, 1, 6, "prism"},
    GmshElement{7, 3, 1, 5, "pyramid"},
    GmshElement{8, 1, 2, 3, "line of 3 nodes"},
    GmshElement{9, 2, 2, 6, "triangle of 6 nodes"},
    GmshElement{10, 2, 2, 9, "quadrilateral of 9 nodes"},
    GmshElement{11, 3, 2, 10, "tetrahedron of 10 nodes"},
    GmshElement{12, 3, 2, 27, "hexahedron of 27 nodes"},
    GmshElement{13, 3, 2, 18, "prism of 18 nodes"},
    GmshElement{14, 3, 2, 14, "pyramid of 14 nodes"},
    GmshElement{15, 0, 1, 1, "point"},
    GmshElement{16, 2, 2, 8, "quadrilateral of 8 nodes"},
    GmshElement{17, 3, 2, 20, "hexahedron of 20 nodes"},
    GmshElement{18, 3, 2, 15, "prism of 15 nodes"},
    GmshElement{19, 3, 2, 13, "pyramid of 13 nodes"},
    GmshElement{20, 2, 3, 9, "triangle of 9 nodes"},
    GmshElement{21, 2, 3, 10, "triangle of 10 nodes"},
    GmshElement{26, 1, 3, 4, "line of 4 nodes"},
    GmshElement{27, 1, 4, 5, "line of 5 nodes"},
    GmshElement{28, 1, 5, 6, "line of 6 nodes"},
    GmshElement{29, 3, 3, 20, "tetrahedron of 20 nodes"},
    GmshElement{30, 3, 4, 35, "tetrahedron of 35 nodes"},
    GmshElement{31, 3, 5, 56, "tetrahedron of 56 nodes"},
    GmshElement{34, 2, 0, 0, "polygon"},
    GmshElement{35, 3, 0, 0, "polyhedron"},
    GmshElement{92, 3, 3, 64, "hexahedron of 64 nodes"},
    GmshElement{93, 3, 4, 125, "hexahedron of 125 nodes"},
};

}  // namespace

const GmshElement* find_gmsh_element(std::int64_t type) {
  const auto found =
      std::find_if(k_elements.begin(), k_elements.end(), [&](const GmshElement& e) { return e.type == type; });
  return found == k_elements.end() ? nullptr : &*found;
}

const GmshCell& gmsh_cell(subdiv::CellKind kind) {
  const auto found = std::find_if(k_gmsh_cells.begin(), k_gmsh_cells.end(),
                                  [&](const GmshCell& cell) { return cell.kind == kind; });
  assert(found != k_gmsh_cells.end());
  return *found;
}

}  // namespace argil::io
