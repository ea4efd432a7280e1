#pragma once
// Loops in parallel with results that do not depend on the number of threads: a loop writes only what belongs to
// its index, and a sum is taken over chunks of fixed size, then over the chunks in order.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "subdiv/parallel.h"

namespace argil::fem {

using subdiv::parallel_for;

/// Sum of term(i); chunks of `chunk` terms, so that the order of summation is fixed.
template <class Term>
[[nodiscard]] double parallel_sum(std::size_t count, std::size_t chunk, const Term& term) {
  const std::size_t chunks = (count + chunk - 1) / chunk;
  std::vector<double> partial(chunks, 0.0);
  parallel_for(chunks, 1, [&](std::size_t c) {
    double sum = 0;
    for (std::size_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) sum += term(i);
    partial[c] = sum;
  });
  double sum = 0;
  for (const double p : partial) sum += p;
  return sum;
}

}  // namespace argil::fem
