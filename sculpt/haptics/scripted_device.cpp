#include "sculpt/haptics/scripted_device.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace argil::sculpt {

namespace {

void set_between(const PoseSegment& segment, Tick since, DeviceSample& sample) {
  const bool first = since <= 0 && segment.ticks > 0;
  if (first || since >= segment.ticks) {
    sample.pose = first ? segment.from : segment.to;
    sample.pressure = first ? segment.from_pressure : segment.to_pressure;
    return;
  }
  double s = static_cast<double>(since) / static_cast<double>(segment.ticks);
  if (segment.ease == Ease::smooth) s = s * s * (3 - 2 * s);
  sample.pose = {(1 - s) * segment.from.position + s * segment.to.position,
                 segment.from.orientation.slerp(s, segment.to.orientation)};
  sample.pressure = (1 - s) * segment.from_pressure + s * segment.to_pressure;
}

}  // namespace

ScriptedDevice::ScriptedDevice(std::vector<PoseSegment> segments, Tick start)
    : segments_(std::move(segments)), start_(start) {
  assert(!segments_.empty());
  Tick end = start;
  for (const PoseSegment& segment : segments_) {
    assert(segment.ticks >= 0);
    ends_.push_back(end += segment.ticks);
  }
}

ScriptedDevice ScriptedDevice::from_poses(const std::vector<DevicePose>& poses, std::uint32_t buttons, Tick start) {
  assert(!poses.empty());
  std::vector<PoseSegment> segments = {{poses[0], poses[0], 0, Ease::linear, buttons}};
  for (std::size_t i = 1; i < poses.size(); ++i)
    segments.push_back({poses[i - 1], poses[i], 1, Ease::linear, buttons});
  return ScriptedDevice(std::move(segments), start);
}

DeviceSample ScriptedDevice::exchange(const ForceCommand&, Tick tick) {
  return sample(tick);
}

DeviceSample ScriptedDevice::sample(Tick tick) const {
  // Where two segments meet, the later one speaks.
  const auto next = std::upper_bound(ends_.begin(), ends_.end(), tick);
  const std::size_t i = std::min(static_cast<std::size_t>(next - ends_.begin()), segments_.size() - 1);
  const PoseSegment& segment = segments_[i];
  DeviceSample sample;
  set_between(segment, tick - (ends_[i] - segment.ticks), sample);
  sample.buttons = tick < start_ || tick > end() ? 0 : segment.buttons;
  sample.tick = tick;
  sample.mode = DeviceMode::idle;
  return sample;
}

}  // namespace argil::sculpt
