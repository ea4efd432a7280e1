#pragma once
// Four numbers a lane and 3×3 matrices of them, for kernels that treat four elements (or points) at once.
// Everything is inlined into its caller, so that the same source serves the baseline and the AVX2 build of a
// kernel; no fused multiply–add is written anywhere, so that both give the same bits.

#include <cstddef>
#include <cstring>
#if defined(__SSE2__)
#include <emmintrin.h>
#else
#include <cmath>
#endif

#define ARGIL_LANES_INLINE inline __attribute__((always_inline))

namespace argil::fem {

inline constexpr int k_lanes = 4;
using Lanes = double __attribute__((vector_size(32)));

/// Storage of one Lanes in arrays.
struct alignas(32) FourDoubles {
  double values[k_lanes];
};

struct LaneVector {
  Lanes m[3];
};
struct LaneMatrix {  // row by row
  Lanes m[9];
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // never passed by value across a call: all is inlined

ARGIL_LANES_INLINE Lanes broadcast(double x) {
  return Lanes{x, x, x, x};
}
ARGIL_LANES_INLINE Lanes load(const FourDoubles* from) {
  Lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
ARGIL_LANES_INLINE void store(FourDoubles* to, const Lanes& x) {
  std::memcpy(to, &x, sizeof x);
}

ARGIL_LANES_INLINE Lanes square_root(const Lanes& x) {
#if defined(__SSE2__)
  union {
    Lanes whole;
    __m128d half[2];
  } u;
  u.whole = x;
  u.half[0] = _mm_sqrt_pd(u.half[0]);
  u.half[1] = _mm_sqrt_pd(u.half[1]);
  return u.whole;
#else
  return Lanes{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}
ARGIL_LANES_INLINE Lanes absolute(const Lanes& x) {
  return x < 0.0 ? -x : x;
}
ARGIL_LANES_INLINE Lanes larger(const Lanes& x, const Lanes& y) {
  return x > y ? x : y;
}

ARGIL_LANES_INLINE Lanes dot(const LaneVector& a, const LaneVector& b) {
  return a.m[0] * b.m[0] + a.m[1] * b.m[1] + a.m[2] * b.m[2];
}
ARGIL_LANES_INLINE LaneVector cross(const LaneVector& a, const LaneVector& b) {
  return {
      {a.m[1] * b.m[2] - a.m[2] * b.m[1], a.m[2] * b.m[0] - a.m[0] * b.m[2], a.m[0] * b.m[1] - a.m[1] * b.m[0]}};
}
ARGIL_LANES_INLINE LaneVector scaled(const LaneVector& a, const Lanes& s) {
  return {{a.m[0] * s, a.m[1] * s, a.m[2] * s}};
}
/// a + s b
ARGIL_LANES_INLINE LaneVector plus_scaled(const LaneVector& a, const Lanes& s, const LaneVector& b) {
  return {{a.m[0] + s * b.m[0], a.m[1] + s * b.m[1], a.m[2] + s * b.m[2]}};
}

/// a b
ARGIL_LANES_INLINE LaneMatrix product(const LaneMatrix& a, const LaneMatrix& b) {
  const Lanes *x = a.m, *y = b.m;
  return {{x[0] * y[0] + x[1] * y[3] + x[2] * y[6], x[0] * y[1] + x[1] * y[4] + x[2] * y[7],
           x[0] * y[2] + x[1] * y[5] + x[2] * y[8], x[3] * y[0] + x[4] * y[3] + x[5] * y[6],
           x[3] * y[1] + x[4] * y[4] + x[5] * y[7], x[3] * y[2] + x[4] * y[5] + x[5] * y[8],
           x[6] * y[0] + x[7] * y[3] + x[8] * y[6], x[6] * y[1] + x[7] * y[4] + x[8] * y[7],
           x[6] * y[2] + x[7] * y[5] + x[8] * y[8]}};
}
ARGIL_LANES_INLINE LaneMatrix transposed(const LaneMatrix& a) {
  return {{a.m[0], a.m[3], a.m[6], a.m[1], a.m[4], a.m[7], a.m[2], a.m[5], a.m[8]}};
}
ARGIL_LANES_INLINE LaneMatrix load_matrix(const FourDoubles* from) {
  return {{load(from), load(from + 1), load(from + 2), load(from + 3), load(from + 4), load(from + 5),
           load(from + 6), load(from + 7), load(from + 8)}};
}

#pragma GCC diagnostic pop

}  // namespace argil::fem
