#pragma once
// Supernodal sparse Cholesky as a preconditioner, where the build has CHOLMOD. Its matrix is the rest operator's S₀
// without the springs: their rank is small, and a tool that takes hold then needs no new factor.

#include <memory>

#include "fem/solvers/preconditioner.h"

namespace argil::fem {

/// Whether this build has CHOLMOD.
[[nodiscard]] bool has_supernodal();

/// Null where there is no CHOLMOD, or S₀ has no factor. As make_preconditioner(). Cost some N² operations for a
/// solid of N control points: 1.3 s at 8000 elements (REFERENCES §9).
[[nodiscard]] std::unique_ptr<Preconditioner> make_supernodal(const RestOperator& rest,
                                                              const Eigen::SparseMatrix<double>& inertia,
                                                              const std::vector<std::uint8_t>& free);

}  // namespace argil::fem
