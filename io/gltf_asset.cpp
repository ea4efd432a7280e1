#include "io/gltf_asset.h"

#include <fmt/format.h>

#include <bit>
#include <limits>

#include "subdiv/error.h"

namespace argil::io {

std::size_t GltfAsset::add(std::size_t offset, std::size_t length, int target, std::string_view accessor) {
  const char* comma = count == 0 ? "" : ",";
  views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}{}}}", comma, offset, length,
                       target == k_gltf_plain ? "" : fmt::format(",\"target\":{}", target));
  accessors += fmt::format("{}{{\"bufferView\":{},{}}}", comma, count, accessor);
  return count++;
}

void append_word(std::string& bytes, std::uint32_t word) {
  for (unsigned i = 0; i < 4; ++i) bytes += static_cast<char>(word >> (8 * i) & 0xFFU);
}

void append_vector(std::string& bytes, const Eigen::Vector3f& vector) {
  for (int axis = 0; axis < 3; ++axis) append_word(bytes, std::bit_cast<std::uint32_t>(vector[axis]));
}

std::string gltf_vectors(std::size_t count) {
  return fmt::format("\"componentType\":5126,\"type\":\"VEC3\",\"count\":{}", count);
}

std::string gltf_bounds(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  return fmt::format(",\"min\":[{},{},{}],\"max\":[{},{},{}]", low[0], low[1], low[2], high[0], high[1], high[2]);
}

GltfAsset gltf_asset(const SurfaceMesh& mesh, const SurfaceLook& look, const GltfPoints& points) {
  check_gltf_range(mesh);
  GltfAsset asset;
  asset.coloured = !look.colours.empty();
  const std::string vectors = gltf_vectors(points.count());
  std::size_t begin = 0;
  const auto close_view = [&](int target, std::string_view accessor) {
    asset.add(begin, asset.binary.size() - begin, target, accessor);
    begin = asset.binary.size();
  };
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;
  for (const std::uint32_t v : points.vertex_from_point) {
    const Eigen::Vector3f position = mesh.positions.col(v).cast<float>();
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
    append_vector(asset.binary, position);
  }
  close_view(k_gltf_vertices, vectors + gltf_bounds(low, high));
  for (const Eigen::Vector3d& normal : point_normals(mesh, points))
    append_vector(asset.binary, normal.cast<float>());
  close_view(k_gltf_vertices, vectors);
  if (asset.coloured) {
    for (const std::uint32_t v : points.vertex_from_point) append_vector(asset.binary, look.colours[v]);
    close_view(k_gltf_vertices, vectors);
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t c = mesh.offsets[f] + 1; c + 1 < mesh.offsets[f + 1]; ++c)
      for (const std::size_t corner : {mesh.offsets[f], c, c + 1})
        append_word(asset.binary, points.point_from_corner[corner]);
  close_view(k_gltf_indices, fmt::format("\"componentType\":5125,\"type\":\"SCALAR\",\"count\":{}",
                                         (asset.binary.size() - begin) / 4));
  return asset;
}

std::string gltf_json(const GltfAsset& asset, std::size_t buffer_length, std::string_view uri,
                      std::string_view of_primitive, std::string_view of_mesh, std::string_view of_document) {
  // The node turns z, which is up here, to y.
  return fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"Argil\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],"
      "\"nodes\":[{{\"mesh\":0,\"rotation\":[-0.7071067811865476,0,0,0.7071067811865476]}}],"
      "\"materials\":[{{\"pbrMetallicRoughness\":{{\"baseColorFactor\":{},\"metallicFactor\":0,"
      "\"roughnessFactor\":0.8}}}}],"
      "\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0,\"NORMAL\":1{}}},\"indices\":{},"
      "\"material\":0,\"mode\":4{}}}]{}}}],\"accessors\":[{}],\"bufferViews\":[{}],"
      "\"buffers\":[{{\"byteLength\":{}{}}}]{}}}",
      asset.coloured ? "[1,1,1,1]" : "[0.62,0.4,0.28,1]", asset.coloured ? ",\"COLOR_0\":2" : "",
      asset.coloured ? 3 : 2, of_primitive, of_mesh, asset.accessors, asset.views, buffer_length, uri, of_document);
}

std::string glb_head(std::string json, std::size_t binary) {
  json.append((4 - json.size() % 4) % 4, ' ');  // the binary chunk is of whole words as it is
  const std::size_t size = 12 + 8 + json.size() + 8 + binary;
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw Error(
        ErrorCode::unsupported,
        fmt::format("a .glb file cannot count {} bytes; write .ply or .obj, fewer frames, or a lower level", size));
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, static_cast<std::uint32_t>(size));
  append_word(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append_word(bytes, static_cast<std::uint32_t>(binary));
  return bytes.append("BIN\0", 4);
}

}  // namespace argil::io
