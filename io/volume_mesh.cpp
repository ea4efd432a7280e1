#include "io/volume_mesh.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "io/file_bytes.h"
#include "io/medit.h"
#include "io/text_cursor.h"
#include "io/vtk.h"
#include "io/vtu.h"

namespace argil::io {
namespace {

struct Format {
  std::string_view ending;
  VolumeMesh (*read)(std::string_view bytes, std::string_view name);
  std::string (*text)(const VolumeMesh& mesh);
};
constexpr Format k_formats[] = {
    {".mesh", read_medit, medit_text}, {".vtk", read_vtk, vtk_text}, {".vtu", read_vtu, vtu_bytes}};

const Format* find_format(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  for (const Format& format : k_formats)
    if (format.ending == ending) return &format;
  return nullptr;
}

const Format& format_of(const std::filesystem::path& path) {
  if (const Format* format = find_format(path)) return *format;
  throw Error(ErrorCode::unsupported,
              fmt::format("expected a name that ends in .mesh, .vtk or .vtu, found {}",
                          in_quotes(path.extension().string())),
              path.string());
}

void check_fields(const std::vector<NamedField>& fields, std::size_t items, std::string_view what) {
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const NamedField& field = fields[f];
    assert(field.components > 0 && field.values.size() == items * static_cast<std::size_t>(field.components));
    const bool named = !field.name.empty() && field.name.find('\0') == std::string::npos;
    if (!named)
      throw Error(ErrorCode::unsupported, fmt::format("a field of the {} has no name; give it one", what));
    for (std::size_t other = 0; other < f; ++other) {
      if (fields[other].name != field.name) continue;
      throw Error(ErrorCode::unsupported,
                  fmt::format("two fields of the {} have the name {}; rename one", what, in_quotes(field.name)));
    }
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      if (std::isfinite(field.values[i])) continue;
      throw Error(ErrorCode::bad_input,
                  fmt::format("the field {} of the {} is not finite at {}; nothing was written",
                              in_quotes(field.name), what, i / static_cast<std::size_t>(field.components)));
    }
  }
}

// What no reader of ours would take back.
void check_writable(const VolumeMesh& mesh) {
  const auto& positions = mesh.cells.positions;
  for (Eigen::Index v = 0; v < positions.cols(); ++v) {
    if (positions.col(v).allFinite()) continue;
    throw Error(ErrorCode::bad_geometry, "a position is not finite; nothing was written",
                fmt::format("vertex {}", v));
  }
  check_fields(mesh.point_fields, static_cast<std::size_t>(positions.cols()), "points");
  check_fields(mesh.cell_fields, mesh.cells.cell_count(), "cells");
}

}  // namespace

bool is_volume_format(const std::filesystem::path& path) {
  return find_format(path) != nullptr;
}

VolumeMesh read_volume_mesh(const std::filesystem::path& path) {
  const Format& format = format_of(path);
  return format.read(read_file(path), path.string());
}

void write_volume_mesh(const std::filesystem::path& path, const VolumeMesh& mesh) {
  const Format& format = format_of(path);
  check_writable(mesh);
  write_file(path, format.text(mesh));
}

}  // namespace argil::io
