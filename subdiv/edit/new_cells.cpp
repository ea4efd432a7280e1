#include "subdiv/edit/new_cells.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/cell_check.h"
#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

using Loop = std::vector<VertexId>;

std::string name_of(CellId c) {
  return c.valid() ? fmt::format("cell {}", c.value) : "the new cell";
}

// The cell that sees the loop counter-clockwise from outside now.
CellId owner_of(const Solid& solid, const Loop& loop) {
  const auto face = solid.find_face(loop);
  if (!face) return {};
  const auto stored = solid.face_vertices(*face);
  const auto start = static_cast<std::size_t>(std::find(stored.begin(), stored.end(), loop[0]) - stored.begin());
  return solid.owner(face_use(*face, stored[(start + 1) % stored.size()] != loop[1]));
}

void check_sphere(const NewCell& cell) {
  CellLoops check;
  for (const Loop& loop : cell.loops) {
    for (const VertexId v : loop) check.corners.push_back(v.value);
    check.end_face();
  }
  if (const std::string fault = sphere_fault(check); !fault.empty())
    throw Error(
        ErrorCode::bad_topology,
        fmt::format("{} would not be one ball ({}); choose fewer or other elements, or split the cells there "
                    "first",
                    name_of(cell.source), fault),
        name_of(cell.source));
}

}  // namespace

void check_new_cells(const Solid& solid, const Rewrite& change) {
  std::vector<CellId> removed = change.removed;
  std::sort(removed.begin(), removed.end());
  std::map<Loop, CellId> sides;
  for (const NewCell& cell : change.added) {
    check_sphere(cell);
    for (Loop loop : cell.loops) {
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      const auto [at, fresh] = sides.try_emplace(loop, cell.source);
      const CellId other = fresh ? owner_of(solid, loop) : at->second;
      if (fresh && (!other.valid() || std::binary_search(removed.begin(), removed.end(), other))) continue;
      throw Error(ErrorCode::bad_topology,
                  fmt::format("{} and {} would lie on the same side of a face and overlap; choose other faces, or "
                              "move what is in the way first",
                              name_of(other), name_of(cell.source)),
                  name_of(cell.source));
    }
  }
}

}  // namespace argil::subdiv
