#pragma once
// Smooth edges in any number of frames: a picture is drawn again and again with the camera shifted within a pixel,
// and the mean of what was drawn so far is shown. While something moves one sample a frame will do; what rests gets
// all of them, whatever draws it (an average over several samples within one draw costs four times as much where
// there is no graphics card).

#include <memory>

#include "tools/view/camera.h"
#include "tools/view/gl_objects.h"

namespace argil::view {

class SampleAverage {
 public:
  static constexpr int k_most = 8;

  /// @throws Error (unsupported) if the context cannot hold pictures of this size.
  SampleAverage(const Gl& gl, int width, int height);

  /// Forgets what was drawn.
  void restart() { count_ = 0; }
  /// Binds what the next sample is to be drawn into. Not after k_most of them.
  void begin_sample();
  /// The mean of the samples drawn since `restart`, one or more, into the framebuffer of this name.
  void show(GLuint framebuffer);
  int count() const { return count_; }
  int width() const { return sample_.width(); }
  int height() const { return sample_.height(); }

  /// The camera of the sample to come, whose picture is shifted by less than half a pixel. The first is not
  /// shifted: its pixels are those of a picture of one sample.
  [[nodiscard]] Camera shifted(const Camera& camera) const;

 private:
  void add(const Target& from, const Target& to, float weight);

  const Gl* gl_;
  Program program_;
  Target sample_, mean_;
  std::unique_ptr<Target> sum_;  // in 16 bits, made when there is a second sample
  VertexArray nothing_;
  int count_ = 0, summed_ = 0, shown_ = 0;
};

}  // namespace argil::view
