#pragma once
// A loop in parallel whose result does not depend on the number of threads: the body writes only what belongs to
// its index.

#include <tbb/parallel_for.h>

#include <cstddef>

namespace argil::subdiv {

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

}  // namespace argil::subdiv
