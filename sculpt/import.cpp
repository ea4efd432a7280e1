#include "sculpt/import.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/error.h"
#include "subdiv/hanging_vertices.h"
#include "subdiv/inside_out.h"
#include "subdiv/sort_unique.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

std::string cells_inside_out(const std::vector<std::size_t>& cells) {
  return cells.size() == 1 ? fmt::format("cell {} is inside out", cells[0])
                           : fmt::format("{} cells are inside out, the first is cell {}", cells.size(), cells[0]);
}

void refuse_hanging_vertices(const Built& built) {
  const auto hanging = find_hanging_vertex(built.solid, built.positions);
  if (!hanging) return;
  const std::uint32_t point = built.point_from_vertex[hanging->vertex.index()];
  const Eigen::Vector3d at = built.positions.col(static_cast<Eigen::Index>(hanging->vertex.index()));
  throw Error(ErrorCode::bad_topology,
              fmt::format("expected cells that meet corner to corner; point {} at {:g} {:g} {:g} lies on a face of "
                          "cell {} and is no corner of it (a hanging node): split the larger cells, or write them "
                          "as polyhedra that have it as a corner",
                          point, at.x(), at.y(), at.z(), hanging->cell.value),
              fmt::format("point {}", point));
}

}  // namespace

Imported import_solid(io::VolumeMesh& mesh, bool repair) {
  Imported imported;
  imported.notes = std::move(mesh.notes);
  const std::vector<std::size_t> inverted = inside_out_cells(mesh.cells);
  if (!inverted.empty() && repair) {
    for (const std::size_t cell : inverted) turn_inside_out(mesh.cells, cell);
    imported.notes.push_back(cells_inside_out(inverted) + (inverted.size() == 1 ? "; it was" : "; they were") +
                             " turned round");
  }
  const bool remain = !inverted.empty() && !repair;
  try {
    imported.built = build(mesh.cells);
  } catch (const Error& error) {
    if (!remain) throw;
    throw Error(
        error.code(),
        fmt::format("{} ({}; `open FILE repair` turns such cells round)", error.what(), cells_inside_out(inverted)),
        error.where());
  }
  if (remain) imported.notes.push_back(cells_inside_out(inverted) + "; `open FILE repair` turns such cells round");
  refuse_hanging_vertices(imported.built);
  const auto unused =
      static_cast<std::size_t>(mesh.cells.positions.cols()) - imported.built.point_from_vertex.size();
  if (unused > 0) imported.notes.push_back(fmt::format("{} points belong to no cell and were left out", unused));
  return imported;
}

std::map<std::string, Selection> imported_sets(const io::VolumeMesh& mesh, Imported& imported) {
  const Built& built = imported.built;
  std::vector<std::uint32_t> vertex_from_point(static_cast<std::size_t>(mesh.cells.positions.cols()),
                                               VertexId::k_invalid);
  for (std::size_t v = 0; v < built.point_from_vertex.size(); ++v)
    vertex_from_point[built.point_from_vertex[v]] = static_cast<std::uint32_t>(v);
  const auto face_id = [&](std::uint32_t face) {
    std::vector<VertexId> loop;
    for (std::size_t i = mesh.faces.offsets[face]; i < mesh.faces.offsets[face + 1]; ++i) {
      loop.push_back(VertexId{vertex_from_point[mesh.faces.corners[i]]});
      if (!loop.back().valid()) return FaceId::k_invalid;
    }
    const auto found = built.solid.find_face(loop);
    return found ? found->value : FaceId::k_invalid;
  };
  std::map<std::string, Selection> sets;
  for (const io::NamedSet& set : mesh.sets) {
    Selection selection;
    selection.type = set.kind == io::SetKind::points  ? ElementType::vertices
                     : set.kind == io::SetKind::faces ? ElementType::faces
                                                      : ElementType::cells;
    for (const std::uint32_t id : set.ids)
      selection.ids.push_back(set.kind == io::SetKind::points  ? vertex_from_point[id]
                              : set.kind == io::SetKind::faces ? face_id(id)
                                                               : id);
    const std::size_t lost = std::erase(selection.ids, VertexId::k_invalid);
    if (lost > 0)
      imported.notes.push_back(fmt::format("{} {} of the set '{}' are not those of a cell and were left out", lost,
                                           word(selection.type), set.name));
    subdiv::sort_unique(selection.ids);
    std::string name = set.name;
    while (sets.contains(name)) name += fmt::format("_{}", word(selection.type));
    if (name != set.name)
      imported.notes.push_back(fmt::format("two sets have the name '{}'; the one of {} is now '{}'", set.name,
                                           word(selection.type), name));
    sets.emplace(std::move(name), std::move(selection));
  }
  return sets;
}

}  // namespace argil::sculpt
