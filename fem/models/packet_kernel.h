#pragma once
// Which loop runs over packets of four elements: chosen once for element kind and processor. An operation is a
// struct with
//   template <class Shape, class Isa> static void run(const PacketArguments&, begin_packet, end_packet),
// compiled for the baseline and for AVX2, which give the same bits.

#include "fem/models/packet_points.h"
#include "fem/models/shapes/dense_shape.h"
#include "fem/models/shapes/tricubic_shape.h"
#include "fem/models/shapes/trilinear_shape.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {

template <class Operation, class Shape>
__attribute__((flatten)) void run_packets_baseline(const PacketArguments& a, std::size_t begin, std::size_t end) {
  Operation::template run<Shape, Baseline>(a, begin, end);
}
#if defined(__x86_64__)
template <class Operation, class Shape>
__attribute__((target("avx2"), flatten)) void run_packets_avx2(const PacketArguments& a, std::size_t begin,
                                                               std::size_t end) {
  Operation::template run<Shape, Avx2>(a, begin, end);
}
#endif

template <class Operation, class Shape>
PacketKernel packet_kernel(Instructions instructions) {
#if defined(__x86_64__)
  if (instructions == Instructions::best && __builtin_cpu_supports("avx2"))
    return run_packets_avx2<Operation, Shape>;
#endif
  (void)instructions;
  return run_packets_baseline<Operation, Shape>;
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
