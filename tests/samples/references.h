#pragma once
// What the samples are compared with: samples/references/<name>.json and small pictures in
// samples/references/<name>/. ARGIL_UPDATE_REFERENCES=1 in the environment writes them anew; look at them before
// committing.

#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/image.h"

namespace argil::tests {

inline bool updating_references() {
  const char* const wish = std::getenv("ARGIL_UPDATE_REFERENCES");
  return wish != nullptr && std::string(wish) == "1";
}

inline std::filesystem::path reference(const std::string& name) {
  return std::filesystem::path(ARGIL_SAMPLES_DIR) / "references" / name;
}

/// A picture made `width` wide: each pixel is the mean of those that it covers.
io::Image shrunk(const io::Image& image, int width = 160);

struct Difference {
  double mean = 0;       // of |a − b| over pixels and colours, of 255
  double far_share = 0;  // of pixels that are off by more than `far` in a colour
};
/// Of two pictures of the same size.
Difference difference(const io::Image& a, const io::Image& b, int far);

}  // namespace argil::tests
