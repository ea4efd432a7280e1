#include "tools/studio/picking.h"

#include <Eigen/Geometry>
#include <cmath>

namespace argil::studio {

std::optional<Hit> pick(const sculpt::SceneSurface& surface, const Ray& ray) {
  std::optional<Hit> best;
  double nearest = HUGE_VAL;
  const std::size_t faces = surface.offsets.size() - 1;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t first = surface.offsets[f], size = surface.offsets[f + 1] - first;
    if (size < 3) continue;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < size; ++i) middle += surface.positions[surface.corners[first + i]].cast<double>();
    middle /= static_cast<double>(size);
    // A face that the ray passes by is left out without looking at its triangles.
    const Eigen::Vector3d to_middle = middle - ray.origin;
    const double along = to_middle.dot(ray.direction), off_squared = to_middle.squaredNorm() - along * along;
    double reach_squared = 0;
    for (std::size_t i = 0; i < size; ++i)
      reach_squared = std::max(
          reach_squared, (surface.positions[surface.corners[first + i]].cast<double>() - middle).squaredNorm());
    if (off_squared > reach_squared * (1 + 1e-9) || along < -std::sqrt(reach_squared)) continue;

    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t va = surface.corners[first + i], vb = surface.corners[first + (i + 1) % size];
      const Eigen::Vector3d a = surface.positions[va].cast<double>(), b = surface.positions[vb].cast<double>();
      const Eigen::Vector3d ab = b - a, am = middle - a, normal = ab.cross(am);
      const double facing = -normal.dot(ray.direction);
      if (!(facing > 0)) continue;  // seen from behind, or without area
      const Eigen::Vector3d from = ray.origin - a, turned = from.cross(ray.direction);
      const double distance = from.dot(normal) / facing;
      // Möller and Trumbore's coordinates of where the ray meets the triangle's plane.
      const double across = am.dot(turned) / facing, inwards = -ab.dot(turned) / facing;
      constexpr double k_slack = -1e-12;  // on an edge between two triangles one of them is met
      if (across < k_slack || inwards < k_slack || across + inwards > 1 - k_slack) continue;
      if (!(distance > 0 && distance < nearest)) continue;
      nearest = distance;
      best = Hit{.at = ray.origin + distance * ray.direction,
                 .normal = normal.normalized(),
                 .distance = distance,
                 .face = static_cast<std::uint32_t>(f),
                 .cell = surface.cell_from_face[f],
                 .corners = {va, vb},
                 .across = across,
                 .inwards = inwards,
                 .cut = !surface.cut_faces.empty() && surface.cut_faces[f] != 0};
    }
  }
  return best;
}

double value_at(const sculpt::SceneSurface& surface, const std::vector<float>& values, const Hit& hit) {
  double middle = 0;
  const std::size_t first = surface.offsets[hit.face], size = surface.offsets[hit.face + 1] - first;
  for (std::size_t i = 0; i < size; ++i) middle += static_cast<double>(values[surface.corners[first + i]]);
  middle /= static_cast<double>(size);
  const double a = values[hit.corners[0]], b = values[hit.corners[1]];
  return (1 - hit.across - hit.inwards) * a + hit.across * b + hit.inwards * middle;
}

}  // namespace argil::studio
