#pragma once
// The panel at the right: what the tool, the material, the physics, the fields and the history are set by.

#include "tools/studio/chrome.h"

namespace argil::studio {

void draw_panels(Desk& desk, const Layout& layout, const Perform& perform);

}  // namespace argil::studio
