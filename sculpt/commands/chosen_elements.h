#pragma once
// Which elements the arguments of `select` name: filters (`where`, `box`, `ray` …) let some of all of a type
// through, and ways (`loop`, `grow` …) go on from those, or from what is selected.

#include "sculpt/command.h"
#include "sculpt/document.h"

namespace argil::sculpt {

/// @throws Error (bad_input) for arguments that contradict each other, or that would do nothing.
void check_choice(const Arguments& arguments, ElementType type);

/// @throws Error (bad_input) where a way has nothing to go on from, (not_found) for a set that there is not.
[[nodiscard]] Selection chosen_elements(const Document& document, const Arguments& arguments, ElementType type);

}  // namespace argil::sculpt
