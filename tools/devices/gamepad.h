#pragma once
// The first gamepad that SDL knows, as rates: left stick along x and y, right stick turns, triggers along z,
// buttons as SDL numbers them; it rumbles by the force.

#include <memory>
#include <string>

#include "sculpt/haptics/rate_device.h"

namespace argil::devices {

/// Whether this build can.
[[nodiscard]] bool gamepads_supported();
/// Its name, or empty: none is plugged in, or this build cannot.
[[nodiscard]] std::string gamepad_name();
/// It may be unplugged and plugged in again while open.
/// @throws Error (unsupported) where this build cannot or SDL does not start, with its reason and the remedy.
[[nodiscard]] std::unique_ptr<sculpt::RateSource> open_gamepad();

}  // namespace argil::devices
