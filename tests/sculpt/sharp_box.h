#pragma once
// Lines that make a box whose edges and corners stay sharp, for tests that count on its volume and its faces.

#include <string>
#include <vector>

namespace argil::sculpt {

inline std::vector<std::string> sharp_box(const std::string& cells_and_size, const std::vector<std::string>& more) {
  std::vector<std::string> lines{"new box " + cells_and_size,
                                 "select edges angle 30",
                                 "sharpen",
                                 "select vertices where valence = 3",
                                 "sharpen",
                                 "levels 1",
                                 "set young_modulus 1e5"};
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

/// A block of 4 kg, 0.2 m wide and 0.1 m high, its lower side at z = 0, its middle above (0.1, 0.1).
inline std::vector<std::string> heavy_block(const std::vector<std::string>& more = {}) {
  std::vector<std::string> lines = sharp_box("2 2 1 size 0.2 0.2 0.1", {"set density 1000"});
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

}  // namespace argil::sculpt
