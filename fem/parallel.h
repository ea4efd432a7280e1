#pragma once
// Loops in parallel with results that do not depend on the number of threads: a loop writes only what belongs to
// its index, and a sum is taken over chunks of fixed size, then over the chunks in order.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace argil::fem {

template <class Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  if (count <= grain) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

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
