#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/abaqus.h"
#include "io/text_cursor.h"
#include "io/vtk_cells.h"
#include "subdiv/cell_kinds.h"

namespace argil::io {
namespace {

using subdiv::CellKind;

constexpr std::array k_blocks{
    NamedCellKind{"C3D4", CellKind::tetrahedron, {0, 1, 2, 3}},
    NamedCellKind{"C3D5", CellKind::pyramid, {0, 1, 2, 3, 4}},
    NamedCellKind{"C3D6", CellKind::wedge, {0, 2, 1, 3, 5, 4}},
    NamedCellKind{"C3D8", CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}},
};

void append_set(std::string& text, const NamedSet& set) {
  const std::string_view keyword = set.kind == SetKind::points ? "NSET" : "ELSET";
  fmt::format_to(std::back_inserter(text), "*{}, {}={}\n", keyword, keyword, set.name);
  for (std::size_t i = 0; i < set.ids.size(); ++i) {
    const bool last = i + 1 == set.ids.size() || (i + 1) % 12 == 0;
    fmt::format_to(std::back_inserter(text), "{}{}", std::uint64_t{set.ids[i]} + 1, last ? "\n" : ", ");
  }
}

}  // namespace

std::string abaqus_text(const VolumeMesh& mesh, const WriteOptions&) {
  const auto& cells = mesh.cells;
  const auto polyhedron = std::find(cells.kinds.begin(), cells.kinds.end(), CellKind::polyhedron);
  if (polyhedron != cells.kinds.end())
    throw Error(ErrorCode::unsupported, "Abaqus cannot hold polyhedra; write .vtu, .vtk or .ovm",
                fmt::format("cell {}", polyhedron - cells.kinds.begin()));
  if (!mesh.point_fields.empty() || !mesh.cell_fields.empty())
    throw Error(ErrorCode::unsupported,
                fmt::format("Abaqus input cannot hold the field {}; write .vtu or .vtk, or leave it out",
                            in_quotes((mesh.point_fields.empty() ? mesh.cell_fields : mesh.point_fields)[0].name)));

  std::string text = "*HEADING\nArgil\n*NODE\n";
  for (Eigen::Index v = 0; v < cells.positions.cols(); ++v) {
    fmt::format_to(std::back_inserter(text), "{}", v + 1);
    for (int axis = 0; axis < 3; ++axis) {
      text += ", ";
      append_number(text, cells.positions(axis, v));
    }
    text += '\n';
  }
  for (const NamedCellKind& block : k_blocks) {
    if (std::find(cells.kinds.begin(), cells.kinds.end(), block.kind) == cells.kinds.end()) continue;
    fmt::format_to(std::back_inserter(text), "*ELEMENT, TYPE={}\n", block.word);
    for (std::size_t c = 0; c < cells.cell_count(); ++c) {
      if (cells.kinds[c] != block.kind) continue;
      fmt::format_to(std::back_inserter(text), "{}", c + 1);
      for (std::size_t i = 0; i < vertex_count(block.kind); ++i)
        fmt::format_to(std::back_inserter(text), ", {}",
                       std::uint64_t{cells.connectivity[cells.offsets[c] + block.vtk_from_file[i]]} + 1);
      text += '\n';
    }
  }
  for (const NamedSet& set : mesh.sets) append_set(text, set);
  return text;
}

}  // namespace argil::io
