#include "tests/samples/references.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace argil::tests {

io::Image shrunk(const io::Image& image, int width) {
  io::Image small;
  small.width = width;
  small.height = std::max(1, image.height * width / image.width);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const int left = x * image.width / small.width, right = (x + 1) * image.width / small.width;
      const int top = y * image.height / small.height, bottom = (y + 1) * image.height / small.height;
      std::array<int, 4> sums{};
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u)
          for (std::size_t c = 0; c < 4; ++c)
            sums[c] += image.rgba[4 * static_cast<std::size_t>(v * image.width + u) + c];
      const int count = (right - left) * (bottom - top);
      for (const int sum : sums) small.rgba.push_back(static_cast<std::uint8_t>((sum + count / 2) / count));
    }
  return small;
}

Difference difference(const io::Image& a, const io::Image& b, int far) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("the pictures differ in size");
  const std::size_t pixels = a.rgba.size() / 4;
  long sum = 0, far_count = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    int largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int off = std::abs(a.rgba[4 * i + c] - b.rgba[4 * i + c]);
      sum += off;
      largest = std::max(largest, off);
    }
    if (largest > far) ++far_count;
  }
  return {static_cast<double>(sum) / static_cast<double>(3 * pixels),
          static_cast<double>(far_count) / static_cast<double>(pixels)};
}

}  // namespace argil::tests
