#include "fem/models/laws/neo_hookean_law.h"

#include "fem/models/laws/law_kernels.h"

namespace argil::fem {

HyperelasticKernels neo_hookean_law_kernels(const ElementKind& kind, bool mean, Instructions isa) {
  return law_kernels<NeoHookeanLaw>(kind, mean, isa);
}

}  // namespace argil::fem
