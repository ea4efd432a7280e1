#include "io/volume_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "io/file_bytes.h"
#include "io/text_cursor.h"
#include "io/volume_formats.h"

namespace argil::io {
namespace {

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

void check_options(const VolumeFormat& format, const WriteOptions& options, const std::filesystem::path& path) {
  const auto& encodings = format.encodings;
  if (options.encoding != Encoding::usual &&
      std::find(encodings.begin(), encodings.end(), options.encoding) == encodings.end()) {
    throw Error(ErrorCode::unsupported,
                fmt::format("{} is not written {}; `argil formats` lists the encodings of each format", format.name,
                            word(options.encoding)),
                path.string());
  }
  const auto& versions = format.versions;
  if (!options.version.empty() && std::find(versions.begin(), versions.end(), options.version) == versions.end()) {
    throw Error(ErrorCode::unsupported,
                fmt::format("{} is not written in version {}; expected {}", format.name, in_quotes(options.version),
                            versions.empty() ? "none to be named" : fmt::format("{}", fmt::join(versions, " or "))),
                path.string());
  }
}

// A set that the format cannot hold is refused: callers leave it out first, and say so.
void check_sets(const VolumeMesh& mesh, const VolumeFormat& format) {
  for (std::size_t s = 0; s < mesh.sets.size(); ++s)
    for (std::size_t other = 0; other < s; ++other)
      if (mesh.sets[other].kind == mesh.sets[s].kind && mesh.sets[other].name == mesh.sets[s].name)
        throw Error(ErrorCode::unsupported,
                    fmt::format("two sets have the name {}; rename one", in_quotes(mesh.sets[s].name)));
  VolumeMesh sets;
  sets.faces = mesh.faces;
  sets.sets = mesh.sets;
  const auto notes = leave_out_what_is_not_held(sets, format);
  if (!notes.empty()) throw Error(ErrorCode::unsupported, notes[0] + "; remove it");
}

}  // namespace

bool is_volume_format(const std::filesystem::path& path) {
  const auto formats = volume_formats();
  const std::string ending = path.extension().string();
  return std::any_of(formats.begin(), formats.end(),
                     [&](const VolumeFormat& format) { return format.ending == ending; });
}

VolumeMesh read_volume_mesh(const std::filesystem::path& path) {
  const VolumeFormat& format = volume_format_of(path);
  return format.read(read_file(path), path.string());
}

void write_volume_mesh(const std::filesystem::path& path, const VolumeMesh& mesh, const WriteOptions& options) {
  const VolumeFormat& format = volume_format_of(path);
  check_options(format, options, path);
  check_writable(mesh);
  check_sets(mesh, format);
  write_file(path, format.bytes(mesh, options));
}

}  // namespace argil::io
