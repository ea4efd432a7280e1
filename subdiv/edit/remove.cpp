#include "subdiv/edit/remove.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/error.h"

namespace argil::subdiv {

void remove_cells(Transaction& transaction, std::span<const CellId> cells, Dangling dangling) {
  std::vector<CellId> sorted(cells.begin(), cells.end());
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (!transaction.solid().is_live(sorted[i]) || (i > 0 && sorted[i] == sorted[i - 1]))
      throw Error(ErrorCode::not_found,
                  fmt::format("cell {} to remove is not there or given twice; select cells again", sorted[i].value),
                  fmt::format("cell {}", sorted[i].value));
  for (const CellId c : sorted) {
    for (const FaceUseId use : transaction.solid().cell_face_uses(c)) transaction.set_sharpness(face_of(use), 0);
    transaction.remove_cell(c, dangling == Dangling::remove);
  }
}

Swept remove_dangling(Transaction& transaction) {
  const Solid& solid = transaction.solid();
  Swept swept;
  for (const FaceId f : solid.faces())
    if (!solid.owner(face_use(f, false)).valid() && !solid.owner(face_use(f, true)).valid()) {
      transaction.remove_face(f);
      ++swept.faces;
    }
  for (const EdgeId e : solid.edges())
    if (solid.edge_valence(e) == 0) {
      transaction.remove_edge(e);
      ++swept.edges;
    }
  for (const VertexId v : solid.vertices())
    if (solid.vertex_valence(v) == 0) {
      transaction.remove_vertex(v);
      ++swept.vertices;
    }
  return swept;
}

}  // namespace argil::subdiv
