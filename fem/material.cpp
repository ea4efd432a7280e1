#include "fem/material.h"

#include <fmt/format.h>

#include <cmath>

#include "subdiv/error.h"

namespace argil::fem {

Lame lame(double young_modulus, double poisson_ratio) {
  if (!(young_modulus > 0) || !std::isfinite(young_modulus))
    throw Error(ErrorCode::bad_input, fmt::format("expected a Young's modulus above 0 Pa, found {}; set "
                                                  "young_modulus to a positive number",
                                                  young_modulus));
  if (!(poisson_ratio > -1 && poisson_ratio < 0.5))
    throw Error(ErrorCode::bad_input, fmt::format("expected a Poisson's ratio above -1 and below 0.5, found {}; "
                                                  "use 0.49 for a nearly incompressible material",
                                                  poisson_ratio));
  return {young_modulus / (2 * (1 + poisson_ratio)),
          young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))};
}

}  // namespace argil::fem
