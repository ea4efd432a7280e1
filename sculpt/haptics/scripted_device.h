#pragma once
// A device that follows a path given beforehand: `stroke from … to … ticks n`. It is exact: the ends of a segment
// are the given poses bit for bit, and a pose depends on its tick only.

#include <vector>

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

enum class Ease {
  linear,  // constant speed
  smooth   // s²(3 − 2s): starts and ends at rest
};

struct PoseSegment {
  DevicePose from, to;
  Tick ticks = 0;  // ≥ 0; 0 jumps to `to`
  Ease ease = Ease::linear;
  std::uint32_t buttons = 1;                  // pressed along the segment, both ends included
  double from_pressure = 1, to_pressure = 1;  // of a pen, 0 … 1; it changes as the way does
};

class ScriptedDevice : public Device {
 public:
  /// The path begins at tick `start`; before it the device rests at its first pose, after it at its last, both with
  /// no button pressed. `segments` must not be empty.
  explicit ScriptedDevice(std::vector<PoseSegment> segments, Tick start = 0);

  /// A recorded list, not empty: poses[i] at tick start + i.
  static ScriptedDevice from_poses(const std::vector<DevicePose>& poses, std::uint32_t buttons = 1, Tick start = 0);

  DeviceCapabilities capabilities() const override { return {}; }
  DeviceSample exchange(const ForceCommand& command, Tick tick) override;

  DeviceSample sample(Tick tick) const;
  Tick start() const { return start_; }
  Tick end() const { return ends_.back(); }  // tick of the last pose

 private:
  std::vector<PoseSegment> segments_;
  std::vector<Tick> ends_;  // of the segments
  Tick start_;
};

}  // namespace argil::sculpt
