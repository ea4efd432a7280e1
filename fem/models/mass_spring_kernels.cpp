#include "fem/models/mass_spring_kernels.h"

#include <array>

#pragma GCC diagnostic ignored "-Wpsabi"

namespace argil::fem {
namespace {

constexpr std::size_t k_first_face = k_edge_springs, k_first_inner = k_edge_springs + k_face_springs;

constexpr int bit(int axis) {
  return 4 >> axis;
}

constexpr std::array<SpringEnds, k_springs> make_ends() {
  std::array<SpringEnds, k_springs> ends{};
  std::size_t next = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int node = 0; node < 8; ++node)
      if (!(node & bit(axis))) ends[next++] = {node, node | bit(axis)};
  for (int axis = 0; axis < 3; ++axis) {
    const int first = bit(axis == 0 ? 1 : 0), second = bit(axis == 2 ? 1 : 2);
    for (int side = 0; side < 2; ++side) {
      const int corner = side ? bit(axis) : 0;
      ends[next++] = {corner, corner | first | second};
      ends[next++] = {corner | second, corner | first};
    }
  }
  for (int node = 0; node < 4; ++node) ends[next++] = {node, 7 - node};
  return ends;
}
constexpr std::array<SpringEnds, k_springs> k_ends = make_ends();

/// How a spring across the cube points along an axis: from its lower to its upper side or back.
constexpr double sign_along(std::size_t spring, int axis) {
  return k_ends[spring].from & bit(axis) ? -1.0 : 1.0;
}

struct LaneSprings {
  Lanes edge, face, inner, own, shared, hourglass;
};

ARGIL_LANES_INLINE LaneSprings lane_springs(const MassSpringOptions& options, const Lanes& mu, const Lanes& lambda,
                                            const Lanes& size) {
  // 4ν − 1 = (λ − μ)/(λ + μ), 4ν + 1 = (3λ + μ)/(λ + μ), 1 − 2ν = μ/(λ + μ); no material: no springs.
  const Lanes sum = lambda + mu, shear = mu * size, bulk = lambda * size;
  const Lanes inverse = sum > 0.0 ? 1.0 / (sum > 0.0 ? sum : broadcast(1)) : broadcast(0);
  const Lanes none = broadcast(0);
  LaneSprings k{none, none, none, none, none, none};
  switch (options.diagonals) {
    case DiagonalSprings::faces:
      k.face = 0.5 * shear;
      k.edge = 0.25 * shear;
      break;
    case DiagonalSprings::inner:
      k.inner = 0.75 * shear;
      k.edge = 0.25 * shear * (3.0 * lambda + mu) * inverse;
      k.own = shear * (mu - lambda) * inverse;
      if (options.hourglass_springs) k.hourglass = shear / 24.0;
      break;
    case DiagonalSprings::both:
      k.face = 0.25 * shear;
      k.inner = k.edge = 0.375 * shear;
      break;
  }
  k.shared = bulk - shear;
  if (options.correction == SpringCorrection::none) {
    k.own = k.shared = none;
  } else if (options.correction == SpringCorrection::printed) {
    const Lanes ratio = options.printed_corrections / 16.0 * (lambda - mu) * inverse;
    const Lanes transmitted = ratio / (1.0 + 4.0 * ratio);
    k.own = -16.0 * transmitted * k.edge;
    k.shared = 4.0 * transmitted * (4.0 * (k.edge + k.inner) / (1.0 - 8.0 * ratio) - k.inner * (4.0 / 3.0));
  }
  return k;
}

/// Mean material over the points of the elements of a packet.
ARGIL_LANES_INLINE LaneSprings packet_springs(const SpringArguments& a, std::size_t packet, Lanes& mu,
                                              Lanes& lambda) {
  const PacketArguments& p = a.packets;
  const auto points = static_cast<std::size_t>(p.kind->point_count);
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    const std::size_t element = packet * k_lanes + lane;
    const std::size_t first = (element < p.element_count ? element : p.element_count - 1) * points;
    double mu_sum = 0, lambda_sum = 0;
    for (std::size_t i = first; i < first + points; ++i) {
      mu_sum += p.mu[i];
      lambda_sum += p.lambda[i];
    }
    mu[lane] = mu_sum / static_cast<double>(points);
    lambda[lane] = lambda_sum / static_cast<double>(points);
  }
  return lane_springs(*a.options, mu, lambda, load(a.sizes + packet));
}

struct Packet {
  LaneVector x[8];
  LaneVector direction[k_springs];  // of length 1, or 0
  Lanes elongation[k_springs];
  Lanes inverse_length[k_springs];
  Lanes tension[k_springs];
};

ARGIL_LANES_INLINE void gather(const double* x, const std::uint32_t* nodes, LaneVector* to) {
  for (int n = 0; n < 8; ++n)
    for (int lane = 0; lane < k_lanes; ++lane)
      for (int axis = 0; axis < 3; ++axis)
        to[n].m[axis][lane] = x[nodes[n * k_lanes + lane] + static_cast<std::uint32_t>(axis)];
}

ARGIL_LANES_INLINE LaneVector minus(const LaneVector& a, const LaneVector& b) {
  return {{a.m[0] - b.m[0], a.m[1] - b.m[1], a.m[2] - b.m[2]}};
}

ARGIL_LANES_INLINE void stretch(Packet& c, const FourDoubles* rest, std::size_t begin, std::size_t end) {
  for (std::size_t s = begin; s < end; ++s) {
    const LaneVector d = minus(c.x[k_ends[s].to], c.x[k_ends[s].from]);
    const Lanes length = square_root(dot(d, d)), rest_length = load(rest + s);
    const Lanes tiny = 1e-12 * rest_length;
    c.inverse_length[s] = length > tiny ? 1.0 / (length > tiny ? length : rest_length) : broadcast(0);
    c.direction[s] = scaled(d, c.inverse_length[s]);
    c.elongation[s] = length - rest_length;
  }
}

ARGIL_LANES_INLINE bool uses_faces(const MassSpringOptions& o) {
  return o.diagonals != DiagonalSprings::inner || o.hourglass_springs;
}
ARGIL_LANES_INLINE bool uses_inner(const MassSpringOptions& o) {
  return o.diagonals != DiagonalSprings::faces;
}
ARGIL_LANES_INLINE bool has_hourglass_springs(const MassSpringOptions& o) {
  return o.diagonals == DiagonalSprings::inner && o.hourglass_springs;
}

/// Calls body(begin, end) for the ranges of springs that these options have.
template <class Body>
ARGIL_LANES_INLINE void spring_ranges(const MassSpringOptions& o, const Body& body) {
  body(std::size_t{0}, uses_faces(o) ? k_first_inner : k_edge_springs);
  if (uses_inner(o)) body(k_first_inner, k_springs);
}

/// Tensions that belong to elongations: ∂Ψ/∂(elongation), Ψ quadratic in them.
ARGIL_LANES_INLINE void tensions(const MassSpringOptions& o, const LaneSprings& k, const Lanes* elongation,
                                 Lanes* tension) {
  Lanes mean[3], sum = broadcast(0);
  for (int axis = 0; axis < 3; ++axis) {
    const Lanes* e = elongation + 4 * axis;
    mean[axis] = 0.25 * (e[0] + e[1] + e[2] + e[3]);
    sum += mean[axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Lanes more = 0.25 * (k.own * mean[axis] + k.shared * sum);
    for (std::size_t e = 4 * axis; e < 4 * axis + 4; ++e) tension[e] = k.edge * elongation[e] + more;
  }
  if (uses_faces(o))
    for (std::size_t s = k_first_face; s < k_first_inner; ++s) tension[s] = k.face * elongation[s];
  if (has_hourglass_springs(o))
    for (std::size_t s = k_first_face; s < k_first_inner; s += 4) {
      const Lanes q = k.hourglass * ((elongation[s + 2] - elongation[s + 3]) - (elongation[s] - elongation[s + 1]));
      tension[s] -= q;
      tension[s + 1] += q;
      tension[s + 2] += q;
      tension[s + 3] -= q;
    }
  if (uses_inner(o))
    for (std::size_t s = k_first_inner; s < k_springs; ++s) tension[s] = k.inner * elongation[s];
}

/// Adds the printed correction to the tensions of the springs alone: in each edge along i, ratio · Σ_{j≠i} F_j.
ARGIL_LANES_INLINE void add_printed(const MassSpringOptions& o, Packet& c, const Lanes& mu, const Lanes& lambda) {
  const Lanes sum = lambda + mu;
  const Lanes ratio =
      sum > 0.0 ? o.printed_corrections / 16.0 * (lambda - mu) / (sum > 0.0 ? sum : broadcast(1)) : broadcast(0);
  Lanes across[3], total = broadcast(0);
  for (int axis = 0; axis < 3; ++axis) {
    LaneVector normal = {{broadcast(0), broadcast(0), broadcast(0)}};
    for (int e = 4 * axis; e < 4 * axis + 4; ++e)
      normal = plus_scaled(
          normal, broadcast(1),
          minus(c.x[k_ends[static_cast<std::size_t>(e)].to], c.x[k_ends[static_cast<std::size_t>(e)].from]));
    const Lanes length = square_root(dot(normal, normal));
    Lanes force = broadcast(0);
    for (std::size_t e = 4 * static_cast<std::size_t>(axis); e < 4 * static_cast<std::size_t>(axis) + 4; ++e)
      force += c.tension[e] * dot(c.direction[e], normal);
    for (std::size_t s = k_first_inner; s < k_springs; ++s)
      force += sign_along(s, axis) * c.tension[s] * dot(c.direction[s], normal);
    across[axis] = length > 0.0 ? force / (length > 0.0 ? length : broadcast(1)) : broadcast(0);
    total += across[axis];
  }
  // What crosses the cube is springs and corrections together: F_i = across_i + 4 ratio Σ_{j≠i} F_j.
  total = total / (1.0 - 8.0 * ratio);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Lanes own = (across[axis] + 4.0 * ratio * total) / (1.0 + 4.0 * ratio);
    for (std::size_t e = 4 * axis; e < 4 * axis + 4; ++e) c.tension[e] += ratio * (total - own);
  }
}

ARGIL_LANES_INLINE void pull(LaneVector* forces, std::size_t spring, const LaneVector& force) {
  LaneVector &from = forces[k_ends[spring].from], &to = forces[k_ends[spring].to];
  for (int axis = 0; axis < 3; ++axis) {
    from.m[axis] += force.m[axis];
    to.m[axis] -= force.m[axis];
  }
}

ARGIL_LANES_INLINE void store_slots(const SpringArguments& a, std::size_t packet, const LaneVector* forces) {
  FourDoubles* slots = a.packets.slots + packet * 24;
  for (int n = 0; n < 8; ++n)
    for (int axis = 0; axis < 3; ++axis) store(slots + 3 * n + axis, forces[n].m[axis]);
}

ARGIL_LANES_INLINE void clear(LaneVector* forces) {
  for (int n = 0; n < 8; ++n) forces[n] = {{broadcast(0), broadcast(0), broadcast(0)}};
}

ARGIL_LANES_INLINE LaneSprings stretched(const SpringArguments& a, std::size_t packet, Packet& c, Lanes& mu,
                                         Lanes& lambda) {
  const FourDoubles* rest = a.rest_lengths + packet * k_springs;
  gather(a.packets.x, a.packets.nodes + packet * 8 * k_lanes, c.x);
  spring_ranges(*a.options, [&](std::size_t begin, std::size_t end) { stretch(c, rest, begin, end); });
  return packet_springs(a, packet, mu, lambda);
}

struct Forces {
  template <class>
  static ARGIL_LANES_INLINE void run(const SpringArguments& a, std::size_t begin, std::size_t end) {
    Packet c;
    LaneVector forces[8];
    for (std::size_t packet = begin; packet < end; ++packet) {
      Lanes mu, lambda;
      LaneSprings k = stretched(a, packet, c, mu, lambda);
      const bool printed = a.options->correction == SpringCorrection::printed;
      if (printed) k.own = k.shared = broadcast(0);
      tensions(*a.options, k, c.elongation, c.tension);
      if (printed) add_printed(*a.options, c, mu, lambda);
      clear(forces);
      spring_ranges(*a.options, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) pull(forces, s, scaled(c.direction[s], c.tension[s]));
      });
      store_slots(a, packet, forces);
    }
  }
};

struct Energy {
  template <class>
  static ARGIL_LANES_INLINE void run(const SpringArguments& a, std::size_t begin, std::size_t end) {
    Packet c;
    for (std::size_t packet = begin; packet < end; ++packet) {
      Lanes mu, lambda, sum = broadcast(0);
      const LaneSprings k = stretched(a, packet, c, mu, lambda);
      tensions(*a.options, k, c.elongation, c.tension);
      spring_ranges(*a.options, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) sum += c.elongation[s] * c.tension[s];
      });
      store(a.packets.energies + packet, 0.5 * sum);
    }
  }
};

struct MakeTangent {
  template <class>
  static ARGIL_LANES_INLINE void run(const SpringArguments& a, std::size_t begin, std::size_t end) {
    Packet c;
    for (std::size_t packet = begin; packet < end; ++packet) {
      Lanes mu, lambda;
      const LaneSprings k = stretched(a, packet, c, mu, lambda);
      tensions(*a.options, k, c.elongation, c.tension);
      FourDoubles* to = a.tangent + packet * k_spring_tangent_entries;
      spring_ranges(*a.options, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) {
          for (std::size_t axis = 0; axis < 3; ++axis) store(to + 4 * s + axis, c.direction[s].m[axis]);
          const Lanes transverse = c.tension[s] * c.inverse_length[s];
          store(to + 4 * s + 3, a.drop_negative ? larger(transverse, broadcast(0)) : transverse);
        }
      });
      to += 4 * k_springs;
      const Lanes constants[6] = {k.edge, k.face, k.inner, k.own, k.shared, k.hourglass};
      for (int i = 0; i < 6; ++i) store(to + i, constants[i]);
    }
  }
};

struct Product {
  template <class>
  static ARGIL_LANES_INLINE void run(const SpringArguments& a, std::size_t begin, std::size_t end) {
    LaneVector x[8], forces[8], along[k_springs], difference[k_springs];
    Lanes elongation[k_springs], tension[k_springs];
    for (std::size_t packet = begin; packet < end; ++packet) {
      const FourDoubles* from = a.tangent + packet * k_spring_tangent_entries;
      gather(a.packets.x, a.packets.nodes + packet * 8 * k_lanes, x);
      spring_ranges(*a.options, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) {
          along[s] = {{load(from + 4 * s), load(from + 4 * s + 1), load(from + 4 * s + 2)}};
          difference[s] = minus(x[k_ends[s].to], x[k_ends[s].from]);
          elongation[s] = dot(along[s], difference[s]);
        }
      });
      const FourDoubles* c = from + 4 * k_springs;
      const LaneSprings k{load(c), load(c + 1), load(c + 2), load(c + 3), load(c + 4), load(c + 5)};
      tensions(*a.options, k, elongation, tension);
      clear(forces);
      spring_ranges(*a.options, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) {
          const Lanes transverse = load(from + 4 * s + 3);
          const LaneVector force =
              plus_scaled(scaled(along[s], tension[s] - transverse * elongation[s]), transverse, difference[s]);
          pull(forces, s, scaled(force, broadcast(-1)));
        }
      });
      store_slots(a, packet, forces);
    }
  }
};

template <class Loop>
auto variant() {
  return kernel_variant<Loop, const SpringArguments&, std::size_t, std::size_t>();
}

}  // namespace

const SpringEnds& spring_ends(std::size_t spring) {
  return k_ends[spring];
}

SpringKernels spring_kernels() {
  return {variant<Forces>(), variant<Energy>(), variant<MakeTangent>(), variant<Product>()};
}

CubeSprings cube_springs(const MassSpringOptions& options, double mu, double lambda, double size) {
  const LaneSprings k = lane_springs(options, broadcast(mu), broadcast(lambda), broadcast(size));
  return {k.edge[0], k.face[0], k.inner[0], k.own[0], k.shared[0], k.hourglass[0]};
}

}  // namespace argil::fem
