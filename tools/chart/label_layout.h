#pragma once
// Where labels of points go so that none covers another, a point, or the frame's edge.

#include <optional>
#include <string>
#include <vector>

namespace argil::chart {

struct Box {
  double x = 0, y = 0, width = 0, height = 0;  // upper left corner
  [[nodiscard]] bool meets(const Box& other) const {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height && other.y < y + height;
  }
};

/// Width of a text in a sans-serif font of this size, by classes of letters: within a tenth for Inter and DejaVu.
[[nodiscard]] double text_width(const std::string& utf8, double font_size);

class LabelLayout {
 public:
  explicit LabelLayout(const Box& frame) : frame_(frame) {}
  void keep_free(const Box& box) { taken_.push_back(box); }

  struct Place {
    Box box;
    bool leader = false;  // far enough from its point to want a line to it
  };
  /// The first place about (x, y), near ones first, where a label of this size fits; it is then taken.
  [[nodiscard]] std::optional<Place> place(double x, double y, double width, double height);

 private:
  Box frame_;
  std::vector<Box> taken_;
};

}  // namespace argil::chart
