#pragma once
// Radial order around an edge, and what surrounds an element. All results ascending or in a stated order.

#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

/// One fan of cells about an edge: faces[i] and faces[i+1] bound cells[i]. Closed fans have as many cells as faces
/// (faces[0] follows the last cell); open ones begin and end with a boundary face and have one cell less.
struct RadialFan {
  std::vector<FaceId> faces;
  std::vector<CellId> cells;
  bool closed = false;
};
/// The fans of an edge; each begins with its lowest boundary face (open) or lowest face (closed), fans in order of
/// these. Turning sense: from the first face through the cell that owns its front use if both sides are owned. A
/// face without cells is a fan of one face.
[[nodiscard]] std::vector<RadialFan> radial_fans(const Solid& solid, EdgeId edge);

/// In `cell`, the other face-use at `edge`.
[[nodiscard]] FaceUseId mate(const Solid& solid, FaceUseId use_of_cell, EdgeId edge);

// Each appends nothing, returns ascending ids without repeats. Cost O(size of the neighbourhood, log).
[[nodiscard]] std::vector<VertexId> cell_vertices(const Solid& solid, CellId cell);
[[nodiscard]] std::vector<EdgeId> cell_edges(const Solid& solid, CellId cell);
[[nodiscard]] std::vector<CellId> edge_cells(const Solid& solid, EdgeId edge);
[[nodiscard]] std::vector<EdgeId> vertex_edges(const Solid& solid, VertexId vertex);
[[nodiscard]] std::vector<FaceId> vertex_faces(const Solid& solid, VertexId vertex);
[[nodiscard]] std::vector<CellId> vertex_cells(const Solid& solid, VertexId vertex);
/// The loop of a face as its owner on this side sees it, counter-clockwise from outside.
[[nodiscard]] std::vector<VertexId> use_vertices(const Solid& solid, FaceUseId use);
/// Components of cells connected through faces: a number a cell (dead ids −1), and how many.
struct Components {
  CellData<int> component_from_cell;
  int count = 0;
};
[[nodiscard]] Components components(const Solid& solid);

}  // namespace argil::subdiv
