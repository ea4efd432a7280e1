#include "io/volume_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "io/abaqus.h"
#include "io/gmsh.h"
#include "io/medit.h"
#include "io/ovm.h"
#include "io/text_cursor.h"
#include "io/vtk.h"
#include "io/vtu.h"

namespace argil::io {
namespace {

bool any_field(const NamedField&) {
  return true;
}

const std::vector<VolumeFormat>& table() {
  static const std::vector<VolumeFormat> formats{
      {.ending = ".mesh",
       .name = "MEDIT",
       .read = read_medit,
       .bytes = medit_text,
       .cells = "tetrahedra, hexahedra, wedges, pyramids",
       .fields = "one whole number a point and cell, named \"reference\"",
       .holds_field = is_medit_reference,
       .set_words = "none: only the references",
       .precision = "exact doubles",
       .encodings = {Encoding::ascii},
       .versions = {"2"},
       .read_words = "ASCII, versions 1 to 4; surfaces are passed over"},
      {.ending = ".vtk",
       .name = "VTK legacy",
       .read = read_vtk,
       .bytes = vtk_text,
       .cells = "tetrahedra, hexahedra, wedges, pyramids, polyhedra",
       .polyhedra = true,
       .fields = "any number of components",
       .holds_field = any_field,
       .point_sets = true,
       .cell_sets = true,
       .set_words = "points, cells: arrays of 0 and 1 named \"set:NAME\"",
       .precision = "exact doubles",
       .encodings = {Encoding::ascii, Encoding::binary},
       .versions = {"4.2"},
       .read_words = "ASCII and binary, versions 2.0 to 5.1; voxels"},
      {.ending = ".vtu",
       .name = "VTK XML",
       .read = read_vtu,
       .bytes = vtu_bytes,
       .cells = "tetrahedra, hexahedra, wedges, pyramids, polyhedra",
       .polyhedra = true,
       .fields = "any number of components",
       .holds_field = any_field,
       .point_sets = true,
       .cell_sets = true,
       .set_words = "points, cells: arrays of 0 and 1 named \"set:NAME\"",
       .precision = "exact doubles",
       .encodings = {Encoding::binary, Encoding::ascii, Encoding::compressed},
       .versions = {"1.0"},
       .read_words = "ASCII, base64, raw, zlib, either byte order; voxels"},
      {.ending = ".msh",
       .name = "Gmsh",
       .read = read_gmsh,
       .bytes = gmsh_bytes,
       .cells = "tetrahedra, hexahedra, wedges, pyramids",
       .fields = "1, 3 or 9 components (NodeData, ElementData)",
       .holds_field = gmsh_holds_field,
       .point_sets = true,
       .face_sets = true,
       .cell_sets = true,
       .set_words = "points, faces, cells: physical groups (faces of 3 or 4 corners)",
       .precision = "exact doubles",
       .encodings = {Encoding::binary, Encoding::ascii},
       .versions = {"4.1", "2.2"},
       .read_words = "both versions and encodings, either byte order; lines are passed over"},
      {.ending = ".inp",
       .name = "Abaqus",
       .read = read_abaqus,
       .bytes = abaqus_text,
       .cells = "tetrahedra C3D4, hexahedra C3D8, wedges C3D6, pyramids C3D5 (which CalculiX lacks)",
       .fields = "none",
       .point_sets = true,
       .cell_sets = true,
       .plain_set_names = true,
       .set_words = "points, cells: *NSET, *ELSET",
       .precision = "exact doubles",
       .encodings = {Encoding::ascii},
       .versions = {},
       .read_words = "one part; C3D8R, C3D8I, …; flat elements and what is not mesh are passed over"},
      {.ending = ".ovm",
       .name = "OpenVolumeMesh",
       .read = read_ovm,
       .bytes = ovm_text,
       .cells = "polyhedra of every kind",
       .polyhedra = true,
       .fields = "1 to 4 components (VProp, CProp)",
       .holds_field = ovm_holds_field,
       .point_sets = true,
       .face_sets = true,
       .cell_sets = true,
       .set_words = "points, faces, cells: properties bool \"set:NAME\"",
       .precision = "exact doubles",
       .encodings = {Encoding::ascii},
       .versions = {},
       .read_words = "ASCII; other properties are passed over"}};
  return formats;
}

bool is_plain(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= 80 && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) {
           return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
         });
}

std::string_view word(SetKind kind) {
  constexpr std::array<std::string_view, 3> k_words{"points", "faces", "cells"};
  return k_words[static_cast<std::size_t>(kind)];
}

// Why a set cannot be held, or nothing.
std::string set_fault(const VolumeMesh& mesh, const NamedSet& set, const VolumeFormat& format,
                      std::set<std::string>& names) {
  const bool held = set.kind == SetKind::points  ? format.point_sets
                    : set.kind == SetKind::faces ? format.face_sets
                                                 : format.cell_sets;
  if (!held) return fmt::format("{} has no sets of {}", format.name, word(set.kind));
  if (set.name.find_first_of("\"\n\r") != std::string::npos) return "its name has a quotation mark or a line's end";
  if (set.kind == SetKind::faces && !format.polyhedra)
    for (const std::uint32_t face : set.ids)
      if (mesh.faces.offsets[face + 1] - mesh.faces.offsets[face] > 4)
        return fmt::format("{} has only faces of 3 and 4 corners", format.name);
  if (!format.plain_set_names) return {};
  if (!is_plain(set.name)) return fmt::format("{} wants a name of letters and digits", format.name);
  std::string key{word(set.kind)};
  for (const char c : set.name) key += (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
  return names.insert(key).second ? "" : fmt::format("{} does not tell its name from another's", format.name);
}

std::string encodings(const VolumeFormat& format) {
  std::string words;
  for (const Encoding encoding : format.encodings) {
    if (!words.empty()) words += ", ";
    words += format.ending == ".vtu" && encoding == Encoding::binary ? "raw" : word(encoding);
  }
  if (format.versions.size() > 1) {
    words += "; version ";
    for (std::size_t i = 0; i < format.versions.size(); ++i)
      words += fmt::format("{}{}", i > 0 ? ", " : "", format.versions[i]);
  }
  return words;
}

}  // namespace

std::span<const VolumeFormat> volume_formats() {
  return table();
}

const VolumeFormat& volume_format_of(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  for (const VolumeFormat& format : table())
    if (format.ending == ending) return format;
  throw Error(ErrorCode::unsupported,
              fmt::format("expected a name that ends in {}, found {}", volume_endings(), in_quotes(ending)),
              path.string());
}

std::string volume_endings() {
  std::string words;
  const auto& formats = table();
  for (std::size_t f = 0; f < formats.size(); ++f)
    words += fmt::format("{}{}", f == 0 ? "" : f + 1 == formats.size() ? " or " : ", ", formats[f].ending);
  return words;
}

std::string_view word(Encoding encoding) {
  constexpr std::array<std::string_view, 4> k_words{"usual", "ascii", "binary", "compressed"};
  return k_words[static_cast<std::size_t>(encoding)];
}

Encoding encoding_by_word(const std::string& name) {
  if (name == "raw") return Encoding::binary;
  for (const Encoding encoding : {Encoding::usual, Encoding::ascii, Encoding::binary, Encoding::compressed})
    if (name == word(encoding)) return encoding;
  throw Error(ErrorCode::bad_input,
              fmt::format("expected the encoding ascii, binary, raw or compressed, found {}", in_quotes(name)));
}

std::vector<std::string> leave_out_what_is_not_held(VolumeMesh& mesh, const VolumeFormat& format) {
  std::vector<std::string> notes;
  const auto thin = [&](std::vector<NamedField>& fields, std::string_view items) {
    std::string names;
    std::erase_if(fields, [&](const NamedField& field) {
      if (format.holds_field && format.holds_field(field)) return false;
      names += fmt::format("{}'{}'", names.empty() ? "" : ", ", field.name);
      return true;
    });
    if (!names.empty())
      notes.push_back(fmt::format("{} has no place for fields of the {} named {} (it holds: {}); they are left out",
                                  format.name, items, names, format.fields));
  };
  thin(mesh.point_fields, "points");
  thin(mesh.cell_fields, "cells");
  std::set<std::string> names;
  std::erase_if(mesh.sets, [&](const NamedSet& set) {
    const std::string fault = set_fault(mesh, set, format, names);
    if (!fault.empty())
      notes.push_back(fmt::format("the set '{}' of {} is left out: {}", set.name, word(set.kind), fault));
    return !fault.empty();
  });
  return notes;
}

std::string volume_format_table(bool markdown) {
  std::string text;
  for (const VolumeFormat& format : table()) {
    const std::array<std::pair<std::string_view, std::string>, 6> rows{{{"cells", std::string(format.cells)},
                                                                        {"fields", std::string(format.fields)},
                                                                        {"sets", std::string(format.set_words)},
                                                                        {"numbers", std::string(format.precision)},
                                                                        {"written", encodings(format)},
                                                                        {"read", std::string(format.read_words)}}};
    if (markdown) {
      if (text.empty())
        text = "| | cells | fields | sets | numbers | written | read |\n|---|---|---|---|---|---|---|\n";
      text += fmt::format("| {} `{}` |", format.name, format.ending);
      for (const auto& row : rows) text += fmt::format(" {} |", row.second);
      text += '\n';
    } else {
      text += fmt::format("{}  {}\n", format.ending, format.name);
      for (const auto& row : rows) text += fmt::format("  {:<8} {}\n", row.first, row.second);
    }
  }
  return text;
}

}  // namespace argil::io
