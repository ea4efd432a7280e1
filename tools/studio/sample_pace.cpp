#include "tools/studio/sample_pace.h"

#include <algorithm>
#include <utility>

namespace argil::studio {

namespace {

constexpr int k_most_samples = 4, k_longest_patience = 4000;
constexpr double k_slow = 1.0 / 40, k_quick = 1.0 / 55, k_wanted = 1.0 / 60;  // [s]

}  // namespace

void SamplePace::frame(double seconds, bool moves) {
  // The time is that of the frame before.
  if (std::exchange(moved_, moves)) {
    slow_ = seconds > k_slow ? slow_ + 1 : 0;
    quick_ = seconds < k_quick ? quick_ + 1 : 0;
    if (slow_ == 2 && samples_ > 1) {  // one slow frame may be anything
      samples_ = std::clamp(static_cast<int>(samples_ * k_wanted / seconds), 1, samples_ - 1);
      patience_ = std::min(2 * patience_, k_longest_patience);
      slow_ = quick_ = 0;
    } else if (quick_ >= patience_ && samples_ < k_most_samples) {
      ++samples_;
      quick_ = 0;
    }
  }
}

}  // namespace argil::studio
