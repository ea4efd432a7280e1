#pragma once
// What an edit would make, before it is made: the lines run on a copy of the document, and what of the surface
// would be new, and what would go, is kept for the window to draw. A line that cannot run says why.

#include <memory>
#include <string>
#include <vector>

#include "sculpt/picture.h"
#include "subdiv/progress.h"
#include "tools/studio/snapshot.h"

namespace argil::studio {

/// Of what a ghost is made; it shares nothing with the document that anything changes.
struct GhostSubject {
  sculpt::State state;  // detached
  sculpt::PictureRequest request;
  std::shared_ptr<const sculpt::Scene> scene;  // that is drawn now, as `request` made it
  std::uint64_t layout = 0;                    // of the snapshot that has it
  std::filesystem::path out;                   // as of the session
  sculpt::Limits limits;
};
/// A copy of a state that edits of the document leave alone. Cost: that of copying the control solid and its
/// fields.
[[nodiscard]] sculpt::State detached(const sculpt::State& state);

/// Errors of the lines become the ghost's fault; what `progress` throws ends it. Cost: that of the lines, of
/// refining the result and of drawing it.
[[nodiscard]] Ghost make_ghost(const GhostSubject& subject, const std::vector<std::string>& lines,
                               const Progress::Listener& progress);

}  // namespace argil::studio
