#include "tools/view/ground_shadow.h"

#include <algorithm>
#include <array>

#include "tools/view/shaders.h"

namespace argil::view {

GroundShadow::GroundShadow(const Gl& gl)
    : gl_(&gl),
      footprint_program_(gl, shaders::k_footprint_vertex, shaders::k_footprint_fragment),
      blur_program_(gl, shaders::k_whole_vertex, shaders::k_blur_fragment),
      shade_program_(gl, shaders::k_whole_vertex, shaders::k_shade_fragment),
      ground_program_(gl, shaders::k_ground_vertex, shaders::k_ground_fragment),
      footprint_(gl, k_size, k_size, false),
      half_close_(gl, k_close, k_close, false),
      close_(gl, k_close, k_close, false),
      half_wide_(gl, k_wide, k_wide, false),
      wide_(gl, k_wide, k_wide, false),
      shade_(gl, k_close, k_close, false),
      nothing_(gl) {
  nothing_.set(std::vector<float>(4, 0.0F), std::array<Attribute, 1>{{{0, 1}}});
}

void GroundShadow::prepare(const SurfaceMesh& mesh, const VertexArray& array, const IndexRange& triangles) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(2), high = -low;
  for (const SurfaceVertex& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex.position);
    high = high.cwiseMax(vertex.position);
  }
  const float broad = std::max({high.x() - low.x(), high.y() - low.y(), 0.2F});
  const float half_x = 0.5F * (high.x() - low.x()) + 0.45F * broad;
  const float half_y = 0.5F * (high.y() - low.y()) + 0.45F * broad;
  ground_ << 0.5F * (low.x() + high.x()), 0.5F * (low.y() + high.y()), half_x, half_y;
  height_ = low.z();

  const Gl& gl = *gl_;
  gl.Disable(GL_DEPTH_TEST);
  gl.Viewport(0, 0, k_size, k_size);
  footprint_.bind();
  gl.ClearColor(0, 0, 0, 0);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  gl.Enable(GL_BLEND);
  gl.BlendEquation(GL_MAX);
  footprint_program_.use();
  gl.Uniform4f(footprint_program_.at("ground"), ground_[0], ground_[1], ground_[2], ground_[3]);
  gl.Uniform1f(footprint_program_.at("ground_height"), height_);
  array.draw(triangles);
  gl.BlendEquation(GL_FUNC_ADD);
  gl.Disable(GL_BLEND);
  const float close_sigma = 0.022F * broad, wide_sigma = 0.10F * broad;
  blur(footprint_, half_close_, close_, close_sigma / (2 * half_x), close_sigma / (2 * half_y));
  blur(close_, half_wide_, wide_, wide_sigma / (2 * half_x), wide_sigma / (2 * half_y));
  gl.Viewport(0, 0, k_close, k_close);
  shade_program_.use();
  gl.Uniform1i(shade_program_.at("close"), 0);
  gl.Uniform1i(shade_program_.at("wide"), 1);
  nothing_.bind();
  close_.bind_texture(GL_TEXTURE0);
  wide_.bind_texture(GL_TEXTURE1);
  shade_.bind();
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void GroundShadow::blur(const Target& from, const Target& half, const Target& to, float sigma_x, float sigma_y) {
  gl_->Viewport(0, 0, to.width(), to.height());
  blur_program_.use();
  gl_->Uniform1i(blur_program_.at("image"), 0);
  nothing_.bind();
  from.bind_texture(GL_TEXTURE0);
  half.bind();
  gl_->Uniform2f(blur_program_.at("stride"), sigma_x / 2.5F, 0);
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  half.bind_texture(GL_TEXTURE0);
  to.bind();
  gl_->Uniform2f(blur_program_.at("stride"), 0, sigma_y / 2.5F);
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

void GroundShadow::paint(const Camera& camera, float opacity) const {
  if (camera.eye.z() <= height_) return;
  const Gl& gl = *gl_;
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.Disable(GL_DEPTH_TEST);
  ground_program_.use();
  gl.UniformMatrix4fv(ground_program_.at("clip_from_world"), 1, GL_FALSE, camera.clip_from_world.data());
  gl.Uniform4f(ground_program_.at("ground"), ground_[0], ground_[1], ground_[2], ground_[3]);
  gl.Uniform1f(ground_program_.at("ground_height"), height_);
  gl.Uniform1f(ground_program_.at("opacity"), opacity);
  shade_.bind_texture(GL_TEXTURE0);
  gl.Uniform1i(ground_program_.at("shade"), 0);
  nothing_.bind();
  gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl.Disable(GL_BLEND);
}

}  // namespace argil::view
