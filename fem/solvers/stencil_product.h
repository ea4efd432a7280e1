#pragma once
// Products with the rows of A into memory that is already there, for the inner loops of the solvers.

#include "subdiv/stencils.h"

namespace argil::fem {

/// result = stencils * values; `values` 3 x columns, `result` (resized if needed) 3 x rows. In parallel by rows,
/// each summed in the order of its columns.
void multiply(const subdiv::Stencils& stencils, const Eigen::Matrix3Xd& values, Eigen::Matrix3Xd& result);

}  // namespace argil::fem
