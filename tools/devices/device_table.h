#pragma once
// Which devices there are to sculpt with, on this machine and in this build.

#include <memory>
#include <string>
#include <vector>

#include "sculpt/haptics/device.h"

namespace argil::devices {

struct DeviceEntry {
  std::string name{};     // as `--serve` takes it, where it can be served
  std::string summary{};  // what it is
  bool present = false;
  std::string state{};  // what was found, or what is missing and how to get it
  sculpt::DeviceCapabilities capabilities{};
  bool opens = true;  // by its name alone; a pen goes with the mouse, and a device by UDP has an address
};

/// All kinds, the mouse first. Asks the drivers; takes some milliseconds, and as long as they take to answer.
[[nodiscard]] std::vector<DeviceEntry> list_devices();

/// A device of the kind with everything that it needs.
class OwnedDevice {
 public:
  virtual ~OwnedDevice() = default;
  virtual sculpt::Device& device() = 0;
};
/// `gamepad`, `space_mouse`, `hand` (a simulated one that presses on a floor, for trying things out), or
/// `network ADDRESS:PORT`. @throws (bad_input) for a faulty address, Error (not_found) for another name, with those
/// that can be opened; (unsupported) where it is missing.
[[nodiscard]] std::unique_ptr<OwnedDevice> open_device(const std::string& name);

/// How well this machine keeps a tick of 1 ms: a simulated hand presses on a floor by the real clock.
struct TickBench {
  long ticks = 0, missed = 0;
  double late_p50 = 0, late_p99 = 0, late_most = 0;  // [µs] after the tick was due
  double work_p50 = 0, work_p99 = 0, work_most = 0;  // [µs] that a tick took to compute
};
[[nodiscard]] TickBench bench_ticks(double seconds);

}  // namespace argil::devices
