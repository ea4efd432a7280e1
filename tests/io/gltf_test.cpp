// glTF against the rules of its specification (Khronos, glTF 2.0; section numbers below), by a reader of its own.

#include "io/gltf.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "io/ply.h"
#include "subdiv/error.h"
#include "surface_encoders.h"

namespace argil::io {
namespace {

using nlohmann::json;

struct Asset {
  json document;
  std::string binary;
};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

// §4.4: twelve bytes of header, then chunks of whole words, JSON padded by blanks.
Asset open_glb(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word_at(bytes, 4), 2U);
  EXPECT_EQ(word_at(bytes, 8), bytes.size());
  const std::size_t text = word_at(bytes, 12);
  EXPECT_EQ(text % 4, 0U);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  const std::size_t binary = word_at(bytes, 20 + text);
  EXPECT_EQ(binary % 4, 0U);
  EXPECT_EQ(bytes.substr(24 + text, 4), std::string("BIN\0", 4));
  EXPECT_EQ(bytes.size(), 28 + text + binary);
  return {json::parse(bytes.substr(20, text)), bytes.substr(28 + text)};
}

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
  }
  return bytes;
}

// The numbers of an accessor, checked against §3.6.2: within its view, aligned, finite, extremes exact.
std::vector<std::vector<double>> numbers_of(const Asset& asset, std::size_t index) {
  const json& accessor = asset.document["accessors"].at(index);
  const json& view = asset.document["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
  const std::size_t offset = view["byteOffset"], length = view["byteLength"], count = accessor["count"];
  const bool vectors = accessor["type"] == "VEC3", floats = accessor["componentType"] == 5126;
  const std::size_t width = vectors ? 3 : 1;
  EXPECT_TRUE(floats || accessor["componentType"] == 5125);
  EXPECT_EQ(offset % 4, 0U);
  EXPECT_EQ(length, 4 * width * count);
  EXPECT_LE(offset + length, asset.binary.size());
  EXPECT_EQ(view["target"], vectors ? 34962 : 34963);
  std::vector<std::vector<double>> numbers(count, std::vector<double>(width));
  for (std::size_t i = 0; i < count * width; ++i) {
    float single = 0;
    std::memcpy(&single, asset.binary.data() + offset + 4 * i, 4);
    numbers[i / width][i % width] = floats ? single : word_at(asset.binary, offset + 4 * i);
    EXPECT_TRUE(std::isfinite(numbers[i / width][i % width]));
  }
  for (const char* extreme : {"min", "max"}) {
    if (!accessor.contains(extreme)) continue;
    for (std::size_t axis = 0; axis < width; ++axis) {
      std::vector<double> column;
      for (const auto& row : numbers) column.push_back(row[axis]);
      EXPECT_EQ(static_cast<double>(accessor[extreme][axis].get<float>()),
                extreme == std::string("min") ? *std::min_element(column.begin(), column.end())
                                              : *std::max_element(column.begin(), column.end()));
    }
  }
  return numbers;
}

struct Mesh {
  std::vector<std::vector<double>> positions, normals, colours;
  std::vector<std::size_t> indices;
};

Mesh check_and_read(const Asset& asset) {
  const json& document = asset.document;
  EXPECT_EQ(document["asset"]["version"], "2.0");
  EXPECT_EQ(document["scenes"][document["scene"].get<std::size_t>()]["nodes"][0], 0);
  EXPECT_EQ(document["buffers"].size(), 1U);
  EXPECT_EQ(document["buffers"][0]["byteLength"], asset.binary.size());
  double length = 0;
  for (const json& part : document["nodes"][0]["rotation"]) length += part.get<double>() * part.get<double>();
  EXPECT_NEAR(length, 1, 1e-12);
  const json& primitive = document["meshes"][0]["primitives"][0];
  const json& attributes = primitive["attributes"];
  EXPECT_EQ(primitive["mode"], 4);
  EXPECT_TRUE(document["accessors"][attributes["POSITION"].get<std::size_t>()].contains("min"));  // §3.7.2.1
  Mesh mesh;
  mesh.positions = numbers_of(asset, attributes["POSITION"]);
  mesh.normals = numbers_of(asset, attributes["NORMAL"]);
  if (attributes.contains("COLOR_0")) mesh.colours = numbers_of(asset, attributes["COLOR_0"]);
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const auto& n : mesh.normals) EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-6);  // §3.7.2.1
  for (const auto& index : numbers_of(asset, primitive["indices"])) {
    EXPECT_LT(index[0], mesh.positions.size());
    mesh.indices.push_back(static_cast<std::size_t>(index[0]));
  }
  EXPECT_EQ(mesh.indices.size() % 3, 0U);
  return mesh;
}

// Every edge is run along once each way, vertices being where they stand.
void expect_watertight(const Mesh& mesh) {
  std::map<std::pair<std::vector<double>, std::vector<double>>, int> sides;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    ++sides[{mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]]}];
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({side.second, side.first}), 1U);
  }
}

TEST(Gltf, ACubeSplitsAtItsEdgesAndStaysClosed) {
  const Mesh mesh = check_and_read(open_glb(glb_bytes(test::cube(), {})));
  EXPECT_EQ(mesh.positions.size(), 24U);
  EXPECT_EQ(mesh.indices.size(), 36U);
  for (const auto& n : mesh.normals) EXPECT_EQ(std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]), 1);
  expect_watertight(mesh);
}

TEST(Gltf, ASmoothCubeHasOneNormalAVertex) {
  SurfaceLook look;
  look.crease_angle = 100;
  const Mesh smooth = check_and_read(open_glb(glb_bytes(test::cube(), look)));
  ASSERT_EQ(smooth.positions.size(), 8U);
  for (std::size_t v = 0; v < 8; ++v)
    for (std::size_t axis = 0; axis < 3; ++axis)  // outwards
      EXPECT_GT(smooth.normals[v][axis] * (smooth.positions[v][axis] - 0.5), 0);
  // Sharp all round the top (face 1): the normals of its four corners are split off.
  look.sharp.assign(26, 0);
  for (std::size_t corner = 4; corner < 8; ++corner) look.sharp[corner] = 1;
  const Mesh crowned = check_and_read(open_glb(glb_bytes(test::cube(), look)));
  EXPECT_EQ(crowned.positions.size(), 12U);
  expect_watertight(crowned);
}

TEST(Gltf, ColoursGoWithTheVertices) {
  SurfaceLook look;
  for (int v = 0; v < 8; ++v) look.colours.emplace_back(static_cast<float>(v) / 8, 0.25F, 1.0F);
  const SurfaceMesh cube = test::cube();
  const Mesh mesh = check_and_read(open_glb(glb_bytes(cube, look)));
  ASSERT_EQ(mesh.colours.size(), mesh.positions.size());
  for (std::size_t p = 0; p < mesh.positions.size(); ++p) {
    const auto v = static_cast<Eigen::Index>(8 * mesh.colours[p][0]);
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      EXPECT_EQ(mesh.positions[p][static_cast<std::size_t>(axis)], cube.positions(axis, v));
  }
}

TEST(Gltf, TheTextHoldsTheSameAsTheBinaryFile) {
  SurfaceMesh cube = test::cube();
  cube.positions *= 1.0 / 3;
  const json document = json::parse(gltf_text(cube, {}));
  const std::string uri = document["buffers"][0]["uri"], head = "data:application/octet-stream;base64,";
  ASSERT_EQ(uri.substr(0, head.size()), head);
  const Asset text{document, from_base64(uri.substr(head.size()))};
  check_and_read(text);
  EXPECT_EQ(text.binary, open_glb(glb_bytes(cube, {})).binary);
}

TEST(Gltf, SheetsThatTouchAndFacesWithoutAreaAreHeld) {
  SurfaceMesh flat = test::cube();
  flat.positions.row(2).setZero();
  check_and_read(open_glb(glb_bytes(flat, {})));
  flat.positions.setZero();
  check_and_read(open_glb(glb_bytes(flat, {})));
  flat.positions(0, 0) = 1e39;
  EXPECT_THROW((void)glb_bytes(flat, {}), Error);
}

}  // namespace
}  // namespace argil::io
