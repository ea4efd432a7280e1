#include "sculpt/haptics/fault_injector.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace argil::sculpt {

FaultInjector::FaultInjector(Device& device, std::vector<FaultSpan> spans)
    : device_(device), spans_(std::move(spans)) {
  for (const FaultSpan& span : spans_) {
    assert(span.amount >= 0);
    longest_delay_ = std::max(longest_delay_, span.amount);
  }
  samples_.reserve(static_cast<std::size_t>(longest_delay_) + 3);  // one a tick: none is allocated later
}

bool FaultInjector::rules(DeviceFault fault, Tick tick) const {
  return std::any_of(spans_.begin(), spans_.end(), [&](const FaultSpan& span) {
    return span.fault == fault && span.first <= tick && tick <= span.last;
  });
}

void FaultInjector::publish(const ContactModel& model, Tick now) {
  if (!rules(DeviceFault::stall, now) && !rules(DeviceFault::drop, now)) device_.publish(model, now);
}

DeviceSample FaultInjector::exchange(const ForceCommand& command, Tick tick) {
  if (rules(DeviceFault::stall, tick)) return samples_.empty() ? DeviceSample{} : samples_.back();

  if (!rules(DeviceFault::drop, tick)) delivered_ = command;
  samples_.push_back(device_.exchange(delivered_, tick));
  // Keep one sample at or before the oldest tick that can be asked for.
  while (samples_.size() > 1 && samples_[1].tick <= tick - longest_delay_) samples_.erase(samples_.begin());

  Tick delay = 0;
  for (const FaultSpan& span : spans_)
    if (span.fault == DeviceFault::delay && span.first <= tick && tick <= span.last)
      delay = std::max(delay, span.amount);
  std::size_t i = samples_.size() - 1;
  while (i > 0 && samples_[i].tick > tick - delay) --i;
  DeviceSample sample = samples_[i];
  if (rules(DeviceFault::not_a_number, tick))
    sample.pose.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  return sample;
}

}  // namespace argil::sculpt
