#pragma once
// What a volume mesh file holds: cells, and values at its points and cells. Readers are strict: a malformed file is
// an Error (bad_input) whose `where` is "file:line:column" (text) or "file: byte N" (binary), with what was
// expected, what was found and what to do; never a crash, a hang, a silent fix, or memory that the file's own size
// does not justify.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "subdiv/cell_lists.h"

namespace argil::io {

struct NamedField {
  std::string name;
  int components = 1;
  std::vector<double> values;  // [item * components + component]
};

struct VolumeMesh {
  subdiv::CellLists cells;
  std::vector<NamedField> point_fields;
  std::vector<NamedField> cell_fields;
};

/// Whether the ending of the name is one of those below.
[[nodiscard]] bool is_volume_format(const std::filesystem::path& path);

/// Reads by the ending of the name: .mesh (MEDIT), .vtk (legacy), .vtu.
/// @throws Error as above; (not_found) if there is no such file; (unsupported) for another ending or a kind of cell
/// that is not held, by name.
[[nodiscard]] VolumeMesh read_volume_mesh(const std::filesystem::path& path);
/// Writes by the ending. Doubles survive exactly. @throws Error (unsupported) where the format cannot hold a cell
/// kind or a field (MEDIT: polyhedra and fields), naming it; nothing is written then.
void write_volume_mesh(const std::filesystem::path& path, const VolumeMesh& mesh);

}  // namespace argil::io
