#pragma once
// What every backend of a device keeps to (docs/devices.md). A new one is added to the list in
// conformance_test.cpp, or, where it needs hardware, run by hand.

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

/// Drives the device through 3000 ticks: forces of all kinds, numbers that are none, silences. Fails the present
/// test where the device breaks the contract of device.h.
void expect_conforming(Device& device);

}  // namespace argil::sculpt
