#pragma once
// What is said where there is no force of a name.

#include <string>
#include <vector>

#include "sculpt/document.h"

namespace argil::sculpt {

/// "there is no force named 'pus'; did you mean …", with what to do.
[[nodiscard]] std::string no_such_force(const std::vector<AppliedForce>& forces, const std::string& name);
[[nodiscard]] std::string no_such_pressure(const std::vector<AppliedPressure>& pressures, const std::string& name);

}  // namespace argil::sculpt
