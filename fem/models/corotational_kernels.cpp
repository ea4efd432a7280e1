#include "fem/models/corotational_kernels.h"

#include "fem/models/packet_kernel.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

struct Energy {
  template <class Shape, class Isa>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Shape shape(*a.kind);
    const std::size_t points = static_cast<std::size_t>(shape.point_count());
    for (std::size_t packet = begin; packet < end; ++packet) {
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      Lanes total = broadcast(0);
      at_points(a, packet, shape, [&](std::size_t p, std::size_t index, const LaneMatrix&, const LaneMatrix& f) {
        const PointMaterial m = material(a, packet, p, points);
        LaneMatrix rotation;
        nearest_rotation(f, rotation, Isa::svd);
        const Lanes trace = inner(rotation, f) - 3.0;
        Lanes square = broadcast(0);
        for (int i = 0; i < 9; ++i) square += (f.m[i] - rotation.m[i]) * (f.m[i] - rotation.m[i]);
        total += load(a.volumes + index) * (m.mu * square + 0.5 * m.lambda * (trace * trace));
      });
      store(a.energies + packet, total);
    }
  }
};

struct Forces {
  template <class Shape, class Isa>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Shape shape(*a.kind), stresses(*a.kind);
    const std::size_t points = static_cast<std::size_t>(shape.point_count());
    for (std::size_t packet = begin; packet < end; ++packet) {
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      stresses.clear();
      at_points(a, packet, shape,
                [&](std::size_t p, std::size_t index, const LaneMatrix& jacobian, const LaneMatrix& f) {
                  const PointMaterial m = material(a, packet, p, points);
                  LaneMatrix rotation;
                  nearest_rotation(f, rotation, Isa::svd);
                  const Lanes volume = load(a.volumes + index);
                  const Lanes shear = -2.0 * m.mu * volume;
                  const Lanes pressure = -m.lambda * volume * (inner(rotation, f) - 3.0);
                  LaneMatrix stress;
                  for (int i = 0; i < 9; ++i)
                    stress.m[i] = shear * (f.m[i] - rotation.m[i]) + pressure * rotation.m[i];
                  stresses.add(static_cast<int>(p), product(stress, transposed(jacobian)));
                });
      stresses.integrate();
      stresses.scatter(packet_slots(a, packet));
    }
  }
};

struct TangentAtState {
  template <class Shape, class Isa>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Shape shape(*a.kind);
    const std::size_t points = static_cast<std::size_t>(shape.point_count());
    for (std::size_t packet = begin; packet < end; ++packet) {
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      at_points(a, packet, shape, [&](std::size_t p, std::size_t index, const LaneMatrix&, const LaneMatrix& f) {
        const PointMaterial m = material(a, packet, p, points);
        LaneSvd svd;
        Isa::svd(f, svd);
        const LaneMatrix rotation = outer_sum(svd.u, svd.v);
        const Lanes volume = load(a.volumes + index);
        const Lanes k = m.lambda * (sum(svd.sigma) - 3.0) - 2.0 * m.mu;
        LaneVector twist;  // of the twists about v_i, over |w|²; the whole form is 2μ + 2 twist along them
        for (int i = 0; i < 3; ++i) {
          const Lanes pair = svd.sigma.m[(i + 1) % 3] + svd.sigma.m[(i + 2) % 3];
          twist.m[i] = k / larger(pair, broadcast(k_least_pair));
          if (a.clamp_twist) twist.m[i] = larger(twist.m[i], -m.mu);
          twist.m[i] = twist.m[i] * volume;
        }
        const LaneMatrix t = outer_sum(svd.v, svd.v, twist);
        FourDoubles* to = a.tangent + index * k_tangent_entries;
        for (int i = 0; i < 9; ++i) store(to + i, rotation.m[i]);
        constexpr int k_entries[6] = {0, 4, 8, 1, 2, 5};
        for (int i = 0; i < 6; ++i) store(to + 9 + i, t.m[k_entries[i]]);
        store(to + 15, 2.0 * m.mu * volume);
        store(to + 16, m.lambda * volume);
      });
    }
  }
  // σ_j + σ_k of a flat, mirrored element may vanish, where the energy has no second derivative.
  static constexpr double k_least_pair = 1e-6;
};

struct Product {
  template <class Shape, class Isa>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Shape shape(*a.kind), stresses(*a.kind);
    for (std::size_t packet = begin; packet < end; ++packet) {
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      stresses.clear();
      at_points(a, packet, shape,
                [&](std::size_t p, std::size_t index, const LaneMatrix& jacobian, const LaneMatrix& df) {
                  const FourDoubles* t = a.tangent + index * k_tangent_entries;
                  const LaneMatrix rotation = load_matrix(t);
                  const LaneMatrix b = product(transposed(rotation), df);
                  const Lanes wx = b.m[7] - b.m[5], wy = b.m[2] - b.m[6], wz = b.m[3] - b.m[1];
                  const Lanes txy = load(t + 12), txz = load(t + 13), tyz = load(t + 14);
                  const Lanes tx = load(t + 9) * wx + txy * wy + txz * wz;
                  const Lanes ty = txy * wx + load(t + 10) * wy + tyz * wz;
                  const Lanes tz = txz * wx + tyz * wy + load(t + 11) * wz;
                  const Lanes shear = load(t + 15);
                  const Lanes pressure = load(t + 16) * (b.m[0] + b.m[4] + b.m[8]);
                  const LaneMatrix stress = {{shear * b.m[0] + pressure, shear * b.m[1] - tz, shear * b.m[2] + ty,
                                              shear * b.m[3] + tz, shear * b.m[4] + pressure, shear * b.m[5] - tx,
                                              shear * b.m[6] - ty, shear * b.m[7] + tx, shear * b.m[8] + pressure}};
                  stresses.add(static_cast<int>(p), product(product(rotation, stress), transposed(jacobian)));
                });
      stresses.integrate();
      stresses.scatter(packet_slots(a, packet));
    }
  }
};

}  // namespace

CorotationalKernels corotational_kernels(const ElementKind& kind, Instructions instructions) {
  return {packet_kernel<Energy>(kind, instructions), packet_kernel<Forces>(kind, instructions),
          packet_kernel<TangentAtState>(kind, instructions), packet_kernel<Product>(kind, instructions)};
}

}  // namespace argil::fem
