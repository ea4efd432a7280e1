#pragma once
// Gauss–Legendre points on [0, 1] and their tensor products, the quadrature of every element kind.

#include <vector>

#include "fem/elements/element_kind.h"

namespace argil::fem {

struct GaussRule {
  std::vector<double> points;   // ascending, in (0, 1)
  std::vector<double> weights;  // summing to 1
};

/// Two or four points: exact for polynomials of degree 3 or 7.
[[nodiscard]] GaussRule gauss_rule(int point_count);

/// A kind with n×n×n Gauss points in [0, 1]³, point (a n + b) n + c at (g_a, g_b, g_c), its shape functions and
/// gradients tabulated from `evaluate`.
[[nodiscard]] ElementKind make_element_kind(std::string_view name, int node_count, int points_per_axis,
                                            decltype(ElementKind::evaluate) evaluate);

}  // namespace argil::fem
