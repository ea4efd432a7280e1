#pragma once
// Clocks that pace a device, in ticks of 1 ms. Replay uses the virtual one; a window hands its own time to the real
// one, so that no library reads a clock.

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

class VirtualClock {
 public:
  Tick now() const { return now_; }
  void advance(Tick ticks = 1) { now_ += ticks; }

 private:
  Tick now_ = 0;
};

class RealClock {
 public:
  /// `seconds` returns a time that should not fall, from any start.
  explicit RealClock(std::function<double()> seconds) : seconds_(std::move(seconds)), start_(seconds_()) {}

  /// Whole ticks since the start; never falls, even if the time does.
  Tick now() {
    // Half a nanosecond up, so that n / 1000 s is n ticks in spite of rounding.
    now_ = std::max(now_, static_cast<Tick>(std::floor((seconds_() - start_) / k_tick_seconds + 5e-7)));
    return now_;
  }

 private:
  std::function<double()> seconds_;
  double start_;
  Tick now_ = 0;
};

}  // namespace argil::sculpt
