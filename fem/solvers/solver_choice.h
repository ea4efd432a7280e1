#pragma once
// Which preconditioner the linear systems of a step get: one rule, from numbers that say how hard they are. A dense
// factor costs least up to 3000 unknowns; beyond, block Jacobi is the faster while conjugate gradients need few
// iterations. On the cantilever of REFERENCES §1 at 1/60 s, to 1e-4 (tests/benchmarks/solver_benchmark.cpp), they
// need 39, 75, 119 at 1372, 8788, 32000 elements and stiffness numbers 86, 298, 705; 99, 189, 293 at 9e3, 3e4, 7e4;
// and with one half 1000 times as stiff 106, 200, 309; the supernodal factor needs 1, and some ten such solves'
// time to make.

#include <cstddef>
#include <string>

#include "fem/solvers/preconditioner.h"
#include "fem/solvers/rest_operator.h"

namespace argil::fem {

inline constexpr std::size_t k_largest_factor = 3000;       // unknowns
inline constexpr double k_largest_contrast = 100;           // for block Jacobi
inline constexpr double k_largest_stiffness_number = 1000;  // likewise

struct SolverInputs {
  std::size_t unknowns = 0;  // 3 x control points
  double contrast = 1;       // largest shear modulus over smallest, where there is stiffness
  double stiffness_number = 0;  // E Δt²/(ρ h²) as the system has it: median of K̃₀ᵢᵢ/(M̃ᵢᵢ/c²); infinite in statics
};

/// The rule.
[[nodiscard]] PreconditionerKind choose_solver(const SolverInputs& inputs);
/// The rule in words, as this build has it.
[[nodiscard]] std::string solver_rule();

[[nodiscard]] double stiffness_contrast(const System& system);
/// `mass_divisor` c² [s²], 0 in statics. Over the control points that are free.
[[nodiscard]] double stiffness_number(const System& system, const RestOperator& rest, double mass_divisor,
                                      const std::vector<std::uint8_t>& free);

}  // namespace argil::fem
