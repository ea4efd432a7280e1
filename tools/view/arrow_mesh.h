#pragma once
// Triangles of load arrows: a shaft and a cone whose thickness is a number of pixels, so that every arrow can be
// read.

#include <vector>

#include "tools/view/camera.h"

namespace argil::view {

struct ArrowVertex {
  Eigen::Vector3f position, normal;
};

/// Adds the triangles of one arrow, in picture coordinates. `pixel` is the size of a drawn pixel at distance 1 (the
/// camera's, enlarged for large pictures). An arrow shorter than its cone gets a smaller one; one without length
/// gives nothing.
void add_arrow(std::vector<ArrowVertex>& triangles, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
               const Camera& camera, float pixel);

}  // namespace argil::view
