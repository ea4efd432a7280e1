#include "sculpt/haptics/recorded_device.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace argil::sculpt {

DeviceSample DeviceRecorder::exchange(const ForceCommand& command, Tick tick) {
  entries_.push_back({tick, device_.exchange(command, tick)});
  return entries_.back().sample;
}

RecordedDevice::RecordedDevice(std::vector<DeviceRecorder::Entry> entries) : entries_(std::move(entries)) {
  assert(std::is_sorted(entries_.begin(), entries_.end(),
                        [](const auto& a, const auto& b) { return a.asked < b.asked; }));
}

DeviceSample RecordedDevice::exchange(const ForceCommand&, Tick tick) {
  const auto after = std::upper_bound(entries_.begin(), entries_.end(), tick,
                                      [](Tick t, const DeviceRecorder::Entry& entry) { return t < entry.asked; });
  DeviceSample closed;
  closed.tick = tick;
  if (after == entries_.begin()) return closed;
  const DeviceRecorder::Entry& entry = *(after - 1);
  if (after == entries_.end() && tick > entry.asked) {
    closed.pose = entry.sample.pose;
    closed.pressure = entry.sample.pressure;
    return closed;
  }
  return entry.sample;
}

}  // namespace argil::sculpt
