#pragma once
// The panel at the right: what the tool, the material, the physics, the fields and the history are set by.

#include "tools/studio/chrome.h"

namespace argil::studio {

void draw_material_panel(Desk& desk);
void draw_physics_panel(Desk& desk, float x, float width);
void draw_fields_panel(Desk& desk, const Perform& perform);
void draw_history_panel(Desk& desk, const Perform& perform, float x, float width);
void draw_panels(Desk& desk, const Layout& layout, const Perform& perform);

}  // namespace argil::studio
