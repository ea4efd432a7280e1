#pragma once
// The loops of models given by an energy density, over packets of four elements. A law splits its density into
// Ψ(F) = W(F) + κ/2 θ(F)², κ = λ + 2μ/3 the bulk modulus and θ a measure of dilatation. Plain elements take θ at
// each point; with mean dilatation (B-bar, METHODS §3) every point takes the element's mean θ̄ = Σ V θ / Σ V, and
// forces and tangent are the exact derivatives of that energy.
//
// Tangents are kept in the frame of F = U Σ Vᵀ, where the Hessian of an isotropic law is a 3×3 block for the
// stretches and, for each pair of axes, an eigenvalue for the twist and one for the flip (Smith, De Goes, Kim 2019,
// "Analytic eigensystems"): projection clamps those and costs next to nothing.

#include "fem/models/corotational_kernels.h"

namespace argil::fem {

/// What a tangent keeps per point, times the point's volume: U (9), J V (9) with J = ∂(u,v,w)/∂X, the stretches'
/// block (xx yy zz xy xz yz), then for the pairs (y,z), (x,z), (x,y) the factor of D_ij and the factor of D_ji in
/// the stress M_ij, D = Uᵀ dF V. With mean dilatation also √(κ̄ / ΣV) ∂θ/∂σ (3).
inline constexpr std::size_t k_spectral_entries = 30;
inline constexpr std::size_t k_mean_entries = 33;

/// In PacketArguments, `clamp_twist` asks for a positive semi-definite Hessian, and `tangent` has the entries
/// above.
struct HyperelasticKernels {
  PacketKernel energy, forces, tangent, product;
  std::size_t entries = k_spectral_entries;
};

enum class Law { corotational, stable_neo_hookean, st_venant_kirchhoff, neo_hookean };

/// `mean_dilatation` for trilinear hexahedra only.
[[nodiscard]] HyperelasticKernels hyperelastic_kernels(Law law, const ElementKind& kind, bool mean_dilatation,
                                                       Instructions instructions = Instructions::best);

/// The symmetric 3n×3n matrices of one packet's elements from its tangent, as packet_stiffness() gives them.
void spectral_stiffness(const PacketArguments& arguments, std::size_t entries, std::size_t packet,
                        FourDoubles* stiffness);

}  // namespace argil::fem
