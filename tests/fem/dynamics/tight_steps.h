#pragma once
// Steps solved so far that only the error of the method itself is left: the reference orders are measured by.

#include "fem/dynamics/integrator.h"

namespace argil::fem::test {

inline StepOptions tight(Method method = Method::bdf2) {
  StepOptions options;
  options.method = method;
  options.newton_cap = 30;
  options.newton_tolerance = 1e-12;
  options.linear_tolerance = 1e-11;
  return options;
}

}  // namespace argil::fem::test
