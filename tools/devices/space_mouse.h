#pragma once
// A 3D mouse by spacenavd, as rates.

#include <memory>

#include "sculpt/haptics/rate_device.h"

namespace argil::devices {

/// Whether this build can.
[[nodiscard]] bool space_mice_supported();
/// Whether spacenavd answers.
[[nodiscard]] bool space_mouse_present();
/// @throws Error (unsupported) where this build cannot or spacenavd does not answer, with the remedy.
[[nodiscard]] std::unique_ptr<sculpt::RateSource> open_space_mouse();

}  // namespace argil::devices
