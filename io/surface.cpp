#include "io/surface.h"

#include <fmt/format.h>

#include <cassert>

#include "io/file_bytes.h"
#include "io/gltf.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "io/text_cursor.h"

namespace argil::io {
namespace {

template <std::string (*bytes)(const SurfaceMesh&)>
std::string plain(const SurfaceMesh& mesh, const SurfaceLook&) {
  return bytes(mesh);
}

struct Format {
  std::string_view ending;
  SurfaceMesh (*read)(std::string_view bytes, std::string_view name);  // or null
  std::string (*bytes)(const SurfaceMesh& mesh, const SurfaceLook& look);
};
constexpr Format k_formats[] = {{".obj", read_obj, plain<obj_text>},  {".ply", read_ply, plain<ply_bytes>},
                                {".stl", read_stl, plain<stl_bytes>}, {".off", read_off, plain<off_text>},
                                {".glb", nullptr, glb_bytes},         {".gltf", nullptr, gltf_text}};

const Format* find_format(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  for (const Format& format : k_formats)
    if (format.ending == ending) return &format;
  return nullptr;
}

}  // namespace

bool is_surface_format(const std::filesystem::path& path) {
  return find_format(path) != nullptr;
}

SurfaceMesh read_surface(const std::filesystem::path& path) {
  const Format* format = find_format(path);
  if (!format || !format->read)
    throw Error(ErrorCode::unsupported,
                fmt::format("expected the name of a surface that ends in .obj, .ply, .stl or .off, found {}",
                            in_quotes(path.extension().string())),
                path.string());
  return format->read(read_file(path), path.string());
}

void write_surface(const std::filesystem::path& path, const SurfaceMesh& mesh, const SurfaceLook& look) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) assert(mesh.face(f).size() >= 3);
  assert(look.sharp.empty() || look.sharp.size() == mesh.corners.size());
  assert(look.colours.empty() || look.colours.size() == static_cast<std::size_t>(mesh.positions.cols()));
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    if (mesh.positions.col(v).allFinite()) continue;
    throw Error(ErrorCode::bad_geometry, "a position is not finite; nothing was written",
                fmt::format("vertex {}", v));
  }
  const Format* format = find_format(path);
  if (!format)
    throw Error(ErrorCode::unsupported,
                fmt::format("expected a name that ends in .obj, .ply, .stl, .off, .glb or .gltf, found {}",
                            in_quotes(path.extension().string())),
                path.string());
  write_file(path, format->bytes(mesh, look));
}

}  // namespace argil::io
