#pragma once
// Motion of a body as a whole, its shape held: what is left to a body that cannot be deformed by any step. The
// constraint that holds the shape is inside the body, so that it changes no momentum.

#include "fem/system.h"

namespace argil::fem {

/// True if nothing is fixed: pins leave a body no such motion.
[[nodiscard]] bool moves_as_a_whole(const System& system);

/// One step of implicit Euler, of length `time_step` [s], for the translation of the body: all control points get
/// the velocity that its momentum, the loads, springs and damping by density make together. Rotation is lost, with
/// its energy. History is cleared. Cost O(control points).
void step_as_a_whole(const System& system, const Loads& loads, BodyState& state, double time_step);

}  // namespace argil::fem
