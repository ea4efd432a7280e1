#pragma once
// Notes over the viewport of what goes on without the hand: work that takes a while, with a way to end it, and the
// offer of what an earlier window left unsaved.

#include "tools/studio/chrome.h"

namespace argil::studio {

void draw_work(Desk& desk, const Layout& layout);
/// Once a window, until it is answered.
void draw_offer(Desk& desk, const Layout& layout);

}  // namespace argil::studio
