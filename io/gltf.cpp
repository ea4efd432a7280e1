#include "io/gltf.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/surface_sides.h"
#include "subdiv/disjoint_sets.h"
#include "subdiv/error.h"

namespace argil::io {
namespace {

// A vertex with its normal; corners of faces share it unless a crease runs between them.
struct Points {
  std::vector<std::uint32_t> point_from_corner;
  std::vector<std::uint32_t> vertex_from_point;
  std::vector<Eigen::Vector3d> normals;  // unit
};

std::vector<Eigen::Vector3d> area_normals(const SurfaceMesh& mesh) {
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const Eigen::Vector3d origin = mesh.positions.col(face[0]);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      normal += (mesh.positions.col(face[i]) - origin).cross(mesh.positions.col(face[i + 1]) - origin);
    normals.push_back(normal);
  }
  return normals;
}

bool comes_before(const SurfaceSide& a, const SurfaceSide& b) {
  return std::tie(a.from, a.to, a.corner) < std::tie(b.from, b.to, b.corner);
}

// Unites the corners of two faces at both ends of each smooth edge.
subdiv::DisjointSets smooth_corners(const SurfaceMesh& mesh, const SurfaceLook& look,
                                    const std::vector<Eigen::Vector3d>& normals) {
  std::vector<SurfaceSide> sides = surface_sides(mesh);
  std::sort(sides.begin(), sides.end(), comes_before);
  const double cosine = std::cos(look.crease_angle * std::numbers::pi / 180);
  const auto range_of = [&](std::uint32_t from, std::uint32_t to) {
    const auto first = std::lower_bound(sides.begin(), sides.end(), SurfaceSide{from, to, 0, 0, 0}, comes_before);
    auto last = first;
    while (last != sides.end() && last->from == from && last->to == to) ++last;
    return std::pair(first, last);
  };
  const auto is_sharp = [&](std::uint32_t corner) { return !look.sharp.empty() && look.sharp[corner] != 0; };
  subdiv::DisjointSets corners(mesh.corners.size());
  for (const SurfaceSide& side : sides) {
    if (side.from > side.to) continue;
    const auto [first, last] = range_of(side.from, side.to);
    const auto [back, back_end] = range_of(side.to, side.from);
    if (last - first != 1 || back_end - back != 1) continue;  // open, or where sheets touch
    const Eigen::Vector3d &a = normals[side.face], &b = normals[back->face];
    if (is_sharp(side.corner) || is_sharp(back->corner) || a.dot(b) < cosine * a.norm() * b.norm()) continue;
    corners.unite(side.corner, back->next_corner);
    corners.unite(side.next_corner, back->corner);
  }
  return corners;
}

Points split_at_creases(const SurfaceMesh& mesh, const SurfaceLook& look) {
  const std::vector<Eigen::Vector3d> normals = area_normals(mesh);
  subdiv::DisjointSets corners = smooth_corners(mesh, look, normals);
  Points points;
  points.point_from_corner.resize(mesh.corners.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t c = mesh.offsets[f]; c < mesh.offsets[f + 1]; ++c) {
      const std::uint32_t first = corners.find(static_cast<std::uint32_t>(c));  // the lowest of its set
      if (first == c) {
        points.point_from_corner[c] = static_cast<std::uint32_t>(points.normals.size());
        points.vertex_from_point.push_back(mesh.corners[c]);
        points.normals.emplace_back(Eigen::Vector3d::Zero());
      }
      points.point_from_corner[c] = points.point_from_corner[first];
      points.normals[points.point_from_corner[c]] += normals[f];
    }
  for (Eigen::Vector3d& normal : points.normals) {
    const double length = normal.norm();
    normal = length > 0 && std::isfinite(length) ? Eigen::Vector3d(normal / length) : Eigen::Vector3d(0, 0, 1);
  }
  return points;
}

void append_word(std::string& bytes, std::uint32_t word) {
  for (unsigned i = 0; i < 4; ++i) bytes += static_cast<char>(word >> (8 * i) & 0xFFU);
}

void append_vector(std::string& bytes, const Eigen::Vector3f& vector) {
  for (int axis = 0; axis < 3; ++axis) append_word(bytes, std::bit_cast<std::uint32_t>(vector[axis]));
}

struct Asset {
  std::string json, binary;  // the JSON lacks the place of the buffer
};

std::string with_buffer(const Asset& asset, std::string_view uri) {
  return asset.json + fmt::format("\"buffers\":[{{\"byteLength\":{}{}}}]}}", asset.binary.size(), uri);
}

void check_range(const SurfaceMesh& mesh) {
  const double largest = mesh.positions.size() == 0 ? 0 : mesh.positions.cwiseAbs().maxCoeff();
  if (largest > double{std::numeric_limits<float>::max()})
    throw Error(ErrorCode::unsupported,
                fmt::format("glTF holds single precision, which does not reach {}; write .ply", largest));
  if (mesh.corners.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorCode::unsupported,
                fmt::format("glTF cannot number {} corners of faces; write .ply", mesh.corners.size()));
}

Asset asset_of(const SurfaceMesh& mesh, const SurfaceLook& look) {
  check_range(mesh);
  const Points points = split_at_creases(mesh, look);
  Asset asset;
  std::string views, accessors;
  int count = 0;
  const auto close_view = [&](std::size_t begin, int target, std::string_view accessor) {
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":{}}}",
                         count == 0 ? "" : ",", begin, asset.binary.size() - begin, target);
    accessors += fmt::format("{}{{\"bufferView\":{},{}}}", count == 0 ? "" : ",", count, accessor);
    ++count;
  };
  constexpr int k_vertices = 34962, k_indices = 34963;
  const std::string vectors =
      fmt::format("\"componentType\":5126,\"type\":\"VEC3\",\"count\":{}", points.normals.size());

  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;
  for (const std::uint32_t v : points.vertex_from_point) {
    const Eigen::Vector3f position = mesh.positions.col(v).cast<float>();
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
    append_vector(asset.binary, position);
  }
  close_view(0, k_vertices,
             vectors + fmt::format(",\"min\":[{},{},{}],\"max\":[{},{},{}]", low[0], low[1], low[2], high[0],
                                   high[1], high[2]));
  std::size_t begin = asset.binary.size();
  for (const Eigen::Vector3d& normal : points.normals) append_vector(asset.binary, normal.cast<float>());
  close_view(begin, k_vertices, vectors);
  if (!look.colours.empty()) {
    begin = asset.binary.size();
    for (const std::uint32_t v : points.vertex_from_point) append_vector(asset.binary, look.colours[v]);
    close_view(begin, k_vertices, vectors);
  }
  begin = asset.binary.size();
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t c = mesh.offsets[f] + 1; c + 1 < mesh.offsets[f + 1]; ++c)
      for (const std::size_t corner : {mesh.offsets[f], c, c + 1})
        append_word(asset.binary, points.point_from_corner[corner]);
  close_view(
      begin, k_indices,
      fmt::format("\"componentType\":5125,\"type\":\"SCALAR\",\"count\":{}", (asset.binary.size() - begin) / 4));

  // The node turns z, which is up here, to y.
  const bool coloured = !look.colours.empty();
  asset.json = fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"Argil\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],"
      "\"nodes\":[{{\"mesh\":0,\"rotation\":[-0.7071067811865476,0,0,0.7071067811865476]}}],"
      "\"materials\":[{{\"pbrMetallicRoughness\":{{\"baseColorFactor\":{},\"metallicFactor\":0,"
      "\"roughnessFactor\":0.8}}}}],"
      "\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0,\"NORMAL\":1{}}},\"indices\":{},"
      "\"material\":0,\"mode\":4}}]}}],\"accessors\":[{}],\"bufferViews\":[{}],",
      coloured ? "[1,1,1,1]" : "[0.62,0.4,0.28,1]", coloured ? ",\"COLOR_0\":2" : "", coloured ? 3 : 2, accessors,
      views);
  return asset;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      bits = bits << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? k_digits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace

std::string glb_bytes(const SurfaceMesh& mesh, const SurfaceLook& look) {
  const Asset asset = asset_of(mesh, look);
  std::string json = with_buffer(asset, "");
  json.append((4 - json.size() % 4) % 4, ' ');  // the binary chunk is of whole words as it is
  const std::size_t size = 12 + 8 + json.size() + 8 + asset.binary.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorCode::unsupported,
                fmt::format("a .glb file cannot count {} bytes; write .ply, or a lower level", size));
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, static_cast<std::uint32_t>(size));
  append_word(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append_word(bytes, static_cast<std::uint32_t>(asset.binary.size()));
  bytes.append("BIN\0", 4);
  return bytes + asset.binary;
}

std::string gltf_text(const SurfaceMesh& mesh, const SurfaceLook& look) {
  const Asset asset = asset_of(mesh, look);
  return with_buffer(asset, ",\"uri\":\"data:application/octet-stream;base64," + base64(asset.binary) + "\"") +
         "\n";
}

}  // namespace argil::io
