#pragma once
// What a volume mesh file holds: cells, values at its points and cells, and named sets. Readers are strict: a
// malformed file is an Error (bad_input) whose `where` is "file:line:column" (text) or "file: byte N" (binary),
// with what was expected, what was found and what to do; never a crash, a hang, a silent fix, or memory that the
// file's own size does not justify. What each format holds is in io/volume_formats.h.

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

enum class SetKind { points, faces, cells };
struct NamedSet {
  std::string name;
  SetKind kind = SetKind::points;
  std::vector<std::uint32_t> ids;  // ascending: numbers of points, of `faces` below, of cells
};

/// Polygons over the points of a mesh; the direction of a loop means nothing.
struct FaceLoops {
  std::vector<std::size_t> offsets{0};
  std::vector<std::uint32_t> corners;

  std::size_t count() const { return offsets.size() - 1; }
};

struct VolumeMesh {
  subdiv::CellLists cells;
  std::vector<NamedField> point_fields{};
  std::vector<NamedField> cell_fields{};
  FaceLoops faces{};  // those that a set names
  std::vector<NamedSet> sets{};
  std::vector<std::string> notes{};  // what a reader passed over, in words; writers leave them alone
};

enum class Encoding { usual, ascii, binary, compressed };  // `binary` is VTU's raw appended data
struct WriteOptions {
  Encoding encoding = Encoding::usual;
  std::string version{};  // of the format; empty: the usual one
};

/// Whether the ending of the name is that of a volume format.
[[nodiscard]] bool is_volume_format(const std::filesystem::path& path);

/// Reads by the ending of the name.
/// @throws Error as above; (not_found) if there is no such file; (unsupported) for another ending or a kind of cell
/// that is not held, by name.
[[nodiscard]] VolumeMesh read_volume_mesh(const std::filesystem::path& path);
/// Writes by the ending. Doubles survive exactly. @throws Error (unsupported) where the format cannot hold a cell
/// kind, a field, a set, or the encoding asked for, naming it; nothing is written then.
void write_volume_mesh(const std::filesystem::path& path, const VolumeMesh& mesh, const WriteOptions& options = {});

}  // namespace argil::io
