#pragma once
// Lines, marks and arrows of a thickness in pixels, drawn into what is bound. Depth test and blending are the
// caller's.

#include <climits>
#include <vector>

#include "tools/view/camera.h"
#include "tools/view/colour.h"
#include "tools/view/gl_objects.h"

namespace argil::view {

/// How fine the picture is drawn.
struct Sampling {
  int width = 0, height = 0;  // of the picture [pixels]
  int factor = 1;             // samples a pixel along each axis
  float pixel = 1;            // lines and marks are as many pixels wide as at 1280 x 800 times this
  bool hurried = false;       // for a moment, as while the view turns: what hardly shows may be left out
};

/// Shorter lines fade, so that a fine mesh does not cover what it lies on. Lengths and widths in pixels.
struct LineStyle {
  Colour tint;
  float half_width = 0.55F;
  float full_length = 8, faded_length = 0.07F * full_length;
  float left_far = 0.35F;  // of the opacity, at the farthest place of the scene
};

struct MarkStyle {
  enum class Shape { disc, triangle };
  Shape shape = Shape::disc;
  float radius = 4;  // [pixels]
  Colour tint, ring;
  float opacity = 1;
  float forward = 0.015F;  // towards the eye, so that it lies before the surface
};

class ShapePainter {
 public:
  /// `gl` must outlive it, its context being current whenever a function is called.
  explicit ShapePainter(const Gl& gl);

  /// Of k_line_attributes, one record a line.
  void lines(const VertexArray& lines, const Camera& camera, const Sampling& sampling, const LineStyle& style,
             GLsizei most = INT_MAX) const;
  /// Of k_place_attributes, one record a mark.
  void marks(const VertexArray& marks, const Camera& camera, const Sampling& sampling,
             const MarkStyle& style) const;
  /// In picture coordinates; what of them lies behind the surface shows faintly (`hidden` of the tint's opacity).
  /// Sets depth test, culling and depth mask; the mask is off afterwards.
  void arrows(const std::vector<sculpt::SceneArrow>& arrows, const Camera& camera, const Sampling& sampling,
              const Colour& tint, const Colour& outline, float hidden) const;

 private:
  /// Takes a program; returns samples a pixel of the theme.
  float use(const Program& program, const Camera& camera, const Sampling& sampling) const;

  const Gl* gl_;
  Program line_program_, mark_program_, arrow_program_;
  mutable VertexArray arrows_;  // their thickness depends on the camera
};

}  // namespace argil::view
