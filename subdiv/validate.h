#pragma once
// Lists broken invariants of a solid: incidence lists that disagree, faces whose edges are not theirs, cells that
// do not close, dead elements in use, counts and the incremental topology hash. Empty means clean. Cost O(corners).

#include <string>
#include <vector>

#include "subdiv/solid.h"

namespace argil::subdiv {

[[nodiscard]] std::vector<std::string> validate(const Solid& solid);

}  // namespace argil::subdiv
