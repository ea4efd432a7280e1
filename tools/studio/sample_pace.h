#pragma once
// How many samples a pixel a frame can afford while something moves (sample_average.h): as many as keep the frames
// coming. What rests gets its samples over several frames.

namespace argil::studio {

class SamplePace {
 public:
  /// Once a frame: the time since the one before [s], and whether this one draws everything anew.
  void frame(double seconds, bool moves);
  int samples() const { return samples_; }

 private:
  int samples_ = 4;
  int slow_ = 0, quick_ = 0;
  int patience_ = 60;  // quick frames before one more sample is tried; doubled whenever that was too much
  bool moved_ = false;
};

}  // namespace argil::studio
