#pragma once
// What lies under the pointer: the nearest triangle of the surface as it stands, met exactly.

#include <optional>

#include "sculpt/renderer.h"
#include "tools/studio/orbit_camera.h"

namespace argil::studio {

struct Hit {
  Eigen::Vector3d at;                      // [m], on the surface as it stands
  Eigen::Vector3d normal;                  // outwards, unit
  double distance = 0;                     // from the ray's origin [m]
  std::uint32_t face = 0;                  // of the surface
  std::uint32_t cell = 0;                  // of the finest level
  std::array<std::uint32_t, 2> corners{};  // surface vertices of the edge of the face that is nearest
  double across = 0;                       // 0 on that edge's first end, 1 on its second
  double inwards = 0;                      // 0 on the edge, 1 in the face's middle
  bool cut = false;                        // on a face that a cut laid open
};

/// Faces are fans of triangles about the mean of their corners, as they are drawn. Cost O(faces).
[[nodiscard]] std::optional<Hit> pick(const sculpt::SceneSurface& surface, const Ray& ray);

/// A value of the surface's vertices at a hit, as it is drawn there.
[[nodiscard]] double value_at(const sculpt::SceneSurface& surface, const std::vector<float>& values,
                              const Hit& hit);

}  // namespace argil::studio
