#include "fem/models/hyperelastic_kernels.h"

#include <cassert>

#include "fem/models/laws/law_kernels.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

constexpr int k_most_nodes = 64;

/// In the frame U, with h = (J V)ᵀ∇N, the block of nodes a, b is, for i = j, A_ii h_i h_i + Σ_k s_ik h_k h_k, and
/// for i ≠ j, A_ij ha_i hb_j + r_ij ha_j hb_i.
ARGIL_LANES_INLINE void add_point(const double* gradients, std::size_t nodes, const FourDoubles* t, bool mean,
                                  LaneVector* h, LaneVector* mean_slopes, FourDoubles* stiffness) {
  const LaneMatrix u = load_matrix(t), b = load_matrix(t + 9), u_transposed = transposed(u);
  constexpr int k_block[9] = {0, 3, 4, 3, 1, 5, 4, 5, 2};  // of (i, j) among the six
  LaneMatrix block_factor, own, other;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      block_factor.m[3 * i + j] = load(t + 18 + k_block[3 * i + j]);
      own.m[3 * i + j] = i == j ? broadcast(0) : load(t + 24 + (3 - i - j));
      other.m[3 * i + j] = i == j ? broadcast(0) : load(t + 27 + (3 - i - j));
    }
  for (std::size_t n = 0; n < nodes; ++n) {
    const double* g = gradients + 3 * n;
    for (int i = 0; i < 3; ++i) h[n].m[i] = b.m[i] * g[0] + b.m[3 + i] * g[1] + b.m[6 + i] * g[2];
    if (!mean) continue;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) mean_slopes[n].m[i] += u.m[3 * i + k] * (load(t + 30 + k) * h[n].m[k]);
  }
  const std::size_t size = 3 * nodes;
  for (std::size_t col = 0; col < nodes; ++col) {
    const LaneVector& hb = h[col];
    for (std::size_t row = 0; row <= col; ++row) {
      const LaneVector& ha = h[row];
      LaneMatrix local;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          Lanes value = block_factor.m[3 * i + j] * (ha.m[i] * hb.m[j]);
          if (i != j) value += other.m[3 * i + j] * (ha.m[j] * hb.m[i]);
          if (i == j)
            for (int k = 0; k < 3; ++k)
              if (k != i) value += own.m[3 * i + k] * (ha.m[k] * hb.m[k]);
          local.m[3 * i + j] = value;
        }
      const LaneMatrix world = product(product(u, local), u_transposed);
      FourDoubles* block = stiffness + 3 * row * size + 3 * col;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          store(block + i * size + j, load(block + i * size + j) + world.m[3 * i + j]);
    }
  }
}

struct StiffnessArguments {
  const PacketArguments* packets;
  std::size_t entries, packet;
  FourDoubles* stiffness;
};

ARGIL_LANES_INLINE void fill_stiffness(const StiffnessArguments& s) {
  const PacketArguments& a = *s.packets;
  const auto nodes = static_cast<std::size_t>(a.kind->node_count), size = 3 * nodes;
  const auto points = static_cast<std::size_t>(a.kind->point_count);
  const bool mean = s.entries == k_mean_entries;
  LaneVector h[k_most_nodes], mean_slopes[k_most_nodes];
  for (std::size_t n = 0; n < nodes; ++n)
    for (Lanes& x : mean_slopes[n].m) x = broadcast(0);
  for (std::size_t i = 0; i < size * size; ++i) store(s.stiffness + i, broadcast(0));
  for (std::size_t p = 0; p < points; ++p)
    add_point(a.kind->gradients.data() + 3 * nodes * p, nodes, a.tangent + s.entries * (s.packet * points + p),
              mean, h, mean_slopes, s.stiffness);
  if (mean)
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = i / 3 * 3; j < size; ++j) {
        FourDoubles* entry = s.stiffness + i * size + j;
        store(entry, load(entry) + mean_slopes[i / 3].m[i % 3] * mean_slopes[j / 3].m[j % 3]);
      }
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < i; ++j) store(s.stiffness + i * size + j, load(s.stiffness + j * size + i));
}

struct FillStiffness {
  template <class>
  static ARGIL_LANES_INLINE void run(const StiffnessArguments& s) {
    fill_stiffness(s);
  }
};

}  // namespace

void spectral_stiffness(const PacketArguments& arguments, std::size_t entries, std::size_t packet,
                        FourDoubles* stiffness) {
  assert(arguments.kind->node_count <= k_most_nodes);
  static const auto chosen = kernel_variant<FillStiffness, const StiffnessArguments&>();
  chosen({&arguments, entries, packet, stiffness});
}

PacketKernel spectral_product(const ElementKind& kind, bool mean, Instructions isa) {
  if (mean) return choose_kernel<SpectralProduct, TrilinearShape, true>(isa);
  if (&kind == &trilinear_hexahedron()) return choose_kernel<SpectralProduct, TrilinearShape, false>(isa);
  if (&kind == &pyramid()) return choose_kernel<SpectralProduct, PyramidShape, false>(isa);
  if (&kind == &bspline_hexahedron()) return choose_kernel<SpectralProduct, TricubicShape, false>(isa);
  return choose_kernel<SpectralProduct, DenseShape, false>(isa);
}

HyperelasticKernels hyperelastic_kernels(Law law, const ElementKind& kind, bool mean, Instructions isa) {
  assert(!mean || &kind == &trilinear_hexahedron());
  switch (law) {
    case Law::corotational:
      return corotational_law_kernels(kind, mean, isa);
    case Law::stable_neo_hookean:
      return stable_neo_hookean_law_kernels(kind, mean, isa);
    case Law::st_venant_kirchhoff:
      return st_venant_kirchhoff_law_kernels(kind, mean, isa);
    case Law::neo_hookean:
      return neo_hookean_law_kernels(kind, mean, isa);
  }
  return {};
}

}  // namespace argil::fem
