#pragma once
// summary.json: what a replay did and what it cost.

#include <string>

#include "sculpt/session.h"

namespace argil::sculpt {

/// JSON text; the keys are those that `argil replay --help` names. Times are of this run, everything else is the
/// same for any number of threads.
[[nodiscard]] std::string summary_json(const Session& session, const std::string& name, int threads);

}  // namespace argil::sculpt
