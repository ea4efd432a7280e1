#pragma once
// Cubes of springs (papers/001, METHODS §4): 12 edges, face diagonals and inner diagonals of every trilinear
// hexahedron, each pulling with stiffness · (length − rest length) along its present direction, and a correction
// that makes Young's modulus, Poisson's ratio and shear modulus those of the material. Springs of neighbours add.
//
// With η_i the mean elongation of the four edges along direction i of a cube and x its size (the cube root of its
// rest volume), the correction is the energy ½ own Σ η_i² + ½ shared (Σ η_i)². It is linear in spring lengths, so
// that forces act along the edges and momentum is conserved.
//
// The constants are exact for cubes. Other boxes and distorted cells are accepted, and answer with other constants:
// at 2 : 1 : 1 Young's modulus is 3.3 to 3.8 times too large along the box and half of what it should be across it.
// M2 is exact in shear where the sides of the body cannot warp: free sides soften one cube to 0.69 G, 2³ to 0.87 G.

#include <memory>
#include <span>

#include "fem/models/force_model.h"

namespace argil::fem {

enum class DiagonalSprings { faces, inner, both };  // M1, M2, M3 of papers/001, Fig. 4

enum class SpringCorrection {
  none,     // exact at ν = 0.25 only (papers/001, Appendix A)
  energy,   // exact for every ν on uniform strain
  printed,  // F⊥ = −F (4ν − 1)/16 as papers/001 prints it, once at each node: half of what is needed
};

struct MassSpringOptions {
  DiagonalSprings diagonals = DiagonalSprings::faces;
  SpringCorrection correction = SpringCorrection::energy;
  /// M2 alone resists neither of its three modes in which opposite faces shear against each other (torsion is one):
  /// springs between the differences of the face diagonals of opposite faces do, with the energy that a trilinear
  /// continuum has in these modes. They are still under every affine motion. Ignored where faces have diagonals.
  bool hourglass_springs = true;
  double printed_corrections = 1;  // how often F⊥ acts at a node; 2 would be exact
};

/// Constants of one cube [N/m]: energy ½ Σ k (elongation)² over the springs + ½ own Σ η_i² + ½ shared (Σ η_i)²
/// + ½ hourglass Σ q_i², q_i the difference of the differences of face diagonals of the two faces across i.
struct CubeSprings {
  double edge = 0, face = 0, inner = 0;
  double own = 0, shared = 0;
  double hourglass = 0;
};

/// `size` [m] is the edge of the cube, `mu` and `lambda` [Pa] its material; mu = 0 gives no springs. With G = mu:
/// M1: face Gx/2, edge Gx/4, shared (λ − G)x. M2: inner 3Gx/4, edge Gx(4ν + 1)/4 as papers/001 prints it, own
/// Gx(1 − 4ν), shared (λ − G)x; its edges push where ν < −0.25. M3 shares shear out in equal parts between face and
/// inner diagonals: face Gx/4, inner 3Gx/8, edge 3Gx/8, shared (λ − G)x. For `printed` own and shared are those
/// that the printed forces have to first order at rest.
[[nodiscard]] CubeSprings cube_springs(const MassSpringOptions& options, double mu, double lambda, double size);

/// The energy, and for `printed` one that agrees with the forces to first order at rest only: that model has no
/// energy. There the force F_i across a cube is taken along the mean direction of its edges i, springs and
/// corrections together, and F⊥ acts along the edges; the tangent is that of the energy. `blocks` as for
/// make_corotational: they must outlive the model, materials are read at each call (their mean over the points of
/// an element). A spring of no length pulls nowhere. Positive semi-definite tangents leave out the negative
/// transverse stiffness of pressed springs and, in an element that is then still indefinite (ν < 0.2), a part of
/// `shared`.
/// @throws Error (unsupported) naming an element kind other than trilinear hexahedra.
[[nodiscard]] std::unique_ptr<ForceModel> make_mass_spring(std::span<const ElementBlock> blocks,
                                                           const Eigen::Matrix3Xd& rest_nodes,
                                                           const MassSpringOptions& options = {});

}  // namespace argil::fem
