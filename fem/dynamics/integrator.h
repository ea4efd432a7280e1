#pragma once
// Time steps in the control points (METHODS §5): BDF2 (default) and implicit Euler, each a minimisation by Newton's
// method with line search, its linear systems by preconditioned conjugate gradients.

#include <string_view>

#include "fem/system.h"

namespace argil::fem {

enum class Method { bdf2, implicit_euler };

struct StepOptions {
  Method method = Method::bdf2;
  int newton_cap = 3;              // interactive
  double newton_tolerance = 1e-4;  // relative to the first residual
  double linear_tolerance = 1e-4;  // PCG, relative residual
  int linear_cap = 2000;
};

/// What one step did; milliseconds by part are measured by the caller's clock, if it gives one.
struct StepReport {
  int newton_iterations = 0;
  int linear_iterations = 0;
  double residual = 0;  // relative
  bool converged = false;
  double ms_forces = 0, ms_tangent = 0, ms_solve = 0, ms_line_search = 0;
};
using Clock = double (*)();  // seconds; null: nothing is measured

/// Keeps what lasts from step to step (preconditioner, workspaces). Results depend on state and inputs only, never
/// on what was kept: after undo, the same step gives the same bits.
class Integrator {
 public:
  explicit Integrator(System system);
  ~Integrator();
  Integrator(Integrator&&) noexcept;
  Integrator& operator=(Integrator&&) noexcept;

  StepReport step(const Loads& loads, BodyState& state, double time_step, const StepOptions& options,
                  Clock clock = nullptr);
  /// Static equilibrium by Newton with load steps; velocities and history are cleared.
  /// @throws Error (not_converged) with what is left.
  StepReport solve_static(const Loads& loads, BodyState& state, const StepOptions& options, Clock clock = nullptr);

 private:
  struct Impl;
  Impl* impl_;
};

}  // namespace argil::fem
