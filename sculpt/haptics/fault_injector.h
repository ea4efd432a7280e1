#pragma once
// Wraps any device and spoils the exchange on purpose, so that tests meet what cables and drivers do.

#include <vector>

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

enum class DeviceFault {
  delay,         // samples come `amount` ticks late
  drop,          // commands and models do not arrive; samples do
  not_a_number,  // poses are NaN
  stall          // nothing passes: the last sample again, with its old tick
};

struct FaultSpan {
  DeviceFault fault = DeviceFault::stall;
  Tick first = 0, last = 0;  // ticks that it rules, both included
  Tick amount = 0;           // of a delay, >= 0
};

class FaultInjector : public Device {
 public:
  /// The device must outlive it. Where spans overlap, all of them apply.
  FaultInjector(Device& device, std::vector<FaultSpan> spans);
  DeviceCapabilities capabilities() const override { return device_.capabilities(); }
  bool takes_models() const override { return device_.takes_models(); }
  void publish(const ContactModel& model, Tick now) override;
  DeviceSample exchange(const ForceCommand& command, Tick tick) override;

 private:
  bool rules(DeviceFault fault, Tick tick) const;

  Device& device_;
  std::vector<FaultSpan> spans_;
  Tick longest_delay_ = 0;
  ForceCommand delivered_;             // the last that arrived
  std::vector<DeviceSample> samples_;  // the newest last, as far back as a delay reaches
};

}  // namespace argil::sculpt
