#pragma once
// What a dialogue stands on: the window behind it dimmed, so that a click beside the sheet closes it.

#include "tools/studio/desk.h"

namespace argil::studio {

/// Begins the sheet's panel; end it with `ui.end_panel()`.
void open_sheet(Desk& desk, const char* name, const Rect& place, int width, int height);

}  // namespace argil::studio
