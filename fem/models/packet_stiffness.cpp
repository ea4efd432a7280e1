#include "fem/models/corotational_kernels.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

/// With h = R Jᵀ∇N and T' = R T Rᵀ the block of nodes a, b is
/// 2μ (h_a·h_b) I + λ h_a h_bᵀ + [h_a]×ᵀ T' [h_b]×.
ARGIL_LANES_INLINE void add_point(const double* gradients, std::size_t nodes, const LaneMatrix& jacobian,
                                  const FourDoubles* tangent, LaneVector* h, FourDoubles* stiffness) {
  const LaneMatrix rotation = load_matrix(tangent);
  const Lanes xx = load(tangent + 9), yy = load(tangent + 10), zz = load(tangent + 11), xy = load(tangent + 12),
              xz = load(tangent + 13), yz = load(tangent + 14), shear = load(tangent + 15),
              pressure = load(tangent + 16);
  const LaneMatrix twist = product(product(rotation, {{xx, xy, xz, xy, yy, yz, xz, yz, zz}}), transposed(rotation));
  const LaneMatrix to_world = product(rotation, transposed(jacobian));
  for (std::size_t n = 0; n < nodes; ++n) {
    const double* g = gradients + 3 * n;
    for (int i = 0; i < 3; ++i)
      h[n].m[i] = to_world.m[3 * i] * g[0] + to_world.m[3 * i + 1] * g[1] + to_world.m[3 * i + 2] * g[2];
  }
  const std::size_t size = 3 * nodes;
  for (std::size_t b = 0; b < nodes; ++b) {
    const LaneVector& hb = h[b];
    // Columns of T' [h_b]×: T' times the columns (0, z, −y), (−z, 0, x), (y, −x, 0).
    LaneVector columns[3];
    for (int i = 0; i < 3; ++i) {
      const Lanes* t = twist.m + 3 * i;
      columns[0].m[i] = t[1] * hb.m[2] - t[2] * hb.m[1];
      columns[1].m[i] = t[2] * hb.m[0] - t[0] * hb.m[2];
      columns[2].m[i] = t[0] * hb.m[1] - t[1] * hb.m[0];
    }
    const LaneVector pressed = scaled(hb, pressure), sheared = scaled(hb, shear);
    for (std::size_t a = 0; a <= b; ++a) {
      const LaneVector& ha = h[a];
      const Lanes diagonal = dot(ha, sheared);
      FourDoubles* block = stiffness + 3 * a * size + 3 * b;
      for (int j = 0; j < 3; ++j) {
        const LaneVector turned = cross(columns[j], ha);  // [h_a]×ᵀ column = column × h_a
        for (int i = 0; i < 3; ++i) {
          FourDoubles* entry = block + static_cast<std::size_t>(i) * size + j;
          Lanes value = load(entry) + (ha.m[i] * pressed.m[j] + turned.m[i]);
          if (i == j) value += diagonal;
          store(entry, value);
        }
      }
    }
  }
}

ARGIL_LANES_INLINE void fill_stiffness(const PacketArguments& a, std::size_t packet, FourDoubles* stiffness,
                                       LaneVector* h) {
  const auto nodes = static_cast<std::size_t>(a.kind->node_count), size = 3 * nodes;
  const auto points = static_cast<std::size_t>(a.kind->point_count);
  for (std::size_t i = 0; i < size * size; ++i) store(stiffness + i, broadcast(0));
  for (std::size_t p = 0; p < points; ++p) {
    const std::size_t index = packet * points + p;
    add_point(a.kind->gradients.data() + 3 * nodes * p, nodes, load_matrix(a.jacobians + 9 * index),
              a.tangent + k_tangent_entries * index, h, stiffness);
  }
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < i; ++j) store(stiffness + i * size + j, load(stiffness + j * size + i));
}

struct FillStiffness {
  template <class>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t packet, FourDoubles* stiffness,
                                     LaneVector* h) {
    fill_stiffness(a, packet, stiffness, h);
  }
};

}  // namespace

void packet_stiffness(const PacketArguments& arguments, std::size_t packet, FourDoubles* stiffness) {
  LaneVector h[64];
  static const auto chosen =
      kernel_variant<FillStiffness, const PacketArguments&, std::size_t, FourDoubles*, LaneVector*>();
  chosen(arguments, packet, stiffness, h);
}

}  // namespace argil::fem
