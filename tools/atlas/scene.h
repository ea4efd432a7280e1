#pragma once
// The small bodies and motions that the atlas tries methods on: parameters, and the body that they make, ready to
// step.

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "fem/models/model_table.h"
#include "fem/system.h"

namespace argil::atlas {

/// What sets the body in motion.
enum class Motion {
  release,  // stretched by 5 % along x, held at x = 0, let go
  weight,   // held at its foot, gravity 9.81 m/s² switched on
  spin,     // free, turning about z
  invert,   // free, pressed along x through itself, with noise of 1 % of a cell, let go
  pull,     // held at x = 0, a force on the other end switched on
  session   // as the session ends, with its pins and loads
};

struct Scene {
  std::string body = "bar";  // bar, box, l; of a session its name
  Motion motion = Motion::release;
  // Parameters that a sweep may vary:
  double time_step = 1.0 / 60;  // [s]
  double young_modulus = 1e5;   // [Pa]; of a session a factor on its own
  double poisson_gap = 0.2;     // ½ − ν; not used with a session
  double contrast = 1;          // stiffness of the far half over that of the rest
  double aspect = 1;            // length of a cell over its height
  double rotation = 0;          // per step [rad]
  double inversion = 0;         // 0 at rest, 1 flat, 2 the mirror image
  double pull = 0;              // force over (Young's modulus · cross section)
  // Of a session:
  std::string session_text{};
  std::filesystem::path session_file{};
};

struct ParameterInfo {
  std::string_view name;   // as in files
  std::string_view title;  // as in pictures, with its unit
  std::string_view unit;
  double Scene::*value;
};
[[nodiscard]] const std::array<ParameterInfo, 8>& parameter_table();
[[nodiscard]] const ParameterInfo& parameter(double Scene::*value);

/// Hash of everything that the scene says.
[[nodiscard]] std::uint64_t scene_hash(const Scene& scene);

/// A body made of a scene: equations, loads, the state from which it starts. Its time step does not matter to it,
/// but with `spin`, where angular speed = rotation / time step.
class Body {
 public:
  /// @throws Error as the session commands that make it, fem::make_model() and lowest_modes() do.
  Body(const Scene& scene, const fem::ModelChoice& model);
  ~Body();
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  const fem::System& system() const;
  const fem::Loads& loads() const;
  const fem::BodyState& start() const;
  const Eigen::Matrix3Xd& rest() const;  // control points
  /// How long errors are measured: a period of the motion that the start and the loads excite [s], by the modes at
  /// rest; with `spin` half a second.
  double duration() const;
  /// ω_max of the model's pencil at rest [rad/s]; 0 where the model has none.
  double largest_frequency() const;
  /// Energy that the start holds beyond rest [J], by the tangent at rest where the model has no energy.
  double start_energy() const;
  /// Whether some quadrature point is inside out at these control points.
  bool is_inverted(const Eigen::Matrix3Xd& positions) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace argil::atlas
