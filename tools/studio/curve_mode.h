#pragma once
// Sculpting by a curve in the window (sculpt/force_tools/curve.h): clicks lay its points, then its handles draw the
// clay. The points are the sculptor's; where they lie on the clay now is in the snapshot.

#include "tools/studio/desk.h"
#include "tools/studio/orbit_camera.h"

namespace argil::studio {

/// The handle at a place of the screen, if one is near.
[[nodiscard]] std::optional<std::size_t> handle_at(const Desk& desk, const OrbitCamera& camera, double x, double y);
/// Adds a point, unless one is there.
void add_curve_point(Desk& desk, const OrbitCamera& camera, const Eigen::Vector3d& at);
/// A stroke that moves a handle.
[[nodiscard]] StrokeStart handle_stroke(const Desk& desk, std::size_t handle, double pressure);
/// Enter, Backspace and Esc, as far as they are the curve's. True if they were.
bool perform_curve(Desk& desk, Action action);

}  // namespace argil::studio
