#include "fem/solvers/stencil_product.h"

#include "fem/parallel.h"

namespace argil::fem {

void multiply(const subdiv::Stencils& stencils, const Eigen::Matrix3Xd& values, Eigen::Matrix3Xd& result) {
  const std::size_t rows = stencils.row_count();
  result.resize(3, static_cast<Eigen::Index>(rows));
  const double* in = values.data();
  double* out = result.data();
  parallel_for(rows, 512, [&](std::size_t i) {
    double x = 0, y = 0, z = 0;
    for (std::size_t e = stencils.offsets[i]; e < stencils.offsets[i + 1]; ++e) {
      const double w = stencils.weights[e];
      const double* v = in + 3 * static_cast<std::size_t>(stencils.columns[e]);
      x += w * v[0];
      y += w * v[1];
      z += w * v[2];
    }
    out[3 * i] = x;
    out[3 * i + 1] = y;
    out[3 * i + 2] = z;
  });
}

}  // namespace argil::fem
