#pragma once
// What stands around the viewport: menus above, the shelf of tools, the legend, the line of numbers below, and the
// card of the first minute.

#include <functional>

#include "tools/studio/desk.h"

namespace argil::studio {

/// Where everything stands, in pixels.
struct Layout {
  Rect menu, shelf, panel, legend, timeline, status, free;
};
[[nodiscard]] Layout lay_out(const Desk& desk, int width, int height);

using Perform = std::function<void(Action)>;

void draw_menu(Desk& desk, const Layout& layout, const Perform& perform);
void draw_shelf(Desk& desk, const Layout& layout);
void draw_legend(Desk& desk, const Layout& layout);
void draw_status(Desk& desk, const Layout& layout);
/// The first gestures, once; then a line of what the tool does; or what to do where there is no solid.
void draw_hints(Desk& desk, const Layout& layout, const Perform& perform);

}  // namespace argil::studio
