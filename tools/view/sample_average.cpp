#include "tools/view/sample_average.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "tools/view/shaders.h"

namespace argil::view {

namespace {

// Sixteenths of a pixel. No two are in one row or column; any first ones have their middle near that of the pixel.
constexpr std::array<std::array<float, 2>, SampleAverage::k_most> k_shifts{
    {{0, 0}, {-5, 5}, {5, 1}, {-3, -5}, {-1, 3}, {-7, -1}, {3, 7}, {7, -7}}};

}  // namespace

SampleAverage::SampleAverage(const Gl& gl, int width, int height)
    : gl_(&gl),
      program_(gl, shaders::k_whole_vertex, shaders::k_weighted_fragment),
      sample_(gl, width, height, true),
      mean_(gl, width, height, false),
      nothing_(gl) {
  nothing_.set(std::vector<float>(4, 0.0F), std::array<Attribute, 1>{{{0, 1}}});
}

Camera SampleAverage::shifted(const Camera& camera) const {
  const auto& [right, up] = k_shifts[static_cast<std::size_t>(std::min(count_, k_most - 1))];
  Camera result = camera;
  const float x = 2 * right / static_cast<float>(16 * width()), y = 2 * up / static_cast<float>(16 * height());
  result.clip_from_world.row(0) += x * camera.clip_from_world.row(3);
  result.clip_from_world.row(1) += y * camera.clip_from_world.row(3);
  return result;
}

void SampleAverage::add(const Target& from, const Target& to, float weight) {
  const Gl& gl = *gl_;
  to.bind();
  gl.Viewport(0, 0, width(), height());
  gl.Disable(GL_DEPTH_TEST);
  program_.use();
  from.bind_texture(GL_TEXTURE0);
  gl.Uniform1i(program_.at("image"), 0);
  gl.Uniform1f(program_.at("weight"), weight);
  nothing_.bind();
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void SampleAverage::begin_sample() {
  assert(count_ < k_most);
  const Gl& gl = *gl_;
  if (count_ == 0) summed_ = shown_ = 0;
  if (count_ > summed_) {
    if (!sum_) sum_ = std::make_unique<Target>(gl, width(), height(), false, GL_RGBA16);
    gl.BlendFunc(GL_ONE, GL_ONE);
    if (summed_ == 0)
      gl.Disable(GL_BLEND);
    else
      gl.Enable(GL_BLEND);
    add(sample_, *sum_, 1.0F / k_most);
    gl.Disable(GL_BLEND);
    summed_ = count_;
  }
  ++count_;
  sample_.bind();
}

void SampleAverage::show(GLuint framebuffer) {
  assert(count_ > 0);
  if (count_ == 1) {
    sample_.copy_to(framebuffer);
    return;
  }
  if (shown_ != count_) {
    const Gl& gl = *gl_;
    gl.Disable(GL_BLEND);
    // What is not in the sum yet is added to the mean.
    add(*sum_, mean_, static_cast<float>(k_most) / static_cast<float>(count_));
    if (summed_ < count_) {
      gl.Enable(GL_BLEND);
      gl.BlendFunc(GL_ONE, GL_ONE);
      add(sample_, mean_, 1.0F / static_cast<float>(count_));
      gl.Disable(GL_BLEND);
    }
    shown_ = count_;
  }
  mean_.copy_to(framebuffer);
}

}  // namespace argil::view
