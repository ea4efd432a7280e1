#pragma once
// The rotation nearest to four 3×3 matrices by Newton's iteration R ← (R + R⁻ᵀ)/2 (Higham) where they are far from
// flat, several times faster than lane_svd.h, which takes the others: flat, mirrored, vanishing. Which of the two a
// lane takes, and its bits, do not depend on the other lanes.

#include "fem/models/lane_svd.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

ARGIL_LANES_INLINE void cofactors(const LaneMatrix& a, LaneMatrix& result) {
  const Lanes* m = a.m;
  Lanes* c = result.m;
  c[0] = m[4] * m[8] - m[5] * m[7];
  c[1] = m[5] * m[6] - m[3] * m[8];
  c[2] = m[3] * m[7] - m[4] * m[6];
  c[3] = m[2] * m[7] - m[1] * m[8];
  c[4] = m[0] * m[8] - m[2] * m[6];
  c[5] = m[1] * m[6] - m[0] * m[7];
  c[6] = m[1] * m[5] - m[2] * m[4];
  c[7] = m[2] * m[3] - m[0] * m[5];
  c[8] = m[0] * m[4] - m[1] * m[3];
}

/// `svd(f, result)` is signed_svd, which kernels keep out of line.
template <class Svd>
ARGIL_LANES_INLINE void nearest_rotation(const LaneMatrix& f, LaneMatrix& rotation, const Svd& svd) {
  Lanes square = broadcast(0);
  for (const Lanes& x : f.m) square += x * x;
  LaneMatrix cofactor;
  cofactors(f, cofactor);
  Lanes determinant = f.m[0] * cofactor.m[0] + f.m[1] * cofactor.m[1] + f.m[2] * cofactor.m[2];
  // det F > 0.02 |F|³ (0.19 at a rotation) and no stretch beyond 1e3: at most eight or so iterations without
  // scaling.
  const auto solid = (determinant > 0.0) & (determinant * determinant > 4e-4 * square * square * square) &
                     (square < 1e6) & (square > 1e-3);
  auto going = solid;
  rotation = f;
  for (int iteration = 0; iteration < 16 && (going[0] | going[1] | going[2] | going[3]); ++iteration) {
    const Lanes half_inverse = 0.5 / (going ? determinant : broadcast(1));
    Lanes change = broadcast(0);
    for (int i = 0; i < 9; ++i) {
      const Lanes next = 0.5 * rotation.m[i] + half_inverse * cofactor.m[i];
      const Lanes step = next - rotation.m[i];
      change += step * step;
      rotation.m[i] = going ? next : rotation.m[i];
    }
    going = going & (change > 1e-17);  // quadratic: what is left is of the order of `change`
    cofactors(rotation, cofactor);
    determinant = rotation.m[0] * cofactor.m[0] + rotation.m[1] * cofactor.m[1] + rotation.m[2] * cofactor.m[2];
  }
  if (solid[0] & solid[1] & solid[2] & solid[3]) return;
  LaneSvd factors;
  svd(f, factors);
  const LaneMatrix robust = outer_sum(factors.u, factors.v);
  for (int i = 0; i < 9; ++i) rotation.m[i] = solid ? rotation.m[i] : robust.m[i];
}

#pragma GCC diagnostic pop

}  // namespace argil::fem
