#pragma once
// The timeline: play and step, how far time has gone, where strokes ended, and keys as marks that are set, dragged
// and removed. Each of these is lines of the session that one undo takes back.

#include "tools/studio/chrome.h"

namespace argil::studio {

void draw_timeline(Desk& desk, const Layout& layout, const Perform& perform);
/// Del over a mark, Esc while one is dragged, the key that sets keys. True if it was for the timeline.
bool perform_on_timeline(Desk& desk, Action action);

}  // namespace argil::studio
