#pragma once
// Symmetric 3×3 matrices of four lanes made positive semi-definite: cyclic Jacobi rotations, negative eigenvalues
// set to zero. A lane that is positive definite already keeps its bits, whatever the other lanes are.

#include "fem/models/lanes.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// Entries xx yy zz xy xz yz.
struct LaneSymmetric {
  Lanes m[6];
};

/// Rotates the plane (p, q) of `a`, full and symmetric, so that a_pq vanishes; columns of v follow.
ARGIL_LANES_INLINE void diagonalize_plane(LaneMatrix& a, LaneMatrix& v, int p, int q) {
  const Lanes one = broadcast(1), zero = broadcast(0);
  const Lanes twice = 2.0 * a.m[3 * p + q], difference = a.m[3 * q + q] - a.m[3 * p + p];
  const Lanes denominator = absolute(difference) + square_root(difference * difference + twice * twice);
  const auto rotate = denominator > 0.0;
  const Lanes tangent = rotate ? (difference < 0.0 ? -twice : twice) / (rotate ? denominator : one) : zero;
  const Lanes cosine = 1.0 / square_root(1.0 + tangent * tangent), sine = cosine * tangent;
  for (int i = 0; i < 3; ++i) {
    const Lanes x = a.m[3 * i + p], y = a.m[3 * i + q];
    a.m[3 * i + p] = cosine * x - sine * y;
    a.m[3 * i + q] = sine * x + cosine * y;
  }
  for (int i = 0; i < 3; ++i) {
    const Lanes x = a.m[3 * p + i], y = a.m[3 * q + i];
    a.m[3 * p + i] = cosine * x - sine * y;
    a.m[3 * q + i] = sine * x + cosine * y;
  }
  for (int i = 0; i < 3; ++i) {
    const Lanes x = v.m[3 * i + p], y = v.m[3 * i + q];
    v.m[3 * i + p] = cosine * x - sine * y;
    v.m[3 * i + q] = sine * x + cosine * y;
  }
}

ARGIL_LANES_INLINE void make_semidefinite(LaneSymmetric& s) {
  const Lanes minor = s.m[0] * s.m[1] - s.m[3] * s.m[3];
  const Lanes determinant =
      s.m[2] * minor - s.m[4] * (s.m[4] * s.m[1] - s.m[3] * s.m[5]) + s.m[5] * (s.m[4] * s.m[3] - s.m[0] * s.m[5]);
  const auto definite = (s.m[0] > 0.0) & (minor > 0.0) & (determinant > 0.0);
  if (definite[0] & definite[1] & definite[2] & definite[3]) return;
  const Lanes one = broadcast(1), zero = broadcast(0);
  LaneMatrix a = {{s.m[0], s.m[3], s.m[4], s.m[3], s.m[1], s.m[5], s.m[4], s.m[5], s.m[2]}};
  LaneMatrix v = {{one, zero, zero, zero, one, zero, zero, zero, one}};
  for (int sweep = 0; sweep < 6; ++sweep) {  // quadratic once small; four reach rounding
    diagonalize_plane(a, v, 0, 1);
    diagonalize_plane(a, v, 0, 2);
    diagonalize_plane(a, v, 1, 2);
  }
  constexpr int k_row[6] = {0, 1, 2, 0, 0, 1}, k_column[6] = {0, 1, 2, 1, 2, 2};
  for (int entry = 0; entry < 6; ++entry) {
    Lanes value = zero;
    for (int k = 0; k < 3; ++k)
      value += larger(a.m[4 * k], zero) * (v.m[3 * k_row[entry] + k] * v.m[3 * k_column[entry] + k]);
    s.m[entry] = definite ? s.m[entry] : value;
  }
}

#pragma GCC diagnostic pop

}  // namespace argil::fem
