#pragma once
// The loops of the corotational model over packets of four elements, chosen once for element kind and processor.
// They write only what belongs to their packets: forces go to slots, one for each node of each element, which are
// summed node by node afterwards (element_packets.h). Every choice of instructions gives the same bits.

#include <cstddef>
#include <cstdint>

#include "fem/elements/element_kind.h"
#include "fem/models/kernel_variants.h"
#include "fem/models/lanes.h"

namespace argil::fem {

/// What a tangent keeps per point: R (9), the twist matrix T (6: xx yy zz xy xz yz), 2μV, λV.
inline constexpr std::size_t k_tangent_entries = 17;

/// Arrays of one block in packets; a last packet that is not full repeats its last element.
struct PacketArguments {
  const ElementKind* kind = nullptr;
  std::size_t element_count = 0;
  const std::uint32_t* nodes = nullptr;    // [(packet * node_count + node) * 4 + lane], 3 × node
  const FourDoubles* jacobians = nullptr;  // [(packet * point_count + point) * 9 + 3 row + column], ∂u/∂X
  const FourDoubles* volumes = nullptr;    // [packet * point_count + point]
  const double* mu = nullptr;              // as in ElementBlock
  const double* lambda = nullptr;
  const double* x = nullptr;        // 3 × nodes: positions, or directions for `product`
  const double* rest = nullptr;     // 3 × nodes, rest positions: for linear_kernels.h
  bool clamp_twist = false;         // `tangent`: make the Hessian positive semi-definite
  FourDoubles* tangent = nullptr;   // [(packet * point_count + point) * k_tangent_entries]
  FourDoubles* slots = nullptr;     // [(packet * node_count + node) * 3 + axis]
  FourDoubles* energies = nullptr;  // [packet]
};

using PacketKernel = void (*)(const PacketArguments&, std::size_t begin_packet, std::size_t end_packet);

struct CorotationalKernels {
  PacketKernel energy;   // x → energies
  PacketKernel forces;   // x → slots
  PacketKernel tangent;  // x → tangent
  PacketKernel product;  // tangent, x = direction → slots
};

[[nodiscard]] CorotationalKernels corotational_kernels(const ElementKind& kind,
                                                       Instructions instructions = Instructions::best);

/// The symmetric 3n×3n matrices of one packet's elements from its tangent, entry (row, column) at [row * 3n +
/// column]; at most 64 nodes.
void packet_stiffness(const PacketArguments& arguments, std::size_t packet, FourDoubles* stiffness);

}  // namespace argil::fem
