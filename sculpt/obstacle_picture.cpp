#include "sculpt/obstacle_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sculpt/obstacles.h"

namespace argil::sculpt {

namespace {

constexpr int k_around = 64, k_along = 32;  // parts of a turn, and from pole to pole
constexpr float k_patch = 2.5F,
                k_whole = 0.35F;  // radius of a plane over that of the body; where it begins to fade

/// Collects a surface in the obstacle's own frame.
class Mesh {
 public:
  explicit Mesh(const fem::ObstaclePose& pose) : pose_(pose) {}

  std::uint32_t vertex(const Eigen::Vector3d& own, float opacity = 1) {
    surface_.positions.push_back(pose_.world(own).cast<float>());
    surface_.values.push_back(opacity);
    return static_cast<std::uint32_t>(surface_.positions.size() - 1);
  }
  void face(std::initializer_list<std::uint32_t> corners) {
    surface_.corners.insert(surface_.corners.end(), corners);
    surface_.offsets.push_back(surface_.corners.size());
    surface_.cell_from_face.push_back(0);
  }
  SceneSurface take() { return std::move(surface_); }

 private:
  fem::ObstaclePose pose_;
  SceneSurface surface_;
};

/// Rings of k_around vertices joined to each other, the first and last closed by a pole.
void add_rings(Mesh& mesh, const std::vector<std::array<double, 2>>& radius_and_height) {
  std::vector<std::uint32_t> last;
  const std::size_t rings = radius_and_height.size();
  for (std::size_t r = 0; r < rings; ++r) {
    const auto [radius, height] = radius_and_height[r];
    std::vector<std::uint32_t> ring;
    const bool pole = r == 0 || r + 1 == rings;
    for (int i = 0; i < (pole ? 1 : k_around); ++i) {
      const double angle = 2 * M_PI * i / k_around;
      ring.push_back(mesh.vertex({radius * std::cos(angle), radius * std::sin(angle), height}));
    }
    if (!last.empty())
      for (std::size_t i = 0; i < k_around; ++i) {
        const std::size_t j = (i + 1) % k_around;
        if (last.size() == 1)
          mesh.face({last[0], ring[j], ring[i]});
        else if (ring.size() == 1)
          mesh.face({last[i], last[j], ring[0]});
        else
          mesh.face({last[i], last[j], ring[j], ring[i]});
      }
    last = std::move(ring);
  }
}

/// From the lower pole up; `half` is half the length of a capsule's axis.
void add_round(Mesh& mesh, double radius, double half) {
  std::vector<std::array<double, 2>> rings;
  for (int i = 0; i <= k_along; ++i) {
    const double angle = M_PI * i / k_along;
    const double height = -radius * std::cos(angle);
    if (2 * i == k_along && half > 0) rings.push_back({radius, -half});
    rings.push_back({radius * std::sin(angle), height + (2 * i < k_along ? -half : half)});
  }
  add_rings(mesh, rings);
}

void add_box(Mesh& mesh, const Eigen::Vector3d& half) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      // Vertices of their own for each face, so that its normals are its own.
      std::array<std::uint32_t, 4> v{};
      for (std::size_t c = 0; c < 4; ++c) {
        Eigen::Vector3d at;
        at[axis] = side * half[axis];
        at[(axis + 1) % 3] = (c == 1 || c == 2 ? 1 : -1) * half[(axis + 1) % 3];
        at[(axis + 2) % 3] = (c >= 2 ? 1 : -1) * half[(axis + 2) % 3];
        v[c] = mesh.vertex(at);
      }
      if (side > 0)
        mesh.face({v[0], v[1], v[2], v[3]});
      else
        mesh.face({v[3], v[2], v[1], v[0]});
    }
}

void add_patch(Mesh& mesh, const Eigen::Vector3d& own_middle, double radius) {
  const Eigen::Vector3d middle(own_middle.x(), own_middle.y(), 0);
  const std::uint32_t centre = mesh.vertex(middle);
  std::vector<std::uint32_t> last;
  constexpr int k_rings = 12;
  for (int r = 1; r <= k_rings; ++r) {
    const float share = static_cast<float>(r) / k_rings;
    const float fade = std::clamp((1 - share) / (1 - k_whole), 0.0F, 1.0F);
    std::vector<std::uint32_t> ring;
    for (int i = 0; i < k_around; ++i) {
      const double angle = 2 * M_PI * i / k_around;
      ring.push_back(mesh.vertex(
          middle + static_cast<double>(share) * radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0),
          fade * fade * (3 - 2 * fade)));
    }
    for (std::size_t i = 0; i < k_around; ++i) {
      const std::size_t j = (i + 1) % k_around;
      if (r == 1)
        mesh.face({centre, ring[i], ring[j]});
      else
        mesh.face({last[i], ring[i], ring[j], last[j]});
    }
    last = std::move(ring);
  }
}

}  // namespace

void add_obstacles(Scene& scene, const Document& document) {
  const std::vector<fem::Obstacle> obstacles = moving_obstacles(document.state(), document.state().motion->time);
  if (obstacles.empty() || scene.surface.positions.empty()) return;
  Eigen::Vector3f low = scene.surface.positions[0], high = low;
  for (const Eigen::Vector3f& x : scene.surface.positions) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Eigen::Vector3d middle = 0.5 * (low + high).cast<double>();
  const double radius = std::max(0.5 * static_cast<double>((high - low).norm()), 1e-9);
  for (const fem::Obstacle& obstacle : obstacles) {
    const fem::ObstaclePose pose = fem::pose_at(obstacle, document.state().motion->time);
    Mesh mesh(pose);
    switch (obstacle.shape) {
      case fem::ObstacleShape::plane:
        add_patch(mesh, pose.own(middle), static_cast<double>(k_patch) * radius);
        break;
      case fem::ObstacleShape::sphere:
        add_round(mesh, obstacle.size[0], 0);
        break;
      case fem::ObstacleShape::box:
        add_box(mesh, obstacle.size);
        break;
      case fem::ObstacleShape::capsule:
        add_round(mesh, obstacle.size[0], obstacle.size[1]);
        break;
    }
    scene.obstacles.push_back({mesh.take(), obstacle.shape == fem::ObstacleShape::plane});
  }
}

}  // namespace argil::sculpt
