#pragma once
// Surface files as other programs write them, written here anew from the description of the formats, so that the
// readers have a second opinion; and small surfaces to write.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/surface.h"

namespace argil::io::test {

/// A cube of side 1 with one side as two triangles: 8 vertices, 5 quadrilaterals, 2 triangles, turned outwards.
inline SurfaceMesh cube() {
  SurfaceMesh mesh;
  mesh.positions.resize(3, 8);
  mesh.positions << 0, 1, 1, 0, 0, 1, 1, 0,  //
      0, 0, 1, 1, 0, 0, 1, 1,                //
      0, 0, 0, 0, 1, 1, 1, 1;
  mesh.offsets = {0, 4, 8, 12, 16, 20, 23, 26};
  mesh.corners = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 3, 4, 7};
  return mesh;
}

template <class T>
void put(std::string& bytes, T value, bool big_endian) {
  std::string one(reinterpret_cast<const char*>(&value), sizeof value);  // this machine is little endian
  if (big_endian) std::reverse(one.begin(), one.end());
  bytes += one;
}

/// Single precision with normals, colours, an element of other things before, lists of lists after, as scanners
/// write it.
inline std::string crowded_ply(const SurfaceMesh& mesh, std::string_view format, bool windows = false) {
  std::string head = fmt::format(
      "ply\nformat {} 1.0\ncomment by another hand\nobj_info scan 7\nelement camera 2\nproperty double fov\n"
      "property list uchar short trail\nelement vertex {}\nproperty uchar red\nproperty float x\nproperty float "
      "y\nproperty float z\nproperty float32 nx\nelement face {}\nproperty int16 flags\nproperty list uint8 int32 "
      "vertex_index\nproperty list int float texcoord\nelement edge 1\nproperty int vertex1\nproperty int "
      "vertex2\nend_header\n",
      format, mesh.positions.cols(), mesh.face_count());
  if (windows)
    for (std::size_t i = 0; (i = head.find('\n', i)) != std::string::npos; i += 2) head.replace(i, 1, "\r\n");
  const bool text = format == "ascii", big = format == "binary_big_endian";
  std::string out = head;
  const auto add = [&](auto value) {
    if (text)
      out += fmt::format("{} ", +value);
    else
      put(out, value, big);
  };
  const auto end = [&] {
    if (text) out += windows ? "\r\n" : "\n";
  };
  for (int camera = 0; camera < 2; ++camera) {
    add(0.5);
    add(static_cast<std::uint8_t>(3 * camera));
    for (int i = 0; i < 3 * camera; ++i) add(static_cast<std::int16_t>(-i));
    end();
  }
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    add(static_cast<std::uint8_t>(200));
    for (int axis = 0; axis < 3; ++axis) add(static_cast<float>(mesh.positions(axis, v)));
    add(1.0F);
    end();
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    add(static_cast<std::int16_t>(-1));
    add(static_cast<std::uint8_t>(mesh.face(f).size()));
    for (const std::uint32_t v : mesh.face(f)) add(static_cast<std::int32_t>(v));
    add(std::int32_t{2});
    add(0.25F);
    add(0.75F);
    end();
  }
  add(std::int32_t{0});
  add(std::int32_t{1});
  end();
  return out;
}

/// Triangles about the first corner of each face.
inline std::string ascii_stl(const SurfaceMesh& mesh, bool capitals = false) {
  std::string out = "solid by another hand\n";
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t i = 1; i + 1 < mesh.face(f).size(); ++i) {
      out += "  facet normal 0 0 nan\n    outer loop\n";
      for (const std::size_t corner : {std::size_t{0}, i, i + 1}) {
        const Eigen::Vector3d p = mesh.positions.col(mesh.face(f)[corner]);
        out += fmt::format("      vertex {:e} {:e} {:e}\n", p[0], p[1], p[2]);
      }
      out += "    endloop\n  endfacet\n";
    }
  out += "endsolid\n";
  if (capitals)
    for (std::size_t i = 0; i < out.size(); ++i)
      if (out[i] >= 'a' && out[i] <= 'z') out[i] = static_cast<char>(out[i] - 'a' + 'A');
  return out;
}

inline std::string crowded_obj() {
  return "# a cube, by another hand\r\nmtllib cube.mtl\r\no cube\r\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 "
         "0\n"
         "vt 0 0\nvt 1 0\nvn 0 0 -1\nvn 0 0 1\nusemtl clay\ns off\nf 1/1/1 4/2/1 3//1 2/1\n"
         "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\ng top sides\nf -4 -3 \\\n  -2 -1 # the top\nl 1 2\np 1\n"
         "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5\nf 4 5 8\n";
}

inline std::string coloured_off() {
  return "CNOFF # by another hand\n8 7 0\n0 0 0 0 0 -1 0.1 0.2 0.3 1\n1 0 0 0 0 -1 0.1 0.2 0.3\n"
         "1 1 0 0 0 1 0 0 0 1\n0 1 0 0 0 1 0 0 0 1\n\n0 0 1 0 0 1 0 0 0 1\n1 0 1 0 0 1 0 0 0 1\n"
         "1 1 1 0 0 1 0 0 0 1 # far\n0 1 1 0 0 1 0 0 0 1\n4 0 3 2 1 255 0 0\n4 4 5 6 7\n4 0 1 5 4 0.1 0.2 0.3 1\n"
         "4 1 2 6 5\n4 2 3 7 6 # red\n3 3 0 4\n3 3 4 7\n";
}

}  // namespace argil::io::test
