#include "fem/models/linear_kernels.h"

#include <cassert>
#include <type_traits>

#include "fem/models/packet_kernel.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

constexpr std::size_t k_most_nodes = 64;

/// det(J) J⁻¹ from J = ∂X/∂(u,v,w), column by column.
ARGIL_LANES_INLINE LaneMatrix adjugate(const LaneMatrix& j) {
  const Lanes* m = j.m;
  return {{m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
           m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
           m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]}};
}

/// The rest geometry at the points of one packet, up to the factor that the moduli have.
template <class Shape>
class RestFromNodes {
 public:
  explicit ARGIL_LANES_INLINE RestFromNodes(const ElementKind& kind) : shape_(kind) {}
  ARGIL_LANES_INLINE void take(const PacketArguments& a, std::size_t packet) {
    shape_.gather(a.rest, packet_nodes(a, packet));
    shape_.differentiate();
  }
  ARGIL_LANES_INLINE LaneMatrix inverse(const PacketArguments&, std::size_t point, std::size_t) const {
    LaneMatrix jacobian;
    shape_.gradient(static_cast<int>(point), jacobian);
    return adjugate(jacobian);
  }
  static ARGIL_LANES_INLINE Lanes factor(const Lanes& volume, double weight) { return (weight * weight) / volume; }

 private:
  Shape shape_;
};

class RestFromMemory {
 public:
  explicit ARGIL_LANES_INLINE RestFromMemory(const ElementKind&) {}
  ARGIL_LANES_INLINE void take(const PacketArguments&, std::size_t) {}
  ARGIL_LANES_INLINE LaneMatrix inverse(const PacketArguments& a, std::size_t, std::size_t index) const {
    return load_matrix(a.jacobians + 9 * index);
  }
  static ARGIL_LANES_INLINE Lanes factor(const Lanes& volume, double) { return volume; }
};

template <class Shape>
constexpr bool k_from_nodes = std::is_base_of_v<TrilinearShape, Shape>;
template <class Shape>
using RestGeometry = std::conditional_t<k_from_nodes<Shape>, RestFromNodes<Shape>, RestFromMemory>;

template <bool Mean>
struct Moduli {
  template <class Shape, class Isa>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    const auto points = static_cast<std::size_t>(a.kind->point_count);
    for (std::size_t packet = begin; packet < end; ++packet) {
      FourDoubles* to = a.tangent + packet * linear_entries(points);
      Lanes bulk = broadcast(0), total = broadcast(0);
      for (std::size_t p = 0; p < points; ++p) {
        const PointMaterial m = material(a, packet, p, points);
        const Lanes volume = load(a.volumes + packet * points + p);
        // Flat pyramids may have no volume, but then no stiffness.
        const Lanes factor = m.mu != 0.0 ? RestGeometry<Shape>::factor(volume, a.kind->weights[p]) : broadcast(0);
        store(to + 2 * p, m.mu * factor);
        store(to + 2 * p + 1, (Mean ? (-2.0 / 3) * m.mu : m.lambda) * factor);
        bulk += volume * (m.lambda + (2.0 / 3) * m.mu);
        total += volume;
      }
      store(to + 2 * points, Mean ? (bulk != 0.0 ? bulk / (total * total) : broadcast(0)) : broadcast(0));
    }
  }
};

/// μ (B + Bᵀ) + pressure I
ARGIL_LANES_INLINE LaneMatrix stress(const LaneMatrix& b, const Lanes& shear, const Lanes& pressure) {
  const Lanes xy = shear * (b.m[1] + b.m[3]), xz = shear * (b.m[2] + b.m[6]), yz = shear * (b.m[5] + b.m[7]);
  const Lanes twice = shear + shear;
  return {
      {twice * b.m[0] + pressure, xy, xz, xy, twice * b.m[4] + pressure, yz, xz, yz, twice * b.m[8] + pressure}};
}
ARGIL_LANES_INLINE Lanes trace(const LaneMatrix& b) {
  return b.m[0] + b.m[4] + b.m[8];
}

template <bool Mean>
struct Product {
  template <class Shape, class Isa>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Shape shape(*a.kind), stresses(*a.kind);
    RestGeometry<Shape> rest(*a.kind);
    const std::size_t points = static_cast<std::size_t>(shape.point_count());
    for (std::size_t packet = begin; packet < end; ++packet) {
      const FourDoubles* moduli = a.tangent + packet * linear_entries(points);
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      stresses.clear();
      rest.take(a, packet);
      Lanes mean_pressure = broadcast(0);
      if constexpr (Mean) {
        for (std::size_t p = 0; p < points; ++p) {
          LaneMatrix gradient;
          shape.gradient(static_cast<int>(p), gradient);
          mean_pressure += a.kind->weights[p] * inner(gradient, transposed(rest.inverse(a, p, 0)));
        }
        mean_pressure = mean_pressure * load(moduli + 2 * points);
      }
#pragma GCC unroll 8
      for (std::size_t p = 0; p < points; ++p) {
        const LaneMatrix inverse = rest.inverse(a, p, packet * points + p);
        LaneMatrix gradient;
        shape.gradient(static_cast<int>(p), gradient);
        const LaneMatrix b = product(gradient, inverse);
        Lanes pressure = load(moduli + 2 * p + 1) * trace(b);
        if constexpr (Mean) pressure += a.kind->weights[p] * mean_pressure;
        stresses.add(static_cast<int>(p), product(stress(b, load(moduli + 2 * p), pressure), transposed(inverse)));
      }
      stresses.integrate();
      stresses.scatter(packet_slots(a, packet));
    }
  }
};

/// The blocks of nodes a ≤ b of one point: μ ((h_a·h_b) I + h_b h_aᵀ) + λ h_a h_bᵀ with h = J⁻ᵀ∇N.
ARGIL_LANES_INLINE void add_point(const LaneVector* h, std::size_t nodes, const Lanes& mu, const Lanes& lambda,
                                  FourDoubles* stiffness) {
  const std::size_t size = 3 * nodes;
  for (std::size_t b = 0; b < nodes; ++b) {
    const LaneVector sheared = scaled(h[b], mu), pressed = scaled(h[b], lambda);
    for (std::size_t a = 0; a <= b; ++a) {
      const Lanes diagonal = dot(h[a], sheared);
      FourDoubles* block = stiffness + 3 * a * size + 3 * b;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          FourDoubles* entry = block + i * size + j;
          Lanes value = load(entry) + (h[a].m[i] * pressed.m[j] + h[a].m[j] * sheared.m[i]);
          if (i == j) value += diagonal;
          store(entry, value);
        }
    }
  }
}

struct StiffnessArguments {
  const PacketArguments* packets;
  bool mean, from_nodes;
  std::size_t packet;
  FourDoubles* stiffness;
};

ARGIL_LANES_INLINE void fill_stiffness(const StiffnessArguments& s) {
  const PacketArguments& a = *s.packets;
  const auto nodes = static_cast<std::size_t>(a.kind->node_count), size = 3 * nodes;
  const auto points = static_cast<std::size_t>(a.kind->point_count);
  const FourDoubles* moduli = a.tangent + s.packet * linear_entries(points);
  LaneVector h[k_most_nodes], mean_slopes[k_most_nodes];
  for (std::size_t n = 0; n < nodes; ++n) mean_slopes[n] = {{broadcast(0), broadcast(0), broadcast(0)}};
  for (std::size_t i = 0; i < size * size; ++i) store(s.stiffness + i, broadcast(0));
  for (std::size_t p = 0; p < points; ++p) {
    const std::size_t index = s.packet * points + p;
    const LaneMatrix inverse = load_matrix(a.jacobians + 9 * index);
    const Lanes volume = load(a.volumes + index);
    const Lanes determinant = volume / a.kind->weights[p];
    const Lanes unfactored = s.from_nodes ? determinant * determinant : broadcast(1);
    for (std::size_t n = 0; n < nodes; ++n) {
      const double* g = a.kind->gradients.data() + 3 * (nodes * p + n);
      for (int i = 0; i < 3; ++i)
        h[n].m[i] = inverse.m[i] * g[0] + inverse.m[3 + i] * g[1] + inverse.m[6 + i] * g[2];
      mean_slopes[n] = plus_scaled(mean_slopes[n], volume, h[n]);
    }
    add_point(h, nodes, unfactored * load(moduli + 2 * p), unfactored * load(moduli + 2 * p + 1), s.stiffness);
  }
  if (s.mean) add_point(mean_slopes, nodes, broadcast(0), load(moduli + 2 * points), s.stiffness);
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

LinearKernels linear_kernels(const ElementKind& kind, bool mean, Instructions instructions) {
  assert(!mean || &kind == &trilinear_hexahedron());
  if (mean)
    return {packet_kernel<Moduli<true>, TrilinearShape>(instructions),
            packet_kernel<Product<true>, TrilinearShape>(instructions)};
  return {packet_kernel<Moduli<false>>(kind, instructions), packet_kernel<Product<false>>(kind, instructions)};
}

void linear_stiffness(const PacketArguments& arguments, bool mean_dilatation, std::size_t packet,
                      FourDoubles* stiffness) {
  assert(static_cast<std::size_t>(arguments.kind->node_count) <= k_most_nodes);
  static const auto chosen = kernel_variant<FillStiffness, const StiffnessArguments&>();
  const bool from_nodes = arguments.kind == &trilinear_hexahedron() || arguments.kind == &pyramid();
  chosen({&arguments, mean_dilatation, from_nodes, packet, stiffness});
}

}  // namespace argil::fem
