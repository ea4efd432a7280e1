#pragma once
// Devices in the window: which there are to choose from, and where the chosen one is.

#include "tools/studio/desk.h"
#include "tools/studio/orbit_camera.h"

namespace argil::studio {

void draw_devices(Desk& desk, int width, int height);
/// The device in the view: a ring where it is, as large as the brush, and what is felt.
void draw_device_mark(Desk& desk, const OrbitCamera& camera);
/// Tells the workshop the brush and the view that a stroke of the device would begin with, if they changed.
void lay_brush_ready(Desk& desk, const OrbitCamera& camera);

}  // namespace argil::studio
