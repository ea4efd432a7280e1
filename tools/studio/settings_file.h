#pragma once
// What of the sculptor's settings a window keeps for the next one: the file `window` beside their keys, a line
// each.
//
//   # what the pressure of a pen scales: strength, radius, or nothing (off)
//   pen = strength

#include <array>
#include <string>
#include <string_view>

#include "tools/studio/desk.h"

namespace argil::studio {

inline constexpr std::array<const char*, 3> k_pen_words{"strength", "radius", "off"};  // as PenScales has them

/// Takes what the lines say; the rest of `settings` stays. @throws Error (bad_input) with file:line.
void read_settings(Settings& settings, std::string_view text, const std::string& file_name);
/// The lines that read_settings needs to make these.
[[nodiscard]] std::string settings_lines(const Settings& settings);

}  // namespace argil::studio
