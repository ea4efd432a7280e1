#include <fmt/format.h>

#include <Eigen/Geometry>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "io/file_bytes.h"
#include "io/text_cursor.h"
#include "io/volume_mesh.h"

namespace argil::io {
namespace {

std::span<const std::uint32_t> polygon(const SurfaceMesh& mesh, std::size_t face) {
  return std::span(mesh.corners).subspan(mesh.offsets[face], mesh.offsets[face + 1] - mesh.offsets[face]);
}

std::string obj_text(const SurfaceMesh& mesh) {
  std::string text = "# Argil\n";
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    text += 'v';
    for (int axis = 0; axis < 3; ++axis) {
      text += ' ';
      append_number(text, mesh.positions(axis, v));
    }
    text += '\n';
  }
  for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f) {
    text += 'f';
    for (const std::uint32_t v : polygon(mesh, f))
      fmt::format_to(std::back_inserter(text), " {}", std::uint64_t{v} + 1);
    text += '\n';
  }
  return text;
}

template <class Bits>
void append_little_endian(std::string& bytes, Bits bits) {
  for (std::size_t i = 0; i < sizeof bits; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xFFU);
}

std::string ply_bytes(const SurfaceMesh& mesh) {
  const std::size_t faces = mesh.offsets.size() - 1;
  std::size_t largest = 0;
  for (std::size_t f = 0; f < faces; ++f) largest = std::max(largest, polygon(mesh, f).size());
  const bool small = largest <= std::numeric_limits<std::uint8_t>::max();
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment Argil\nelement vertex {}\nproperty double x\nproperty double "
      "y\n"
      "property double z\nelement face {}\nproperty list {} uint vertex_indices\nend_header\n",
      mesh.positions.cols(), faces, small ? "uchar" : "uint");
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      append_little_endian(bytes, std::bit_cast<std::uint64_t>(double{mesh.positions(axis, v)}));
    }
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const auto corners = polygon(mesh, f);
    if (small) {
      bytes += static_cast<char>(corners.size());
    } else {
      append_little_endian(bytes, static_cast<std::uint32_t>(corners.size()));
    }
    for (const std::uint32_t v : corners) append_little_endian(bytes, v);
  }
  return bytes;
}

void append_single(std::string& bytes, const Eigen::Vector3d& vector) {
  for (int axis = 0; axis < 3; ++axis) {
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(vector[axis])));
  }
}

std::string stl_bytes(const SurfaceMesh& mesh) {
  const double largest = mesh.positions.size() == 0 ? 0 : mesh.positions.cwiseAbs().maxCoeff();
  if (largest > double{std::numeric_limits<float>::max()}) {
    throw Error(ErrorCode::unsupported,
                fmt::format("STL holds single precision, which does not reach {}; write .ply", largest));
  }
  std::size_t triangles = 0;
  for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f) triangles += polygon(mesh, f).size() - 2;
  if (triangles > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::unsupported, fmt::format("STL cannot count {} triangles; write .ply", triangles));
  }
  std::string bytes = "Argil, single precision";
  bytes.resize(80, ' ');
  append_little_endian(bytes, static_cast<std::uint32_t>(triangles));
  for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f) {
    const auto corners = polygon(mesh, f);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      const Eigen::Vector3d a = mesh.positions.col(corners[0]), b = mesh.positions.col(corners[i]),
                            c = mesh.positions.col(corners[i + 1]);
      const Eigen::Vector3d normal = (b - a).cross(c - a);
      const double length = normal.norm();
      append_single(bytes, length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d(0, 0, 0));
      for (const Eigen::Vector3d& corner : {a, b, c}) append_single(bytes, corner);
      bytes.append(2, '\0');
    }
  }
  return bytes;
}

}  // namespace

void write_surface(const std::filesystem::path& path, const SurfaceMesh& mesh) {
  for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f) assert(polygon(mesh, f).size() >= 3);
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    if (mesh.positions.col(v).allFinite()) continue;
    throw Error(ErrorCode::bad_geometry, "a position is not finite; nothing was written",
                fmt::format("vertex {}", v));
  }
  const std::string ending = path.extension().string();
  if (ending == ".obj") {
    write_file(path, obj_text(mesh));
  } else if (ending == ".ply") {
    write_file(path, ply_bytes(mesh));
  } else if (ending == ".stl") {
    write_file(path, stl_bytes(mesh));
  } else {
    throw Error(ErrorCode::unsupported,
                fmt::format("expected a name that ends in .obj, .ply or .stl, found {}", in_quotes(ending)),
                path.string());
  }
}

}  // namespace argil::io
