#pragma once
// Loads for a step that the guard eases, and how large loads are.

#include "fem/system.h"

namespace argil::fem {

/// `loads` with a dead force that holds back all but `share` of what is out of balance at `state`: loads,
/// springs, contact and the model's forces together. With share 0 a body at rest there stays.
[[nodiscard]] Loads eased(const System& system, const Loads& loads, const BodyState& state, double share);

/// Σ |force| over the control points, and over springs and contact [N].
struct LoadSize {
  double dead = 0, pull = 0;
};
[[nodiscard]] LoadSize size_of(const Loads& loads, const BodyState& state);

}  // namespace argil::fem
