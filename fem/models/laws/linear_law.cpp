#include "fem/models/laws/linear_law.h"

#include "fem/models/laws/law_kernels.h"

namespace argil::fem {

HyperelasticKernels linear_law_kernels(const ElementKind& kind, bool mean, Instructions isa) {
  return law_kernels<LinearLaw>(kind, mean, isa);
}

}  // namespace argil::fem
