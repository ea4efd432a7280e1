#pragma once
// A session that takes every turn in a second: an edit of each kind, a cell that is no hexahedron, a stroke, undo,
// redo.

#include <string>

namespace argil::tests {

inline std::string small_session() {
  return R"(argil 1
# A step of clay with a peak beneath it: held at its tip and its side, pulled at its top.
new box 2 2 1 size 0.2 0.2 0.1
select faces where z > 0.099 and x < 0.1
extrude 0.1
peak 0.05 where z < 0.001 and x > 0.1 and y > 0.1
levels 1
set young_modulus 2e4
paint young_modulus scale 3 where x > 0.1
pin where z < -0.04
pin where x > 0.199
tool pull radius 0.1 strength 40
stroke from 0.05 0.05 0.2 to 0.1 0.05 0.25 ticks 100
undo
redo
step 3
expect pin_motion 0
)";
}

}  // namespace argil::tests
