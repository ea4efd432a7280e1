#pragma once
// The loops of small-strain linear elasticity in fixed axes over packets of four elements, plain and with mean
// dilatation (B-bar, METHODS §3). What counts is the memory that a product reads: the rest geometry of trilinear
// hexahedra and pyramids is computed anew from their eight corners, which neighbours share, instead of being read
// for every point. With A = det(J) J⁻¹ for J = ∂X/∂(u,v,w), w the weight of a point and V = w det(J),
//   V σ(∂u/∂X) J⁻ᵀ = (w²/V) σ(∂u/∂(u,v,w) A) Aᵀ:
// w²/V goes into the moduli, and nothing is divided. Other kinds read J⁻¹ as it is packed, and V takes the place of
// w²/V.

#include "fem/models/corotational_kernels.h"

namespace argil::fem {

/// What a packet keeps: for each point μ and, plain, λ or, with mean dilatation, −2μ/3, both times w²/V or V; then
/// κ̄ / ΣV with κ̄ = Σ V κ / ΣV, with mean dilatation only.
[[nodiscard]] constexpr std::size_t linear_entries(std::size_t points) {
  return 2 * points + 1;
}

/// Of PacketArguments they use `rest` and, at [packet * linear_entries()], `tangent`.
struct LinearKernels {
  PacketKernel moduli;   // mu, lambda → tangent
  PacketKernel product;  // tangent, x = direction → slots
};

/// `mean_dilatation` for trilinear hexahedra only.
[[nodiscard]] LinearKernels linear_kernels(const ElementKind& kind, bool mean_dilatation,
                                           Instructions instructions = Instructions::best);

/// The symmetric 3n×3n matrices of one packet's elements from its moduli, as packet_stiffness() gives them.
void linear_stiffness(const PacketArguments& arguments, bool mean_dilatation, std::size_t packet,
                      FourDoubles* stiffness);

}  // namespace argil::fem
