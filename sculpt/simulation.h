#pragma once
// Steps of the simulation as commands take them: one step of the integrator with the document's loads and those of
// a tool, counted, traced and timed.

#include "sculpt/session.h"

namespace argil::sculpt {

/// Advances the document (without making an undo record) by `time_step` [s], in the substeps that the state asks
/// for, under its guard.
/// @throws Error (not_converged) if the state would not be finite and the guard is off; the document is as before
/// this step.
void simulation_step(Session& session, const fem::Loads& tool, double time_step);

/// Says what the guard did in the steps from `first_step` on (a place in Session::steps()), if it did anything.
void report_guard(const Session& session, std::size_t first_step);

/// @throws Error (bad_input) where steps cannot be taken: no solid, level 0 with cells that are not hexahedra, ….
void require_simulation(Session& session);

}  // namespace argil::sculpt
