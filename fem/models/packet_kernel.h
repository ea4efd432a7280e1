#pragma once
// Which loop runs over packets of four elements: chosen once for element kind and processor (kernel_variants.h). An
// operation is a struct with
//   template <class Shape, class Isa> static void run(const PacketArguments&, begin_packet, end_packet).

#include "fem/models/packet_points.h"
#include "fem/models/shapes/dense_shape.h"
#include "fem/models/shapes/tricubic_shape.h"
#include "fem/models/shapes/trilinear_shape.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {

/// An operation of kernel_variants.h.
template <class Operation, class Shape>
struct OnShape {
  template <class Isa>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Operation::template run<Shape, Isa>(a, begin, end);
  }
};

template <class Operation, class Shape>
PacketKernel packet_kernel(Instructions instructions) {
  return kernel_variant<OnShape<Operation, Shape>, const PacketArguments&, std::size_t, std::size_t>(instructions);
}

/// With the shape of this kind.
template <class Operation>
PacketKernel packet_kernel(const ElementKind& kind, Instructions instructions) {
  if (&kind == &trilinear_hexahedron()) return packet_kernel<Operation, TrilinearShape>(instructions);
  if (&kind == &pyramid()) return packet_kernel<Operation, PyramidShape>(instructions);
  if (&kind == &bspline_hexahedron()) return packet_kernel<Operation, TricubicShape>(instructions);
  return packet_kernel<Operation, DenseShape>(instructions);
}

}  // namespace argil::fem

#pragma GCC diagnostic pop
