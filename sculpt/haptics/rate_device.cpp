#include "sculpt/haptics/rate_device.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::sculpt {

namespace {

constexpr Tick k_longest_silence = 50;

}  // namespace

RateDevice::RateDevice(RateSource& source, const RateOptions& options) : source_(source), options_(options) {
  assert(options.dead_zone >= 0 && options.dead_zone < 1 && options.exponent > 0 && options.full_force > 0);
}

void RateDevice::place(const DevicePose& pose) {
  assert(pose.position.allFinite());
  sample_.pose = pose;
  sample_.pose.position = pose.position.cwiseMax(options_.workspace_low).cwiseMin(options_.workspace_high);
}

DeviceCapabilities RateDevice::capabilities() const {
  DeviceCapabilities capabilities;
  capabilities.sensed_axes = 6;
  capabilities.workspace_low = options_.workspace_low;
  capabilities.workspace_high = options_.workspace_high;
  return capabilities;
}

double RateDevice::rate(double deflection) const {
  if (!std::isfinite(deflection)) return 0;
  const double size = std::min(1.0, std::abs(deflection));
  if (size <= options_.dead_zone) return 0;
  return std::copysign(std::pow((size - options_.dead_zone) / (1 - options_.dead_zone), options_.exponent),
                       deflection);
}

DeviceSample RateDevice::exchange(const ForceCommand& command, Tick tick) {
  const std::optional<RateInput> input = source_.poll();
  const double seconds =
      started_ ? k_tick_seconds * static_cast<double>(std::clamp<Tick>(tick - sample_.tick, 0, k_longest_silence))
               : 0;
  sample_.tick = tick;
  sample_.mode = input ? DeviceMode::idle : DeviceMode::closed;
  sample_.buttons = input ? input->buttons : 0;
  started_ = true;
  if (!input) return sample_;

  Eigen::Vector3d way, turn;
  for (int axis = 0; axis < 3; ++axis) {
    way[axis] = options_.speed * seconds * rate(input->axes[static_cast<std::size_t>(axis)]);
    turn[axis] = options_.turn * seconds * rate(input->axes[static_cast<std::size_t>(axis) + 3]);
  }
  place({sample_.pose.position + way, sample_.pose.orientation});
  if (const double angle = turn.norm(); angle > 0)
    sample_.pose.orientation = (Eigen::AngleAxisd(angle, turn / angle) * sample_.pose.orientation).normalized();

  const double size = command.force.allFinite() ? force_at(command, tick).stableNorm() : 0;
  source_.rumble(std::min(1.0, size / options_.full_force));
  return sample_;
}

}  // namespace argil::sculpt
