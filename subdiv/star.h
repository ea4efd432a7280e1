#pragma once
// What lies about a vertex after one refinement: its own point, then one for each edge, face and cell at it, and
// every face at it is a quadrilateral. These points alone decide the limit, whatever the scheme.

#include <array>
#include <vector>

#include "subdiv/incidence.h"

namespace argil::subdiv {

struct Star {
  std::vector<EdgeId> edges;
  std::vector<FaceId> faces;
  std::vector<CellId> cells;
  std::vector<std::array<std::size_t, 2>> edges_of_face;  // places in `edges`
  std::vector<std::array<std::size_t, 2>> cells_of_face;  // places in `cells`; interior stars only

  // Places of the points, in the order vertex, edges, faces, cells.
  std::size_t edge_point(std::size_t i) const { return 1 + i; }
  std::size_t face_point(std::size_t j) const { return 1 + edges.size() + j; }
  std::size_t cell_point(std::size_t k) const { return 1 + edges.size() + faces.size() + k; }
  std::size_t point_count() const { return cell_point(cells.size()); }
};

/// The whole star of a vertex inside, or what a vertex of the skin sees of the skin.
[[nodiscard]] Star make_star(const Solid& solid, const Incidence& incidence, VertexId v);

}  // namespace argil::subdiv
