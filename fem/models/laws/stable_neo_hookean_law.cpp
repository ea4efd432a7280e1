#include "fem/models/laws/stable_neo_hookean_law.h"

#include "fem/models/laws/law_kernels.h"

namespace argil::fem {

HyperelasticKernels stable_neo_hookean_law_kernels(const ElementKind& kind, bool mean, Instructions isa) {
  return law_kernels<StableNeoHookeanLaw>(kind, mean, isa);
}

}  // namespace argil::fem
