#pragma once
// From cell lists (a file, a primitive) to a solid, with every fault named; and the raw builder that refinement
// uses.

#include <Eigen/Core>
#include <span>

#include "subdiv/cell_lists.h"
#include "subdiv/solid.h"

namespace argil::subdiv {

struct Built {
  Solid solid;                                   // cell ids are the numbers of the lists
  Eigen::Matrix3Xd positions;                    // 3 x V [m]
  std::vector<std::uint32_t> point_from_vertex;  // ascending; shorter than the lists' points where some are unused
};

/// @throws Error (bad_topology, bad_geometry; `where` names the cell): a cell that is open or not a sphere, a face
/// used three times, two cells on the same side of a face (incoherent orientation), a vertex repeated in a cell or
/// out of range, a non-finite coordinate. Points that no cell uses are left out; callers report how many. Cost
/// O(corners) expected.
[[nodiscard]] Built build(const CellLists& lists);

/// The lists that `build` would take: hexahedra, tetrahedra, wedges and pyramids are recognised and given in VTK's
/// order, the rest are polyhedra. Dead ids are squeezed out; order of ids kept.
[[nodiscard]] CellLists cell_lists(const Solid& solid, const Eigen::Matrix3Xd& positions);

/// Kind of a cell by its topology.
[[nodiscard]] CellKind cell_kind(const Solid& solid, CellId cell);
/// Vertices of a non-polyhedral cell in VTK's order: from its vertex of lowest id, deterministic.
[[nodiscard]] std::vector<VertexId> vtk_vertices(const Solid& solid, CellId cell);

/// Assembles a solid at one go, without recording; the caller answers for its validity.
class Builder {
 public:
  void reserve(std::size_t vertices, std::size_t edges, std::size_t faces, std::size_t corners, std::size_t cells,
               std::size_t uses);
  VertexId add_vertex() { return solid_.push_vertex(); }
  EdgeId add_edge(VertexId a, VertexId b) { return solid_.push_edge(a, b); }
  FaceId add_face(std::span<const VertexId> loop, std::span<const EdgeId> edges) {
    return solid_.push_face(loop, edges);
  }
  CellId add_cell(std::span<const FaceUseId> uses) { return solid_.push_cell(uses); }
  void set_sharpness(EdgeId e, double s) { solid_.edges_[e.index()].sharpness = s; }
  void set_sharpness(VertexId v, double s) { solid_.vertex_sharpness_[v.index()] = s; }
  void set_sharpness(FaceId f, double s) { solid_.faces_[f.index()].sharpness = s; }
  const Solid& solid() const { return solid_; }
  Solid finish() { return std::move(solid_); }

 private:
  Solid solid_;
};

}  // namespace argil::subdiv
