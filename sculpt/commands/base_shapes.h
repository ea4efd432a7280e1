#pragma once
// Base shapes by name, for the commands that begin with one or add one.

#include <string>
#include <vector>

#include "sculpt/command.h"
#include "subdiv/build.h"

namespace argil::sculpt {

class Session;

/// The arguments of every shape; `shape` itself is required where there is no other source.
[[nodiscard]] std::vector<Parameter> shape_parameters(bool required);

/// @throws Error (bad_input) naming an argument that the shape does not have; (limit_exceeded) before anything is
/// made, where it and `cells_there` would be more cells than the session may have.
[[nodiscard]] subdiv::Built base_shape(const Session& session, const Arguments& arguments, double cells_there);

}  // namespace argil::sculpt
