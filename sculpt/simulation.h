#pragma once
// Steps of the simulation as commands take them: one step of the integrator with the document's loads and a tool's
// springs, counted, traced and timed.

#include <vector>

#include "sculpt/session.h"

namespace argil::sculpt {

/// Advances the document (without making an undo record) by `time_step` [s].
/// @throws Error (not_converged) if the state would not be finite; the document is as before this step.
void simulation_step(Session& session, const std::vector<fem::AnchorSpring>& tool_springs, double time_step);

/// @throws Error (bad_input) where steps cannot be taken: no solid, level 0 with cells that are not hexahedra, ….
void require_simulation(Session& session);

}  // namespace argil::sculpt
