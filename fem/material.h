#pragma once
// Isotropic elasticity: Lamé's constants from Young's modulus and Poisson's ratio.

namespace argil::fem {

struct Lame {
  double mu = 0;      // [Pa]
  double lambda = 0;  // [Pa]
};

/// `young_modulus` [Pa] > 0, −1 < `poisson_ratio` < 0.5. @throws Error (bad_input) outside.
[[nodiscard]] Lame lame(double young_modulus, double poisson_ratio);

}  // namespace argil::fem
