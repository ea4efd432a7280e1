#pragma once
// Signed singular values of four 3×3 matrices at once by one-sided Jacobi rotations (Hestenes): F = U Σ Vᵀ with
// det U = det V = +1, σ₀ ≥ σ₁ ≥ |σ₂|, so that R = U Vᵀ is the rotation nearest to F, mirrored or flat as it may be.
// A lane that has converged is no longer changed, so its result does not depend on the other three.

#include "fem/models/lanes.h"

namespace argil::fem {

struct LaneSvd {
  LaneVector u[3], v[3];  // columns
  LaneVector sigma;
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// Makes columns p and q of `a` orthogonal, `v` following. Returns whether any lane was rotated.
ARGIL_LANES_INLINE bool orthogonalize(LaneVector& ap, LaneVector& aq, LaneVector& vp, LaneVector& vq) {
  const Lanes alpha = dot(ap, ap), beta = dot(aq, aq), gamma = dot(ap, aq);
  // |cos| ≤ 1e-15; also false for NaN, so that a state that is not finite ends the sweeps.
  const auto rotate = gamma * gamma > 1e-30 * (alpha * beta);
  if (!(rotate[0] | rotate[1] | rotate[2] | rotate[3])) return false;
  const Lanes zero = broadcast(0), one = broadcast(1);
  const Lanes difference = beta - alpha, twice = 2.0 * gamma;
  const Lanes denominator = absolute(difference) + square_root(difference * difference + twice * twice);
  const Lanes tangent = rotate ? (difference < 0.0 ? -twice : twice) / (rotate ? denominator : one) : zero;
  const Lanes cosine = 1.0 / square_root(1.0 + tangent * tangent);
  const Lanes sine = cosine * tangent;
  const LaneVector a = ap, v = vp;
  ap = plus_scaled(scaled(a, cosine), -sine, aq);
  aq = plus_scaled(scaled(aq, cosine), sine, a);
  vp = plus_scaled(scaled(v, cosine), -sine, vq);
  vq = plus_scaled(scaled(vq, cosine), sine, v);
  return true;
}

/// Exchanges the columns where q is the longer, one of them negated so that determinants stay.
ARGIL_LANES_INLINE void order(LaneVector& ap, LaneVector& aq, LaneVector& vp, LaneVector& vq) {
  const auto exchange = dot(ap, ap) < dot(aq, aq);
  for (int i = 0; i < 3; ++i) {
    const Lanes a = ap.m[i], v = vp.m[i];
    ap.m[i] = exchange ? aq.m[i] : a;
    aq.m[i] = exchange ? -a : aq.m[i];
    vp.m[i] = exchange ? vq.m[i] : v;
    vq.m[i] = exchange ? -v : vq.m[i];
  }
}

/// Below 1e-60 a matrix counts as zero (U = V = identity); above 1e60 squares overflow.
ARGIL_LANES_INLINE void signed_svd(const LaneMatrix& f, LaneSvd& result) {
  const Lanes zero = broadcast(0), one = broadcast(1);
  Lanes largest = zero;
  for (const Lanes& entry : f.m) largest = larger(absolute(entry), largest);
  const auto vanishes = largest < 1e-60;
  LaneVector a[3];
  LaneVector* v = result.v;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      a[j].m[i] = vanishes ? zero : f.m[3 * i + j];
      v[j].m[i] = i == j ? one : zero;
    }
  for (int sweep = 0; sweep < 12; ++sweep) {
    bool rotated = orthogonalize(a[0], a[1], v[0], v[1]);
    rotated |= orthogonalize(a[0], a[2], v[0], v[2]);
    rotated |= orthogonalize(a[1], a[2], v[1], v[2]);
    if (!rotated) break;
  }
  order(a[0], a[1], v[0], v[1]);
  order(a[0], a[2], v[0], v[2]);
  order(a[1], a[2], v[1], v[2]);

  LaneVector* u = result.u;
  const Lanes length = square_root(dot(a[0], a[0]));
  const auto point = length <= 0.0;
  const Lanes inverse_length = 1.0 / (point ? one : length);
  for (int i = 0; i < 3; ++i) u[0].m[i] = point ? (i == 0 ? one : zero) : a[0].m[i] * inverse_length;

  // Of the second column what is perpendicular to the first; where nothing is left (rank one), whichever image of
  // v₁ or v₂ is the longer: any is a nearest rotation.
  LaneVector second = plus_scaled(a[1], -dot(u[0], a[1]), u[0]);
  const Lanes left = dot(second, second);
  const auto line = (left <= 1e-32 * (length * length)) | (left < 1e-140);
  const LaneVector from_v1 = plus_scaled(v[1], -dot(u[0], v[1]), u[0]);
  const LaneVector from_v2 = cross(v[2], u[0]);
  const auto prefer_v1 = dot(from_v1, from_v1) >= dot(from_v2, from_v2);
  for (int i = 0; i < 3; ++i) second.m[i] = line ? (prefer_v1 ? from_v1.m[i] : from_v2.m[i]) : second.m[i];
  const Lanes inverse_second = 1.0 / square_root(dot(second, second));
  u[1] = scaled(second, inverse_second);
  u[2] = cross(u[0], u[1]);
  result.sigma = {{length, dot(u[1], a[1]), dot(u[2], a[2])}};
}

/// Σ_j weight_j left_j right_jᵀ
ARGIL_LANES_INLINE LaneMatrix outer_sum(const LaneVector left[3], const LaneVector right[3],
                                        const LaneVector& weights) {
  LaneMatrix result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result.m[3 * i + j] = left[0].m[i] * weights.m[0] * right[0].m[j] +
                            left[1].m[i] * weights.m[1] * right[1].m[j] +
                            left[2].m[i] * weights.m[2] * right[2].m[j];
  return result;
}
ARGIL_LANES_INLINE LaneMatrix outer_sum(const LaneVector left[3], const LaneVector right[3]) {
  LaneMatrix result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result.m[3 * i + j] =
          left[0].m[i] * right[0].m[j] + left[1].m[i] * right[1].m[j] + left[2].m[i] * right[2].m[j];
  return result;
}

#pragma GCC diagnostic pop

}  // namespace argil::fem
