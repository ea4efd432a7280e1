#pragma once
// A body as the subcommands that look at its equations want it: a volume mesh or a session, run to its end, with
// lines of session commands behind it.

#include <memory>

#include "sculpt/session.h"

namespace argil::tools {

struct BodyArguments {
  std::filesystem::path input;     // a volume mesh, or a session (.argil)
  int levels = -1;                 // −1: as in the session; 1 for a mesh
  std::string space, model;        // empty: as in the session, else the usual ones
  std::vector<std::string> pins;   // conditions on control vertices, "x < 0.01"
  std::vector<std::string> lines;  // further session commands, run last
  sculpt::Limits limits;
};

/// Runs it. Lines of a session that save, render, measure or expect are passed over, so that nothing is written.
/// @throws what the commands throw.
[[nodiscard]] std::unique_ptr<sculpt::Session> run_body(const BodyArguments& arguments);

}  // namespace argil::tools
