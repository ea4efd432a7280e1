#include "fem/models/laws/corotational_law.h"

#include "fem/models/laws/law_kernels.h"

namespace argil::fem {

HyperelasticKernels corotational_law_kernels(const ElementKind& kind, bool mean, Instructions isa) {
  return law_kernels<CorotationalLaw>(kind, mean, isa);
}

}  // namespace argil::fem
