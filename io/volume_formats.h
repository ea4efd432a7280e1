#pragma once
// The table of volume formats: what each one holds. It drives reading and writing by ending, what is left out when
// a mesh goes to a poorer format, `argil formats` and docs/formats.md.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/volume_mesh.h"

namespace argil::io {

struct VolumeFormat {
  std::string_view ending, name;
  VolumeMesh (*read)(std::string_view bytes, std::string_view name);
  std::string (*bytes)(const VolumeMesh& mesh, const WriteOptions& options);
  std::string_view cells;  // the kinds, in words
  bool polyhedra = false;
  std::string_view fields;                           // in words
  bool (*holds_field)(const NamedField&) = nullptr;  // null: no field
  bool point_sets = false, face_sets = false, cell_sets = false;
  bool plain_set_names = false;  // names of sets are words of letters, digits, _ - . that begin with a letter
  std::string_view set_words;    // how sets are written, in words
  std::string_view precision;
  std::vector<Encoding> encodings;         // that can be written; the first is the usual one
  std::vector<std::string_view> versions;  // that can be written; the first is the usual one
  std::string_view read_words;             // what else is read, in words
};
[[nodiscard]] std::span<const VolumeFormat> volume_formats();
/// @throws Error (unsupported) for another ending.
[[nodiscard]] const VolumeFormat& volume_format_of(const std::filesystem::path& path);
/// ".mesh, .vtk, …", for messages.
[[nodiscard]] std::string volume_endings();

/// "ascii", "binary" …; of .vtu "raw" for binary. And back: "raw" and "binary" are the same.
/// @throws Error (bad_input) for another word.
[[nodiscard]] std::string_view word(Encoding encoding);
[[nodiscard]] Encoding encoding_by_word(const std::string& word);

/// Takes fields and sets that the format cannot hold out of the mesh, and says which, in words. Cells are never
/// left out.
[[nodiscard]] std::vector<std::string> leave_out_what_is_not_held(VolumeMesh& mesh, const VolumeFormat& format);

/// The table as text for a terminal (`markdown` for docs/formats.md).
[[nodiscard]] std::string volume_format_table(bool markdown);

}  // namespace argil::io
