#pragma once
// MacCracken–Joy (paper 004 §3.1, METHODS §1): Catmull–Clark's rules one dimension up, and Catmull–Clark on the
// skin. With c = centroid of a cell, a = of a face, m = of an edge, bars = means over everything incident:
//   cell c; interior face (c₀ + c₁ + 2a)/4; interior edge (c̄ + 2ā + (n−3)m)/n; interior vertex (c̄ + 3ā + 3m̄ + v)/8;
//   on the skin: face a; edge (v₀ + v₁ + a₀ + a₁)/4; vertex (ā + 2m̄ + (k−3)v)/k.

#include "subdiv/scheme.h"

namespace argil::subdiv {

[[nodiscard]] std::unique_ptr<Scheme> make_maccracken_joy(const Solid& solid, const Incidence& incidence);

}  // namespace argil::subdiv
