#pragma once
// The look of the window as tokens: colours of a dark and a light theme, and the grid that everything stands on. No
// other room of the studio names a colour or a size of its own.

#include <cstdint>

#include "tools/view/colour.h"

namespace argil::studio {

/// A packed colour as Dear ImGui's draw lists take it: red in the lowest byte.
using Ink = std::uint32_t;
[[nodiscard]] Ink ink(const view::Colour& colour);
[[nodiscard]] Ink faded(Ink colour, float alpha);
[[nodiscard]] view::Colour colour_of(Ink colour);

struct Tokens {
  bool light = false;
  Ink panel, bar, status;        // docked panels, the menu and timeline, the line at the bottom
  Ink well, well_hovered, fill;  // what numbers stand in, and the part of their range below them
  Ink raised, outline, shade;    // popups, hairlines, what dims the rest behind a dialogue
  Ink text, quiet, faint;
  Ink accent, on_accent, warning, good, mark;
};
[[nodiscard]] const Tokens& dark_tokens();
[[nodiscard]] const Tokens& light_tokens();

/// Sizes at 1×, in multiples of the grid.
inline constexpr float k_grid = 4, k_corner = 6;
inline constexpr float k_menu_height = 36, k_status_height = 32, k_timeline_height = 56;
inline constexpr float k_shelf_width = 44, k_panel_width = 292, k_gap = 12;
inline constexpr float k_row_height = 28, k_row_gap = 8;
inline constexpr float k_text_size = 15, k_small_size = 13;

/// Dear ImGui's own style where its windows, popups and text fields still show.
void apply_style(const Tokens& tokens, float scale);

}  // namespace argil::studio
