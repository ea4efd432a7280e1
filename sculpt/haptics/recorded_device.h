#pragma once
// Recording what a device said, and saying it again: the journal of a session made with a real device.

#include <vector>

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

/// Passes everything on and keeps the samples. The device must outlive it.
class DeviceRecorder : public Device {
 public:
  explicit DeviceRecorder(Device& device) : device_(device) {}
  DeviceCapabilities capabilities() const override { return device_.capabilities(); }
  bool takes_models() const override { return device_.takes_models(); }
  void publish(const ContactModel& model, Tick now) override { device_.publish(model, now); }
  DeviceSample exchange(const ForceCommand& command, Tick tick) override;

  struct Entry {
    Tick asked;  // the tick of the exchange; the sample's own may be older
    DeviceSample sample;
  };
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  Device& device_;
  std::vector<Entry> entries_;
};

/// Answers each exchange with what was recorded last at or before its tick, whatever the force. Closed before the
/// first entry and after the last.
class RecordedDevice : public Device {
 public:
  /// `entries` in ascending order of ticks asked.
  explicit RecordedDevice(std::vector<DeviceRecorder::Entry> entries);
  DeviceCapabilities capabilities() const override { return {}; }
  DeviceSample exchange(const ForceCommand& command, Tick tick) override;

 private:
  std::vector<DeviceRecorder::Entry> entries_;
};

}  // namespace argil::sculpt
