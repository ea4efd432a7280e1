#include "tools/view/openness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::view {

namespace {

constexpr int k_size = 256;
constexpr std::size_t k_triangles_at_once = 100'000;
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

void OpennessMeasure::begin(const SurfaceMesh& mesh) {
  mesh_ = mesh;
  looked_ = 0;
  directions_.clear();
  if (mesh.triangles.empty()) return;
  const std::size_t triangles = mesh.simple_triangles.size() / 3;
  directions_ = directions(triangles < 75'000 ? 32 : triangles < 500'000 ? 12 : 6);
  array_.set(mesh.vertices, k_surface_attributes, 0, mesh.simple_triangles);
  if (!target_) target_ = std::make_unique<Target>(*gl_, k_size, k_size, true);
  seen_.assign(mesh.vertices.size(), 0.0F);
  total_.assign(mesh.vertices.size(), 0.0F);
}

void OpennessMeasure::look_on() {
  if (is_done()) return;
  const Gl& gl = *gl_;
  target_->bind();
  gl.Viewport(0, 0, k_size, k_size);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.Disable(GL_BLEND);
  gl.ClearColor(1, 1, 1, 1);
  program_->use();
  const std::size_t now = std::max<std::size_t>(1, 3 * k_triangles_at_once / mesh_.simple_triangles.size());
  for (std::size_t i = 0; i < now && !is_done(); ++i) look(directions_[looked_++]);
}

void OpennessMeasure::look(const Eigen::Vector3f& light) {
  const Gl& gl = *gl_;
  const Eigen::Matrix4f clip_from_world = look_along(light);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl.UniformMatrix4fv(program_->at("clip_from_world"), 1, GL_FALSE, clip_from_world.data());
  array_.draw({0, mesh_.simple_triangles.size()});
  target_->read(k_size, k_size, bytes_);
  const float sky = light.z() > 0 ? 1.0F : 0.6F;
  for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
    const SurfaceVertex& vertex = mesh_.vertices[i];
    const float cosine = vertex.normal.dot(light);
    if (cosine <= 0.02F) continue;
    // Off the surface by about two texels, so that it does not hide itself.
    const Eigen::Vector4f place = clip_from_world * (vertex.position + 0.018F * vertex.normal).homogeneous();
    const int x = std::clamp(static_cast<int>((0.5F + 0.5F * place.x()) * k_size), 0, k_size - 1);
    const int y = std::clamp(static_cast<int>((0.5F + 0.5F * place.y()) * k_size), 0, k_size - 1);
    const std::uint8_t* texel = &bytes_[4 * static_cast<std::size_t>(y * k_size + x)];
    const float depth = static_cast<float>(texel[0] | texel[1] << 8 | texel[2] << 16) / 16777215.0F;
    total_[i] += cosine * sky;
    if (0.5F + 0.5F * place.z() <= depth + 0.006F) seen_[i] += cosine * sky;
  }
}

void OpennessMeasure::write(SurfaceMesh& mesh) const {
  assert(is_done() && mesh.vertices.size() == seen_.size());
  // A little always comes in, so that faces turned to the ground do not depend on two or three directions.
  const float some = 0.03F * static_cast<float>(directions_.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i].openness = (seen_[i] + 0.7F * some) / (total_[i] + some);
  for (int round = 0; round < 2; ++round) smooth(mesh);
}

}  // namespace argil::view
