#pragma once
// Force models given by an energy density per quadrature point, on every element kind (METHODS §4), and with mean
// dilatation (B-bar) on trilinear hexahedra (METHODS §3). See hyperelastic_kernels.h for the laws.

#include "fem/models/force_model.h"
#include "fem/models/hyperelastic_kernels.h"

namespace argil::fem {

/// As make_corotational() in what it keeps and reads; `mean_dilatation` for trilinear hexahedra, other kinds are
/// plain. Measured against the plain corotational kernels, it costs 0.6–1.6 times as much for forces, 1–2.7 times
/// for tangents and 1.5–1.8 times for products.
[[nodiscard]] std::unique_ptr<ForceModel> make_hyperelastic(Law law, std::span<const ElementBlock> blocks,
                                                            const Eigen::Matrix3Xd& rest_nodes,
                                                            bool mean_dilatation);

}  // namespace argil::fem
