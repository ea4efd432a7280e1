#pragma once
// What opens over the window: the search for commands, the sheet of keys, and the names of files.

#include "tools/studio/chrome.h"

namespace argil::studio {

void draw_dialogues(Desk& desk, const Layout& layout, const Perform& perform, int width, int height);
/// Up, down and Enter in the search. True if it was taken.
bool search_key(Desk& desk, int key, const Perform& perform);

}  // namespace argil::studio
