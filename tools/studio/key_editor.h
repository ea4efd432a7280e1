#pragma once
// The sheet of keys under F1, where they are changed as well.

#include "tools/studio/desk.h"

namespace argil::studio {

void draw_key_editor(Desk& desk, int width, int height);
/// A key pressed while the sheet waits for one. True if it was taken.
bool edit_key(Desk& desk, const Chord& chord);

}  // namespace argil::studio
