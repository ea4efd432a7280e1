#pragma once
// The invariants of the Green strain E = (FᵀF − I)/2, from which laws about I_C and J take densities that vanish at
// rest without cancellation: I_C − 3 = 2 first, J² − 1 = 2 first + 4 second + 8 third.

#include "fem/models/lane_eigen.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

struct StrainInvariants {
  Lanes first, second, third;  // tr E, ((tr E)² − tr E²)/2, det E
};

ARGIL_LANES_INLINE StrainInvariants strain_invariants(const LaneMatrix& deformation) {
  const Lanes* f = deformation.m;
  LaneSymmetric e;  // xx yy zz xy xz yz
  for (int i = 0; i < 3; ++i) e.m[i] = 0.5 * (f[i] * f[i] + f[3 + i] * f[3 + i] + f[6 + i] * f[6 + i] - 1.0);
  constexpr int k_row[3] = {0, 0, 1}, k_column[3] = {1, 2, 2};
  for (int k = 0; k < 3; ++k) {
    const int i = k_row[k], j = k_column[k];
    e.m[3 + k] = 0.5 * (f[i] * f[j] + f[3 + i] * f[3 + j] + f[6 + i] * f[6 + j]);
  }
  StrainInvariants r;
  r.first = e.m[0] + e.m[1] + e.m[2];
  r.second = (e.m[0] * e.m[1] - e.m[3] * e.m[3]) + (e.m[0] * e.m[2] - e.m[4] * e.m[4]) +
             (e.m[1] * e.m[2] - e.m[5] * e.m[5]);
  r.third = e.m[0] * (e.m[1] * e.m[2] - e.m[5] * e.m[5]) - e.m[3] * (e.m[3] * e.m[2] - e.m[4] * e.m[5]) +
            e.m[4] * (e.m[3] * e.m[5] - e.m[1] * e.m[4]);
  return r;
}

#pragma GCC diagnostic pop

}  // namespace argil::fem
