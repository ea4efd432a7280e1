#pragma once
// Forces, energies and tangents of four cubes of springs side by side (mass_spring.h).

#include <cstddef>

#include "fem/models/corotational_kernels.h"
#include "fem/models/mass_spring.h"

namespace argil::fem {

// Springs in this order: edges (four along each direction), face diagonals, inner diagonals.
inline constexpr std::size_t k_edge_springs = 12, k_face_springs = 12, k_inner_springs = 4, k_springs = 28;
struct SpringEnds {
  int from, to;  // nodes of the trilinear hexahedron
};
[[nodiscard]] const SpringEnds& spring_ends(std::size_t spring);

/// Tangent of one packet: per spring its direction (3) and transverse stiffness; then the six constants of
/// CubeSprings.
inline constexpr std::size_t k_spring_tangent_entries = 4 * k_springs + 6;

struct SpringArguments {
  PacketArguments packets;  // its x, nodes, mu, lambda, slots, energies
  const MassSpringOptions* options = nullptr;
  const FourDoubles* rest_lengths = nullptr;  // [packet * k_springs + spring]
  const FourDoubles* sizes = nullptr;         // [packet]
  FourDoubles* tangent = nullptr;             // [packet * k_spring_tangent_entries]
  bool drop_negative = false;                 // transverse stiffness
};

using SpringKernel = void (*)(const SpringArguments&, std::size_t begin_packet, std::size_t end_packet);
struct SpringKernels {
  SpringKernel forces, energy, tangent;
  SpringKernel product;  // x is the direction
};
/// For the processor that this runs on; the same bits on every one.
[[nodiscard]] SpringKernels spring_kernels();

}  // namespace argil::fem
