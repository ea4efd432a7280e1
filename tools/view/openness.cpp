#include "tools/view/openness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace argil::view {

namespace {

constexpr int k_size = 256;
constexpr float k_extent = 1.15F;  // half the width of the depth pictures

/// Directions evenly over the sphere above z = -0.35 (a spiral of golden angles).
std::vector<Eigen::Vector3f> directions(int count) {
  std::vector<Eigen::Vector3f> all;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 1.35 * (i + 0.5) / count, radius = std::sqrt(std::max(0.0, 1 - z * z));
    const double turn = M_PI * (3 - std::sqrt(5.0)) * i;
    all.emplace_back(static_cast<float>(radius * std::cos(turn)), static_cast<float>(radius * std::sin(turn)),
                     static_cast<float>(z));
  }
  return all;
}

Eigen::Matrix4f look_along(const Eigen::Vector3f& towards_light) {
  const Eigen::Vector3f side = towards_light.unitOrthogonal();
  Eigen::Matrix4f clip = Eigen::Matrix4f::Identity();
  clip.row(0).head<3>() = side / k_extent;
  clip.row(1).head<3>() = towards_light.cross(side) / k_extent;
  clip.row(2).head<3>() = -towards_light / k_extent;
  return clip;
}

/// Replaces each openness by a mean over the triangles about the vertex: few directions leave blotches.
void smooth(SurfaceMesh& mesh) {
  std::vector<float> sum(mesh.vertices.size(), 0.0F), count(mesh.vertices.size(), 0.0F);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    float mean = 0;
    for (std::size_t k = 0; k < 3; ++k) mean += mesh.vertices[mesh.triangles[t + k]].openness / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      sum[mesh.triangles[t + k]] += mean;
      count[mesh.triangles[t + k]] += 1;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 0) mesh.vertices[i].openness = sum[i] / count[i];
}

}  // namespace

void measure_openness(const Gl& gl, const Program& depth_program, SurfaceMesh& mesh) {
  if (mesh.triangles.empty()) return;
  const std::size_t triangle_count = mesh.triangles.size() / 3;
  const int count = triangle_count < 150'000 ? 32 : triangle_count < 1'000'000 ? 12 : 6;
  VertexArray array(gl);
  array.set(mesh.vertices, k_surface_attributes, 0, mesh.triangles);
  const Target target(gl, k_size, k_size, true);
  target.bind();
  gl.Viewport(0, 0, k_size, k_size);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.Disable(GL_BLEND);
  gl.ClearColor(1, 1, 1, 1);
  depth_program.use();

  std::vector<float> seen(mesh.vertices.size(), 0.0F), total(mesh.vertices.size(), 0.0F);
  std::vector<std::uint8_t> bytes;
  for (const Eigen::Vector3f& light : directions(count)) {
    const Eigen::Matrix4f clip_from_world = look_along(light);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.UniformMatrix4fv(depth_program.at("clip_from_world"), 1, GL_FALSE, clip_from_world.data());
    array.bind();
    gl.DrawElements(GL_TRIANGLES, array.count(), GL_UNSIGNED_INT, nullptr);
    target.read(k_size, k_size, bytes);
    const float sky = light.z() > 0 ? 1.0F : 0.6F;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const SurfaceVertex& vertex = mesh.vertices[i];
      const float cosine = vertex.normal.dot(light);
      if (cosine <= 0.02F) continue;
      // Off the surface by about two texels, so that it does not hide itself.
      const Eigen::Vector4f place = clip_from_world * (vertex.position + 0.018F * vertex.normal).homogeneous();
      const int x = std::clamp(static_cast<int>((0.5F + 0.5F * place.x()) * k_size), 0, k_size - 1);
      const int y = std::clamp(static_cast<int>((0.5F + 0.5F * place.y()) * k_size), 0, k_size - 1);
      const std::uint8_t* texel = &bytes[4 * static_cast<std::size_t>(y * k_size + x)];
      const float depth = static_cast<float>(texel[0] | texel[1] << 8 | texel[2] << 16) / 16777215.0F;
      total[i] += cosine * sky;
      if (0.5F + 0.5F * place.z() <= depth + 0.006F) seen[i] += cosine * sky;
    }
  }
  // A little always comes in, so that faces turned to the ground do not depend on two or three directions.
  const float some = 0.03F * static_cast<float>(count);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i].openness = (seen[i] + 0.7F * some) / (total[i] + some);
  for (int round = 0; round < 2; ++round) smooth(mesh);
}

}  // namespace argil::view
