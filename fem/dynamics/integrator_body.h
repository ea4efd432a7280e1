#pragma once
// What an Integrator keeps from step to step and its methods share; private to fem/dynamics.

#include <optional>

#include "fem/contact/contact.h"
#include "fem/dynamics/integrator.h"
#include "fem/dynamics/newton.h"
#include "fem/dynamics/viscous_damping.h"
#include "fem/solvers/mass_factor.h"
#include "fem/solvers/rest_operator.h"
#include "fem/solvers/solver_choice.h"

namespace argil::fem {

/// C = M̃/mass + D̃/damping (+ viscosity/damping), both [s²] and [s]; zero in statics.
struct Divisors {
  double mass = 0, damping = 0;
  bool operator==(const Divisors&) const = default;
};

/// What the published method makes of a body: both follow from ω_max of its pencil at rest, with the springs.
struct PublishedScheme {
  double damping_rate = 0;            // γ of a damping γ M̃ [1/s]
  double longest_step = 0;            // [s]
  std::vector<AnchorSpring> springs;  // those that it was made for; their targets do not matter
};

struct Integrator::Impl {
  explicit Impl(System of) : system(std::move(of)) {}

  System system;
  std::vector<std::uint8_t> free;  // not fixed, and some element depends on it
  // Implicit methods.
  std::optional<RestOperator> rest, viscous_rest;
  std::optional<ViscousDamping> viscous;
  double contrast = -1;  // of stiffness; negative: not asked yet
  Eigen::SparseMatrix<double> inertia;
  std::unique_ptr<Preconditioner> preconditioner;
  PreconditionerColumns columns;  // of that one
  // Explicit methods: M̃ + share (D̃ + rate M̃), factored.
  double mass_share = -1, mass_rate = 0;
  double damping_rate = 0;  // [1/s], what the method in use adds to the damping by density
  std::optional<PublishedScheme> scheme;
  std::unique_ptr<MassFactor> mass_factor;

  Eigen::Index size() const { return static_cast<Eigen::Index>(system.rows->column_count); }
  void forget_materials();
  void forget_pins();
  void forget_values();  // of forces and energy

  /// Makes what implicit steps with these divisors need, unless it is there.
  void prepare(const Divisors& divisors, const std::vector<AnchorSpring>& springs, const Progress& progress);
  const MassFactor& factored_mass(double damping_share);
  /// Damping by stiffness, null if there is none.
  ViscousDamping* stiffness_damping();
  /// Takes the viscosity at these control points into a potential that prepare() was called for.
  void set_viscosity(Potential& potential, const Eigen::Matrix3Xd& positions, double divisor);
  /// Aᵀ V A · velocities at the state that set_viscosity() took; 3 x control points.
  Eigen::Matrix3Xd viscous_product(const Eigen::Matrix3Xd& velocities) const;
  Potential potential(const std::vector<AnchorSpring>& springs) const;

  Eigen::Matrix3Xd load_forces(const Loads& loads) const;
  /// Aᵀ of the model's own forces that depend on velocity.
  Eigen::Matrix3Xd velocity_forces(const BodyState& state) const;
  const Eigen::Matrix3Xd& elastic_forces(const Eigen::Matrix3Xd& positions);
  double elastic_energy(const Eigen::Matrix3Xd& positions);
  /// All that acts at a time of a step that began with `begin`, but for the damping by density, which
  /// with_mass_damping() adds.
  Eigen::Matrix3Xd forces(const Loads& loads, const BodyState& begin, double time,
                          const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& velocities);
  Eigen::Matrix3Xd with_mass_damping(Eigen::Matrix3Xd forces, const Eigen::Matrix3Xd& velocities) const;

  StepReport incremental_step(const Loads& loads, BodyState& state, double h, const StepOptions& options,
                              Clock clock);
  StepReport generalised_alpha_step(const Loads& loads, BodyState& state, double h, const StepOptions& options,
                                    Clock clock);
  StepReport explicit_step(const Loads& loads, BodyState& state, double h, const StepOptions& options, Clock clock);
  const PublishedScheme& published_scheme(const std::vector<AnchorSpring>& springs);
  StepReport published_step(const Loads& loads, BodyState& state, double h, const StepOptions& options,
                            Clock clock);

 private:
  /// What a preconditioner is made for; the springs' targets do not matter.
  struct Key {
    Divisors divisors{-1, -1};
    std::vector<AnchorSpring> springs;
    bool without_springs = false;
    bool fits(const Divisors& others, const std::vector<AnchorSpring>& other_springs) const;
  };
  void find_free();
  Key key_;
  // The last forces and energy asked for; what they were asked at is compared bit for bit.
  Eigen::Matrix3Xd forces_at_, elastic_forces_, energy_at_;
  double elastic_energy_ = 0;
};

/// Whether they hold the same points alike, wherever they pull them.
[[nodiscard]] bool same_hold(const std::vector<AnchorSpring>& a, const std::vector<AnchorSpring>& b);
[[nodiscard]] NewtonOptions newton_options(const StepOptions& options);
/// Contact of a step that begins with `begin`, at a time of it; nothing without obstacles.
[[nodiscard]] std::optional<ContactStep> contact_step(const Loads& loads, const BodyState& begin, double time);
/// What the state has that ends the step with these control points.
[[nodiscard]] std::vector<ContactGrip> grips_at(std::optional<ContactStep>& contact,
                                                const Eigen::Matrix3Xd& positions);
/// The state one step on, its history the present one.
void advance(BodyState& state, Eigen::Matrix3Xd positions, Eigen::Matrix3Xd velocities, double h);
/// Columns that are not free are set to zero.
void clear_held(const std::vector<std::uint8_t>& free, Eigen::Matrix3Xd& values);
}  // namespace argil::fem
