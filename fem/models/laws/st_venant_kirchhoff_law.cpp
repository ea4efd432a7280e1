#include "fem/models/laws/st_venant_kirchhoff_law.h"

#include "fem/models/laws/law_kernels.h"

namespace argil::fem {

HyperelasticKernels st_venant_kirchhoff_law_kernels(const ElementKind& kind, bool mean, Instructions isa) {
  return law_kernels<StVenantKirchhoffLaw>(kind, mean, isa);
}

}  // namespace argil::fem
