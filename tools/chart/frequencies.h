#pragma once
// Lowest frequencies of a body at rest, by subspace iteration with a factor of K̃ + σM̃ (Bathe 1971).

#include <vector>

#include "fem/system.h"

namespace argil::chart {

/// The lowest `count` frequencies [Hz] of the free control points, ascending, rigid motions (0) included. `shift`
/// [rad²/s²] > 0 where rigid motions are free, of the order of the squares that are asked for.
/// @throws Error (not_converged) if K̃ + σM̃ has no factor or the iteration does not settle to 1e-8.
/// Cost: one sparse factorisation and some tens of solves a frequency.
[[nodiscard]] std::vector<double> lowest_frequencies(const fem::System& system, int count, double shift);

}  // namespace argil::chart
