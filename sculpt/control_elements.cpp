#include "sculpt/control_elements.h"

#include "sculpt/scene.h"

namespace argil::sculpt {

using namespace subdiv;

ControlElements control_elements(const Refinement& refinement) {
  const Solid& control = refinement.levels.front();
  ControlElements on{VertexData<VertexId>(control.vertex_capacity()), EdgeData<EdgeId>(control.edge_capacity()),
                     FaceData<FaceId>(control.face_capacity()), control_cells(refinement)};
  for (const VertexId v : control.vertices()) on.vertex[v] = v;
  for (const EdgeId e : control.edges()) on.edge[e] = e;
  for (const FaceId f : control.faces()) on.face[f] = f;
  for (std::size_t level = 1; level < refinement.levels.size(); ++level) {
    // A refined solid numbers what lies on vertices, edges and faces of the one before first, in their order.
    const Solid &coarse = refinement.levels[level - 1], &fine = refinement.levels[level];
    ControlElements next{VertexData<VertexId>(fine.vertex_capacity()), EdgeData<EdgeId>(fine.edge_capacity()),
                         FaceData<FaceId>(fine.face_capacity()), std::move(on.cell)};
    std::size_t vertex = 0, half_edge = 0, quarter = 0;
    for (const VertexId v : coarse.vertices()) next.vertex[VertexId{vertex++}] = on.vertex[v];
    for (const EdgeId e : coarse.edges())
      for (int half = 0; half < 2; ++half) next.edge[EdgeId{half_edge++}] = on.edge[e];
    for (const FaceId f : coarse.faces())
      for (std::size_t corner = 0; corner < coarse.face_vertices(f).size(); ++corner)
        next.face[FaceId{quarter++}] = on.face[f];
    on = std::move(next);
  }
  return on;
}

}  // namespace argil::sculpt
