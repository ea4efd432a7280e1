#pragma once
// The edges of cells on a surface. Short ones fade, and of a fine mesh most are not to be seen: those are not
// drawn.

#include <vector>

#include "tools/view/shape_painter.h"

namespace argil::view {

class Wires {
 public:
  explicit Wires(const Gl& gl) : lines_(gl) {}

  /// `positions`: of the surface's vertices in picture coordinates. Cost O(n log n).
  void load(const sculpt::SceneSurface& surface, const std::vector<Eigen::Vector3f>& positions);
  /// The surface loaded, its vertices being elsewhere. Cost O(n).
  void move(const sculpt::SceneSurface& surface, const std::vector<Eigen::Vector3f>& positions);
  void draw(const ShapePainter& painter, const Camera& camera, const Sampling& sampling, const Colour& tint) const;

 private:
  /// How many may show at all.
  GLsizei visible(const Camera& camera, const Sampling& sampling, float opacity) const;

  VertexArray lines_;
  std::vector<std::uint32_t> order_;  // of the surface's wire: the longest first, when it was loaded
  std::vector<float> lengths_;        // in that order
};

}  // namespace argil::view
