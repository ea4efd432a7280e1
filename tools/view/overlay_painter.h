#pragma once
// What is laid over a scene that has been drawn, with its depth: tints on its surface, the ghost of a body that is
// not there yet, lines and dots. A window changes it often while the scene stays.

#include <array>
#include <memory>
#include <vector>

#include "tools/view/camera.h"
#include "tools/view/colour.h"
#include "tools/view/shape_painter.h"

namespace argil::view {

struct TintedVertex {
  Eigen::Vector3f position, normal;
  Colour tint;
};

/// Places in the coordinates of the scene [m].
struct Overlay {
  struct Lines {
    std::vector<std::array<Eigen::Vector3f, 2>> ends{};
    Colour tint;
    float half_width = 1;  // [pixels]
    bool through = false;  // faintly also behind the surface
  };
  struct Dots {
    std::vector<Eigen::Vector3f> at{};
    Colour tint, ring;
    float radius = 4;  // [pixels]
    bool through = false;
  };
  std::vector<TintedVertex> veil;   // three a triangle, on the surface itself
  std::vector<TintedVertex> ghost;  // three a triangle; only its front shows, faintly also behind the surface
  std::vector<Lines> lines;
  std::vector<Dots> dots;
};

class OverlayPainter {
 public:
  /// `gl` must outlive it, its context being current whenever a function is called.
  explicit OverlayPainter(const Gl& gl);

  /// Takes it to the graphics card; `place` is that of the scene. Cost O(overlay).
  void set(const Overlay& overlay, const Place& place);
  /// Into the bound target, whose depth is that of the scene.
  void paint(const Camera& camera, const Sampling& sampling) const;

 private:
  struct Shapes {
    std::unique_ptr<VertexArray> array;
    Colour tint, ring;
    float size = 1;
    bool through = false;
  };
  void paint_triangles(const VertexArray& triangles, const Camera& camera, float opacity, float forward) const;
  void paint_shapes(const Camera& camera, const Sampling& sampling, bool hidden) const;

  const Gl* gl_;
  Program triangle_program_;
  ShapePainter shapes_;
  VertexArray veil_, ghost_;
  std::vector<Shapes> lines_, dots_;
};

}  // namespace argil::view
