#pragma once
// What an edit would make, before it is made: the lines run on a copy of the document, and what of the surface
// would be new, and what would go, is kept for the window to draw. A line that cannot run says why.

#include <string>
#include <vector>

#include "sculpt/picture.h"
#include "tools/studio/bench.h"

namespace argil::studio {

/// @param surface the one that is drawn now, as `request` made it. Errors of the lines become the ghost's fault.
/// Cost: that of the lines, of refining the result and of drawing it; the document is not touched.
[[nodiscard]] Ghost make_ghost(const sculpt::Document& document, const std::vector<std::string>& lines,
                               const sculpt::PictureRequest& request, const sculpt::SceneSurface& surface,
                               const BenchOptions& options);

}  // namespace argil::studio
