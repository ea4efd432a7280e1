#include "sculpt/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace argil::sculpt {

long FrameClock::due(double time) {
  if (pace_.rate > 0) {
    // A frame's time counts as reached within a millionth of a frame: the clock is a sum of steps.
    const auto reached = static_cast<long>(std::floor((time - start_) * pace_.rate + 1e-6));
    const long count = std::max(0L, reached - frames_);
    frames_ = reached;  // goes back with the time
    return count;
  }
  if (time <= last_ + k_same_time) steps_ = 0;
  last_ = time;
  if (++steps_ < pace_.every) return 0;
  steps_ = 0;
  return 1;
}

Recording::Recording(const Document& document, std::string name, const std::filesystem::path& path,
                     const FramePace& pace)
    : name_(std::move(name)),
      clock_(pace, document.state().motion->time),
      sink_(make_frame_sink(path)),
      times_{document.state().motion->time},
      topology_(document.solid().topology_hash()),
      level_(document.state().level) {
  sink_->add(document, times_.front());
}

void Recording::take_back(double time) {
  const auto kept = std::lower_bound(times_.begin(), times_.end(), time - k_same_time);
  if (kept == times_.end()) return;
  times_.erase(kept, times_.end());
  sink_->keep(times_.size());
}

void Recording::step(const Document& document) {
  if (over_) return;
  const double time = document.state().motion->time;
  if (sink_->keeps_topology() &&
      (document.solid().topology_hash() != topology_ || document.state().level != level_)) {
    over_ = true;
    over_at_ = time;
    return;
  }
  const long due = clock_.due(time);
  take_back(time);
  if (due == 0 && !times_.empty()) return;
  sink_->add(document, time);
  times_.push_back(time);
}

std::string Recording::finish(const Document& document) {
  if (!over_) take_back(std::max(times_.front(), document.state().motion->time) + 2 * k_same_time);
  sink_->finish();
  const double length = times_.empty() ? 0 : times_.back() - times_.front();
  return fmt::format("{}: {} frame{} over {:.6g} s{}", name_, times_.size(), times_.size() == 1 ? "" : "s", length,
                     over_ ? fmt::format("; it ends before {:.6g} s, when the solid had changed", over_at_) : "");
}

}  // namespace argil::sculpt
