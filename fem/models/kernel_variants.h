#pragma once
// Loops that are compiled twice, for the baseline and for AVX2, and chosen when the program runs. Both give the
// same bits. An operation is a struct with
//   template <class Isa> static ARGIL_LANES_INLINE void run(arguments…),
// Isa being Baseline or Avx2; what is long and rarely needed can then be called out of line (packet_points.h).

#include "fem/models/lanes.h"

namespace argil::fem {

enum class Instructions { best, baseline };

struct Baseline;
struct Avx2;

template <class Operation, class... Arguments>
__attribute__((flatten)) void run_baseline(Arguments... arguments) {
  Operation::template run<Baseline>(arguments...);
}
#if defined(__x86_64__)
template <class Operation, class... Arguments>
__attribute__((target("avx2"), flatten)) void run_avx2(Arguments... arguments) {
  Operation::template run<Avx2>(arguments...);
}
#endif

template <class... Arguments>
using Kernel = void (*)(Arguments...);

/// The variant for this processor. Arguments are those of Operation::run, as it declares them.
template <class Operation, class... Arguments>
[[nodiscard]] Kernel<Arguments...> kernel_variant(Instructions instructions = Instructions::best) {
#if defined(__x86_64__)
  if (instructions == Instructions::best && __builtin_cpu_supports("avx2"))
    return run_avx2<Operation, Arguments...>;
#endif
  (void)instructions;
  return run_baseline<Operation, Arguments...>;
}

}  // namespace argil::fem
