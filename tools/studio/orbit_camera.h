#pragma once
// How the sculptor looks at the solid: an eye that turns about a pivot, z staying up; panning, zooming, presets and
// framing, with changes of preset gliding. In world coordinates [m]; `camera` gives what tools/view draws with.

#include <Eigen/Core>
#include <optional>

#include "tools/studio/ui.h"
#include "tools/view/camera.h"

namespace argil::studio {

struct Ray {
  Eigen::Vector3d origin, direction;  // unit
};

struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Ones();
  [[nodiscard]] Eigen::Vector3d middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double radius() const { return 0.5 * (high - low).norm(); }
};

class OrbitCamera {
 public:
  /// The window in pixels and its part that no panel covers, where the pivot shows in the middle.
  void set_window(int width, int height, const Rect& free);

  void orbit(double right, double up);  // pixels that the pointer went
  void pan(double right, double up);
  void zoom(double notches);
  void look_from(double yaw, double pitch);  // [rad], glides
  void frame(const Box& box);                // glides
  /// Ends a glide at once.
  void arrive();
  void advance(double seconds);

  [[nodiscard]] Ray ray(double x, double y) const;
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector3d& position) const;
  [[nodiscard]] Eigen::Vector3d eye() const;
  [[nodiscard]] Eigen::Vector3d towards_eye() const;
  /// Size of a pixel at a place [m].
  [[nodiscard]] double pixel_size(const Eigen::Vector3d& position) const;
  /// For a scene that reaches `box` and its shadow.
  [[nodiscard]] view::Camera camera(const view::Place& place, const Box& box) const;
  [[nodiscard]] const Eigen::Vector3d& pivot() const { return now_.pivot; }

 private:
  struct Pose {
    Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
    double yaw = -1.0, pitch = 0.42, distance = 3;  // [rad], [m]
  };
  [[nodiscard]] Eigen::Matrix3d view_from_world() const;

  Pose now_;
  std::optional<Pose> goal_;
  int width_ = 1, height_ = 1;
  Rect free_;
};

}  // namespace argil::studio
