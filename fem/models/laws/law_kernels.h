#pragma once
// The kernels of one law (hyperelastic_kernels.h); included by one source a law, since they take long to compile.

#include "fem/models/hyperelastic_kernels.h"
#include "fem/models/laws/law.h"
#include "fem/models/shapes/dense_shape.h"
#include "fem/models/shapes/tricubic_shape.h"
#include "fem/models/shapes/trilinear_shape.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {

/// The element's mean dilatation and what follows from it, for B-bar: one for each packet.
struct MeanDilatation {
  Lanes volume, weighted, modulus;  // Σ V, Σ V θ, Σ V κ

  ARGIL_LANES_INLINE void clear() { volume = weighted = modulus = broadcast(0); }
  ARGIL_LANES_INLINE void add(const Lanes& point_volume, const Lanes& dilatation, const Lanes& bulk) {
    volume += point_volume;
    weighted += point_volume * dilatation;
    modulus += point_volume * bulk;
  }
  ARGIL_LANES_INLINE Lanes pressure() const { return modulus * weighted / (volume * volume); }
  ARGIL_LANES_INLINE Lanes energy() const { return 0.5 * pressure() * weighted; }
  /// √(κ̄ / ΣV)
  ARGIL_LANES_INLINE Lanes root() const { return square_root(modulus) / volume; }
};

template <class Law>
struct LawEnergy {
  template <class Shape, class Isa, bool Mean>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Shape shape(*a.kind);
    const std::size_t points = static_cast<std::size_t>(shape.point_count());
    for (std::size_t packet = begin; packet < end; ++packet) {
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      Lanes total = broadcast(0);
      MeanDilatation mean;
      mean.clear();
      at_points(a, packet, shape, [&](std::size_t p, std::size_t index, const LaneMatrix&, const LaneMatrix& f) {
        const PointMaterial m = material(a, packet, p, points);
        LawState state;
        Law::template prepare<Isa>(f, m, state);
        const Lanes volume = load(a.volumes + index);
        Lanes density = Law::density(state, m);
        if constexpr (Mean)
          mean.add(volume, state.dilatation, bulk_modulus(m));
        else
          density += 0.5 * bulk_modulus(m) * (state.dilatation * state.dilatation);
        total += volume * density;
      });
      if constexpr (Mean) total += mean.energy();
      store(a.energies + packet, total);
    }
  }
};

template <class Law, class Isa, class Shape>
ARGIL_LANES_INLINE MeanDilatation mean_dilatation(const PacketArguments& a, std::size_t packet,
                                                  const Shape& shape) {
  MeanDilatation mean;
  mean.clear();
  const std::size_t points = static_cast<std::size_t>(shape.point_count());
  at_points(a, packet, shape, [&](std::size_t p, std::size_t index, const LaneMatrix&, const LaneMatrix& f) {
    const PointMaterial m = material(a, packet, p, points);
    LawState state;
    Law::template prepare<Isa>(f, m, state);
    mean.add(load(a.volumes + index), state.dilatation, bulk_modulus(m));
  });
  return mean;
}

template <class Law>
struct LawForces {
  template <class Shape, class Isa, bool Mean>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Shape shape(*a.kind), stresses(*a.kind);
    const std::size_t points = static_cast<std::size_t>(shape.point_count());
    for (std::size_t packet = begin; packet < end; ++packet) {
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      stresses.clear();
      Lanes mean_pressure = broadcast(0);
      if constexpr (Mean) mean_pressure = mean_dilatation<Law, Isa>(a, packet, shape).pressure();
      at_points(a, packet, shape,
                [&](std::size_t p, std::size_t index, const LaneMatrix& jacobian, const LaneMatrix& f) {
                  const PointMaterial m = material(a, packet, p, points);
                  LawState state;
                  Law::template prepare<Isa>(f, m, state);
                  const Lanes pressure = Mean ? mean_pressure : bulk_modulus(m) * state.dilatation;
                  LaneMatrix stress = Law::stress(state, m, pressure);
                  const Lanes volume = load(a.volumes + index);
                  for (Lanes& x : stress.m) x = -volume * x;
                  stresses.add(static_cast<int>(p), product(stress, transposed(jacobian)));
                });
      stresses.integrate();
      stresses.scatter(packet_slots(a, packet));
    }
  }
};

template <class Law>
struct LawTangent {
  template <class Shape, class Isa, bool Mean>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    constexpr std::size_t k_entries = Mean ? k_mean_entries : k_spectral_entries;
    Shape shape(*a.kind);
    const std::size_t points = static_cast<std::size_t>(shape.point_count());
    for (std::size_t packet = begin; packet < end; ++packet) {
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      MeanDilatation mean;
      if constexpr (Mean) mean = mean_dilatation<Law, Isa>(a, packet, shape);
      at_points(
          a, packet, shape, [&](std::size_t p, std::size_t index, const LaneMatrix& jacobian, const LaneMatrix& f) {
            const PointMaterial m = material(a, packet, p, points);
            LaneSvd svd;
            Isa::svd(f, svd);
            const Lanes bulk = bulk_modulus(m);
            LawSpectrum s =
                Law::spectrum(svd.sigma, m, Mean ? mean.pressure() : bulk * Law::dilatation(svd.sigma, m));
            if constexpr (!Mean) {
              const LaneVector& t = s.slope;
              for (int i = 0; i < 3; ++i) s.stretches.m[i] += bulk * (t.m[i] * t.m[i]);
              s.stretches.m[3] += bulk * (t.m[0] * t.m[1]);
              s.stretches.m[4] += bulk * (t.m[0] * t.m[2]);
              s.stretches.m[5] += bulk * (t.m[1] * t.m[2]);
            }
            if (a.clamp_twist) {
              make_semidefinite(s.stretches);
              for (int i = 0; i < 3; ++i) {
                s.twist.m[i] = larger(s.twist.m[i], broadcast(0));
                s.flip.m[i] = larger(s.flip.m[i], broadcast(0));
              }
            }
            const Lanes volume = load(a.volumes + index);
            FourDoubles* to = a.tangent + index * k_entries;
            for (int i = 0; i < 3; ++i)
              for (int j = 0; j < 3; ++j) {
                store(to + 3 * i + j, svd.u[j].m[i]);
                const Lanes* row = jacobian.m + 3 * i;
                store(to + 9 + 3 * i + j, row[0] * svd.v[j].m[0] + row[1] * svd.v[j].m[1] + row[2] * svd.v[j].m[2]);
              }
            for (int i = 0; i < 6; ++i) store(to + 18 + i, s.stretches.m[i] * volume);
            for (int i = 0; i < 3; ++i) {
              store(to + 24 + i, 0.5 * (s.flip.m[i] + s.twist.m[i]) * volume);
              store(to + 27 + i, 0.5 * (s.flip.m[i] - s.twist.m[i]) * volume);
            }
            if constexpr (Mean)
              for (int i = 0; i < 3; ++i) store(to + 30 + i, mean.root() * volume * s.slope.m[i]);
          });
    }
  }
};

/// dx → K dx; the same for every law.
struct SpectralProduct {
  template <class Shape, class Isa, bool Mean>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    constexpr std::size_t k_entries = Mean ? k_mean_entries : k_spectral_entries;
    Shape shape(*a.kind), stresses(*a.kind);
    const std::size_t points = static_cast<std::size_t>(shape.point_count());
    LaneMatrix strains[Mean ? 8 : 1];
    for (std::size_t packet = begin; packet < end; ++packet) {
      shape.gather(a.x, packet_nodes(a, packet));
      shape.differentiate();
      stresses.clear();
      Lanes dilatation = broadcast(0);
      if constexpr (Mean)
        for (std::size_t p = 0; p < points; ++p) {
          const FourDoubles* t = a.tangent + (packet * points + p) * k_entries;
          strains[p] = strain(shape, static_cast<int>(p), t);
          dilatation +=
              load(t + 30) * strains[p].m[0] + load(t + 31) * strains[p].m[4] + load(t + 32) * strains[p].m[8];
        }
      for (std::size_t p = 0; p < points; ++p) {
        const FourDoubles* t = a.tangent + (packet * points + p) * k_entries;
        if constexpr (!Mean) strains[0] = strain(shape, static_cast<int>(p), t);
        const LaneMatrix& d = strains[Mean ? p : 0];
        const Lanes xy = load(t + 21), xz = load(t + 22), yz = load(t + 23);
        LaneMatrix stress;
        stress.m[0] = load(t + 18) * d.m[0] + xy * d.m[4] + xz * d.m[8];
        stress.m[4] = xy * d.m[0] + load(t + 19) * d.m[4] + yz * d.m[8];
        stress.m[8] = xz * d.m[0] + yz * d.m[4] + load(t + 20) * d.m[8];
        constexpr int k_first[3] = {5, 2, 1}, k_second[3] = {7, 6, 3};
        for (int i = 0; i < 3; ++i) {
          const Lanes own = load(t + 24 + i), other = load(t + 27 + i);
          stress.m[k_first[i]] = own * d.m[k_first[i]] + other * d.m[k_second[i]];
          stress.m[k_second[i]] = own * d.m[k_second[i]] + other * d.m[k_first[i]];
        }
        if constexpr (Mean)
          for (int i = 0; i < 3; ++i) stress.m[4 * i] += load(t + 30 + i) * dilatation;
        stresses.add(static_cast<int>(p), product(product(load_matrix(t), stress), transposed(load_matrix(t + 9))));
      }
      stresses.integrate();
      stresses.scatter(packet_slots(a, packet));
    }
  }

 private:
  /// Uᵀ dF V
  template <class Shape>
  static ARGIL_LANES_INLINE LaneMatrix strain(const Shape& shape, int point, const FourDoubles* t) {
    LaneMatrix gradient;
    shape.gradient(point, gradient);
    return product(product(transposed(load_matrix(t)), gradient), load_matrix(t + 9));
  }
};

/// An operation of kernel_variants.h.
template <class Operation, class Shape, bool Mean>
struct LawOnShape {
  template <class Isa>
  static ARGIL_LANES_INLINE void run(const PacketArguments& a, std::size_t begin, std::size_t end) {
    Operation::template run<Shape, Isa, Mean>(a, begin, end);
  }
};

template <class Operation, class Shape, bool Mean>
PacketKernel choose_kernel(Instructions instructions) {
  return kernel_variant<LawOnShape<Operation, Shape, Mean>, const PacketArguments&, std::size_t, std::size_t>(
      instructions);
}

/// `product` of the shape, for any law.
PacketKernel spectral_product(const ElementKind& kind, bool mean_dilatation, Instructions instructions);

template <class Law>
HyperelasticKernels law_kernels(const ElementKind& kind, bool mean, Instructions isa) {
  HyperelasticKernels k;
  k.product = spectral_product(kind, mean, isa);
  k.entries = mean ? k_mean_entries : k_spectral_entries;
  const auto choose = [&]<class Shape, bool Mean>() {
    k.energy = choose_kernel<LawEnergy<Law>, Shape, Mean>(isa);
    k.forces = choose_kernel<LawForces<Law>, Shape, Mean>(isa);
    k.tangent = choose_kernel<LawTangent<Law>, Shape, Mean>(isa);
  };
  if (mean)
    choose.template operator()<TrilinearShape, true>();
  else if (&kind == &trilinear_hexahedron())
    choose.template operator()<TrilinearShape, false>();
  else if (&kind == &pyramid())
    choose.template operator()<PyramidShape, false>();
  else if (&kind == &bspline_hexahedron())
    choose.template operator()<TricubicShape, false>();
  else
    choose.template operator()<DenseShape, false>();
  return k;
}

HyperelasticKernels corotational_law_kernels(const ElementKind& kind, bool mean, Instructions isa);
HyperelasticKernels stable_neo_hookean_law_kernels(const ElementKind& kind, bool mean, Instructions isa);
HyperelasticKernels st_venant_kirchhoff_law_kernels(const ElementKind& kind, bool mean, Instructions isa);
HyperelasticKernels neo_hookean_law_kernels(const ElementKind& kind, bool mean, Instructions isa);

}  // namespace argil::fem
