#pragma once
// The solution that errors are measured against, as an argument of commands that measure, save or draw them.

#include <memory>

#include "sculpt/command.h"
#include "sculpt/reference_shape.h"

namespace argil::sculpt {

[[nodiscard]] Parameter reference_parameter();
/// Null where the argument is not given. @throws Error as reading the file does.
[[nodiscard]] std::shared_ptr<const ReferenceShape> reference_of(const Session& session,
                                                                 const Arguments& arguments);

}  // namespace argil::sculpt
