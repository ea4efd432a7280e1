#pragma once
// Lines over time in a panel: the force of a stroke, the energy of the body.

#include "tools/studio/desk.h"

namespace argil::studio {

struct Plot {
  const char *name, *tooltip, *unit, *empty;  // `empty`: said where there is nothing to plot yet
};
/// Takes a row of the panel, from 0 to the largest value.
void draw_plot(Desk& desk, const Plot& plot, const std::vector<float>& values, float x, float width);

/// Appends what this frame's snapshot brings of force and energy.
void follow_plots(Desk& desk);

}  // namespace argil::studio
