#pragma once
// Time steps in the control points (METHODS §5) by the methods of method.h. Implicit ones minimise an incremental
// potential by Newton's method with line search, its linear systems by preconditioned conjugate gradients; explicit
// ones solve with the factored consistent mass.

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "fem/dynamics/method.h"
#include "fem/solvers/preconditioner.h"
#include "fem/system.h"
#include "subdiv/progress.h"

namespace argil::fem {

struct StepOptions {
  Method method = Method::bdf2;
  int newton_cap = 3;              // interactive
  double newton_tolerance = 1e-4;  // relative to the first residual
  bool line_search = true;         // false takes whole Newton steps, to show where they fail
  double spectral_radius = 0.8;    // of generalised-α at infinite frequency, in [0, 1]: what is left after a step
  double linear_tolerance = 1e-4;  // PCG, relative residual
  int linear_cap = 2000;
  Progress progress{};  // of a step; a listener that throws leaves the state as it was
};

/// What one step did; milliseconds by part are measured by the caller's clock, if it gives one.
struct StepReport {
  int newton_iterations = 0;
  int linear_iterations = 0;
  double residual = 0;  // relative
  bool converged = false;
  PreconditionerKind preconditioner = PreconditionerKind::jacobi;
  double ms_forces = 0, ms_tangent = 0, ms_solve = 0, ms_line_search = 0;
};
/// Several steps as one: counts and times add up, what else there is to say is that of the last.
void append(StepReport& sum, const StepReport& next);
using Clock = double (*)();  // seconds; null: nothing is measured

/// Keeps what lasts from step to step (the rest operator, its factor). Results depend on state and inputs only,
/// never on what was kept: after undo, the same step gives the same bits.
class Integrator {
 public:
  /// What `system` points to must outlive the integrator.
  explicit Integrator(System system);
  ~Integrator();
  Integrator(Integrator&&) noexcept;
  Integrator& operator=(Integrator&&) noexcept;

  /// To be called when materials, mass, damping or rest positions have changed behind the system's pointers (a
  /// force model at another address needs a new integrator).
  void materials_changed();
  /// Takes another model of the same body, as after it flowed; what was made of System::rest_model, which must be
  /// given, is kept.
  void set_model(const ForceModel& model);
  /// Takes other pins; the rest operator is kept.
  void set_fixed(std::vector<std::uint8_t> fixed);

  /// One step of length `time_step` [s]. BDF2 without history of the same step length is implicit Euler, central
  /// difference then starts from position, velocity and acceleration. A fixed control point keeps its position and
  /// has velocity 0, unless the loads lead it. The model's own forces that depend on velocity are taken at the
  /// start of the step; damping by density is implicit in implicit methods and in central difference, damping by
  /// stiffness in implicit ones. The published method takes as many parts as METHODS §4 asks for, at most 500 a
  /// step. Stops after `newton_cap` iterations without complaint; the report tells.
  /// @throws Error (not_converged) if a value is not finite, (limit_exceeded) if a published step has too many
  /// parts, (unsupported) if the published method finds the tangent at rest not symmetric, (bad_input) for a time
  /// step that is not positive; `state` is then as it was.
  StepReport step(const Loads& loads, BodyState& state, double time_step, const StepOptions& options,
                  Clock clock = nullptr);

  /// Static equilibrium by Newton, with load steps where the whole load fails; velocities and history are cleared.
  /// Its tolerance is at most 1e-8 of the loads and reactions, whatever the options say; their cap is not used.
  /// @throws Error (bad_input) if the load pushes along a rigid motion that nothing holds, (not_converged) with
  /// what is left; `state` is then as it was.
  StepReport solve_static(const Loads& loads, BodyState& state, const StepOptions& options, Clock clock = nullptr);

  [[nodiscard]] const System& system() const;
  /// Of the model at these control points [J]; the last one is remembered, as are the forces of explicit methods.
  [[nodiscard]] double elastic_energy(const Eigen::Matrix3Xd& positions);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace argil::fem
