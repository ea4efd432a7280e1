#pragma once
// The soft shadow where the model stands: its footprint seen from above, blurred twice, on the plane of its lowest
// point.

#include "tools/view/camera.h"
#include "tools/view/gl_objects.h"
#include "tools/view/surface_mesh.h"

namespace argil::view {

class GroundShadow {
 public:
  explicit GroundShadow(const Gl& gl);

  /// Draws the footprint; `triangles` of `array` are those of `mesh`. Leaves other targets bound.
  void prepare(const SurfaceMesh& mesh, const VertexArray& array, const IndexRange& triangles);
  /// Draws the ground into what is bound. Nothing if the eye is below it.
  void paint(const Camera& camera, float opacity) const;

 private:
  // What is blurred needs few pixels, and where there is no graphics card each counts.
  static constexpr int k_size = 256, k_close = 128, k_wide = 64;
  /// `half`: blurred along the rows only.
  void blur(const Target& from, const Target& half, const Target& to, float sigma_x, float sigma_y);

  const Gl* gl_;
  Program footprint_program_, blur_program_, shade_program_, ground_program_;
  Target footprint_, half_close_, close_, half_wide_, wide_, shade_;
  VertexArray nothing_;
  Eigen::Vector4f ground_ = Eigen::Vector4f::Ones();  // middle and half size
  float height_ = 0;
};

}  // namespace argil::view
