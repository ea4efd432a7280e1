#pragma once
// A script for the studio: one line of text for each thing that a hand does (docs/studio.md). It runs off the
// screen, in virtual time, and so gives the same document and the same pictures each time.

#include <string>

#include "tools/studio/offscreen.h"

namespace argil::studio {

struct ScriptResult {
  int pictures = 0, failed = 0;
};

/// Pictures are written beneath `out`; `print` takes what `print` lines and failed expectations say.
/// @throws Error (bad_input, not_found) with file:line for a line that is not one, or a control that is not there.
ScriptResult run_script(const std::string& text, const std::string& file_name, Offscreen& window,
                        const std::filesystem::path& out, const std::function<void(const std::string&)>& print);

}  // namespace argil::studio
