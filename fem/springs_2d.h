#pragma once
// The rectangle of springs that papers/001 §3.1 begins with (Figs. 1–3): two edge springs along each side, two
// diagonals, and a correction that lets it have any Poisson's ratio. A model to look at and to test, in two
// dimensions; bodies use fem/models/mass_spring.h.
//
//   2 ──k_l── 3     h upwards, l to the right
//   │ ╲   ╱  │k_h
//   │  k_d   │
//   0 ─────── 1

#include <Eigen/Core>
#include <array>

namespace argil::fem {

struct SpringRectangle {
  double length = 1, height = 1;  // [m]
  double young_modulus = 1;       // [N/m]: force per width / strain
  double poisson_ratio = 0.3;     // −1 … 1
  /// How often the printed F⊥ acts at each node: 0 not at all, 1 as printed in words, 2 as the printed Lagrangian
  /// 4 F⊥ (2δ) has it, which makes the constants exact.
  double corrections = 2;
};

/// Stiffnesses [N/m] as papers/001 prints them, k_d = E(l² + h²)/(4lh(1 + ν)), k_i = E(j²(3ν + 2) − i²)/(4lh(1 +
/// ν)). The edges along a side longer than √(3ν + 2) times the other push.
struct RectangleSprings {
  double along_length = 0, along_height = 0, diagonal = 0;
};
/// @throws Error (bad_input) for sides or a modulus that are not positive, ν outside −1 … 1.
[[nodiscard]] RectangleSprings rectangle_springs(const SpringRectangle& rectangle);

/// Rest positions of the four nodes [m], and the forces on them [N] at `x`; springs act along their present
/// directions. F⊥i = i F_i (1 − 3ν)/(8j) comes from the force F_i that stretches the rectangle along side i; it is
/// written as the tension of the edges that it is the same as, F_i being that of the elongations of the edges in
/// plane stress.
using RectangleNodes = Eigen::Matrix<double, 2, 4>;
[[nodiscard]] RectangleNodes rest_nodes(const SpringRectangle& rectangle);
[[nodiscard]] RectangleNodes forces(const SpringRectangle& rectangle, const RectangleNodes& x);

/// The experiments of Figs. 1 and 2, small: Young's modulus and Poisson's ratio when stretched along length and
/// height, and the shear modulus.
struct RectangleConstants {
  double young_along_length = 0, young_along_height = 0;  // [N/m]
  double poisson_along_length = 0, poisson_along_height = 0;
  double shear_modulus = 0;  // [N/m]
};
[[nodiscard]] RectangleConstants measure(const SpringRectangle& rectangle);

}  // namespace argil::fem
