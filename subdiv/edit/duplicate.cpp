#include "subdiv/edit/duplicate.h"

#include <fmt/format.h>

#include "subdiv/edit/join.h"
#include "subdiv/error.h"

namespace argil::subdiv {

Edit duplicate(Transaction& transaction, std::span<const CellId> cells, int count, const Eigen::Affine3d& step) {
  if (cells.empty()) throw Error(ErrorCode::bad_input, "expected cells to copy, found none; select some first");
  for (const CellId c : cells)
    if (!transaction.solid().is_live(c))
      throw Error(ErrorCode::not_found, fmt::format("there is no cell {}; select cells again", c.value),
                  fmt::format("cell {}", c.value));
  if (count < 1) throw Error(ErrorCode::bad_input, fmt::format("expected at least 1 copy, found {}", count));
  if (step.matrix().isIdentity(0))
    throw Error(ErrorCode::bad_input,
                "the copies would stand where the cells are; give a way by which to move or turn them");
  if (!(step.linear().determinant() > 0))
    throw Error(ErrorCode::bad_input, "the copies would be inside out; use `mirror`");
  Edit edit;
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  for (int i = 0; i < count; ++i) {
    place = step * place;
    const CopiedCells copies = copy_cells(transaction, cells);
    for (const auto& [source, copy] : copies.copy_from_vertex)
      edit.placed.push_back({copy, {{source, 1.0}}, place.translation(), place.linear()});
    for (const auto& [copy, source] : copies.cells) edit.next_cells.push_back(copy);
  }
  return edit;
}

}  // namespace argil::subdiv
