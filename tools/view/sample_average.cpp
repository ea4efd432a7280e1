#include "tools/view/sample_average.h"

#include <array>
#include <cassert>
#include <cmath>

#include "tools/view/shaders.h"

namespace argil::view {

SampleAverage::SampleAverage(const Gl& gl, int width, int height)
    : gl_(&gl),
      program_(gl, shaders::k_whole_vertex, shaders::k_weighted_fragment),
      sample_(gl, width, height, true),
      mean_(gl, width, height, false),
      nothing_(gl) {
  nothing_.set(std::vector<float>(4, 0.0F), std::array<Attribute, 1>{{{0, 1}}});
}

Camera SampleAverage::shifted(const Camera& camera) const {
  // Additive recurrence on the plastic number: any number of first members lies evenly.
  const auto within = [&](double step) {
    const double place = 0.5 + step * count_;
    return place - std::floor(place) - 0.5;
  };
  Camera result = camera;
  const auto x = static_cast<float>(2 * within(0.7548776662466927) / width()),
             y = static_cast<float>(2 * within(0.5698402909980532) / height());
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
