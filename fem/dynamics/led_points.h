#pragma once
// Fixed control points that are led (LedPoints of system.h) within a step: where they are at its end. Their
// accelerations act on the free points by the consistent mass.

#include "fem/system.h"

namespace argil::fem {

/// Of a step of `time_step` [s] from `state`: all the way to where they are led if it ends then, else a part of the
/// straight way, at an even speed. Columns are those of `led`.
struct LedStep {
  Eigen::Matrix3Xd positions, velocities, accelerations;  // at the end; the mean acceleration [m/s²]
};
[[nodiscard]] LedStep led_step(const LedPoints& led, const BodyState& state, double time_step);

/// Copies those columns of 3 x control points, to keep them while others are cleared.
[[nodiscard]] Eigen::Matrix3Xd led_columns(const LedPoints& led, const Eigen::Matrix3Xd& values);
void set_led_columns(const LedPoints& led, const Eigen::Matrix3Xd& columns, Eigen::Matrix3Xd& values);

/// Work of what leads them on the way between two states [J]: by the mean of the forces that they need at its ends.
[[nodiscard]] double led_work(const System& system, const Loads& loads, const BodyState& from, const BodyState& to);

}  // namespace argil::fem
