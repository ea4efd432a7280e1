#include "tools/chart/label_layout.h"

#include <array>
#include <cmath>
#include <string_view>

namespace argil::chart {

double text_width(const std::string& utf8, double font_size) {
  double width = 0;
  for (const char c : utf8) {
    if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U) continue;  // continues a letter
    if (std::string_view("iljtf.,:;'|!() ").find(c) != std::string_view::npos)
      width += 0.34;
    else if (std::string_view("mwMW%").find(c) != std::string_view::npos)
      width += 0.88;
    else
      width += c >= 'A' && c <= 'Z' ? 0.68 : 0.6;
  }
  return width * font_size;
}

std::optional<LabelLayout::Place> LabelLayout::place(double x, double y, double width, double height) {
  constexpr double k_gap = 9;
  for (const double distance : {k_gap, 2.2 * k_gap, 4.0 * k_gap, 6.0 * k_gap, 8.5 * k_gap})
    for (const auto& [dx, dy] : {std::array{1.0, 0.0},
                                 {0.7, -0.7},
                                 {0.7, 0.7},
                                 {-1.0, 0.0},
                                 {-0.7, -0.7},
                                 {-0.7, 0.7},
                                 {0.0, -1.0},
                                 {0.0, 1.0}}) {
      Box box{x + distance * dx, y + distance * dy - height / 2, width, height};
      if (dx < 0) box.x -= width;
      if (dx == 0) box.x -= width / 2;
      if (dy < -0.5) box.y -= height / 2;
      if (dy > 0.5) box.y += height / 2;
      bool fits = box.x >= frame_.x && box.y >= frame_.y && box.x + width <= frame_.x + frame_.width &&
                  box.y + height <= frame_.y + frame_.height;
      for (const Box& other : taken_) fits = fits && !box.meets(other);
      if (!fits) continue;
      taken_.push_back(box);
      return Place{box, distance > 2.5 * k_gap};
    }
  return std::nullopt;
}

}  // namespace argil::chart
