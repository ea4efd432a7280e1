#pragma once
// A force model that asks, at every evaluation, whether to go on: how a run is stopped at its time limit or by the
// user in the midst of a solver that knows neither.

#include <functional>
#include <memory>

#include "fem/models/force_model.h"

namespace argil::chart {

/// Passes everything on to `model`; `check` may throw.
[[nodiscard]] std::unique_ptr<fem::ForceModel> watched(std::unique_ptr<fem::ForceModel> model,
                                                       std::function<void()> check);

}  // namespace argil::chart
