#pragma once
// Force models given by an energy density per quadrature point, on every element kind (METHODS §4), and with mean
// dilatation (B-bar) on trilinear hexahedra (METHODS §3). See hyperelastic_kernels.h for the laws.

#include "fem/models/force_model.h"
#include "fem/models/hyperelastic_kernels.h"

namespace argil::fem {

/// As make_corotational() in what it keeps and reads; `mean_dilatation` for trilinear hexahedra, other kinds are
/// plain. Its cost is that of the corotational kernels for products, 2–4 times that for forces and tangents.
[[nodiscard]] std::unique_ptr<ForceModel> make_hyperelastic(Law law, std::span<const ElementBlock> blocks,
                                                            const Eigen::Matrix3Xd& rest_nodes,
                                                            bool mean_dilatation);

}  // namespace argil::fem
