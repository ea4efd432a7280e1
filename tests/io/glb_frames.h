#pragma once
// Reads an animated .glb as a viewer plays it: positions and normals at a time from the mesh, its morph targets and
// the weights of its animation. A second implementation, for tests.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace argil::io {

struct GlbFrames {
  nlohmann::json document;
  std::string binary;
  std::vector<double> times;
  std::vector<double> weights;  // [frame * targets + target]
  std::vector<std::uint32_t> indices;

  [[nodiscard]] std::size_t targets() const { return times.empty() ? 0 : weights.size() / times.size(); }

  [[nodiscard]] std::vector<float> floats(std::size_t accessor) const {
    const auto& of = document.at("accessors").at(accessor);
    const auto& view = document.at("bufferViews").at(of.at("bufferView").get<std::size_t>());
    const std::size_t count = of.at("count").get<std::size_t>() * (of.at("type") == "VEC3" ? 3 : 1);
    EXPECT_EQ(view.at("byteLength").get<std::size_t>(), 4 * count);
    EXPECT_EQ(view.at("byteOffset").get<std::size_t>() % 4, 0U);
    std::vector<float> values(count);
    EXPECT_LE(view.at("byteOffset").get<std::size_t>() + 4 * count, binary.size());
    std::memcpy(values.data(), binary.data() + view.at("byteOffset").get<std::size_t>(), 4 * count);
    if (of.contains("min"))
      for (std::size_t axis = 0; axis < of["min"].size(); ++axis) {
        float low = values[axis], high = low;
        for (std::size_t i = axis; i < count; i += of["min"].size()) {
          low = std::min(low, values[i]);
          high = std::max(high, values[i]);
        }
        EXPECT_EQ(of["min"][axis].get<float>(), low);
        EXPECT_EQ(of["max"][axis].get<float>(), high);
      }
    return values;
  }

  /// 3 x points of "POSITION" or "NORMAL" at a time, weights straight between frames.
  [[nodiscard]] Eigen::Matrix3Xd at(const std::string& attribute, double time) const {
    const auto& primitive = document.at("meshes")[0].at("primitives")[0];
    const auto matrix = [&](std::size_t accessor) {
      const std::vector<float> values = floats(accessor);
      Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(values.size() / 3));
      for (std::size_t i = 0; i < values.size(); ++i) result.data()[i] = double{values[i]};
      return result;
    };
    Eigen::Matrix3Xd sum = matrix(primitive.at("attributes").at(attribute).get<std::size_t>());
    if (times.empty()) return sum;
    std::size_t next = 0;
    while (next + 1 < times.size() && times[next] < time) ++next;
    const std::size_t before = next == 0 ? 0 : next - 1;
    const double share =
        next == 0 ? 0 : std::clamp((time - times[before]) / (times[next] - times[before]), 0.0, 1.0);
    for (std::size_t k = 0; k < targets(); ++k) {
      const double weight = (1 - share) * weights[before * targets() + k] + share * weights[next * targets() + k];
      if (weight != 0) sum += weight * matrix(primitive.at("targets").at(k).at(attribute).get<std::size_t>());
    }
    return sum;
  }
};

inline GlbFrames read_glb_frames(const std::string& bytes) {
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  GlbFrames glb;
  if (bytes.size() < 28 || bytes.substr(0, 4) != "glTF" || word(8) != bytes.size()) {
    ADD_FAILURE() << "no whole .glb";
    return glb;
  }
  const std::size_t json = word(12);
  glb.document = nlohmann::json::parse(bytes.substr(20, json));
  glb.binary = bytes.substr(28 + json);
  EXPECT_EQ(word(20 + json), glb.binary.size());
  EXPECT_EQ(glb.document["buffers"][0]["byteLength"], glb.binary.size());
  const auto& indices =
      glb.document["accessors"].at(glb.document["meshes"][0]["primitives"][0]["indices"].get<std::size_t>());
  glb.indices.resize(indices["count"].get<std::size_t>());
  std::memcpy(
      glb.indices.data(),
      glb.binary.data() +
          glb.document["bufferViews"][indices["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>(),
      4 * glb.indices.size());
  if (!glb.document.contains("animations")) return glb;
  const auto& animation = glb.document["animations"].at(0);
  EXPECT_EQ(animation["channels"][0]["target"]["path"], "weights");
  EXPECT_EQ(animation["channels"][0]["target"]["node"], 0);
  const auto& sampler = animation["samplers"].at(0);
  EXPECT_EQ(sampler["interpolation"], "LINEAR");
  for (const float time : glb.floats(sampler["input"].get<std::size_t>())) glb.times.push_back(double{time});
  for (const float weight : glb.floats(sampler["output"].get<std::size_t>())) glb.weights.push_back(double{weight});
  return glb;
}

}  // namespace argil::io
