#pragma once
// Newton's method with line search on the incremental potential of a time step (METHODS §5), or on the potential
// energy in statics:
//   Φ(p) = ½ (p − p̄)ᵀ C (p − p̄) − gᵀ p + Ψ(A p) + springs,   C = M̃/c² + D̃/c + Aᵀ V A/c,   g = M̃ v̄/c + loads,
// V the viscosity at a state that is known before the step (viscous_damping.h).

#include <Eigen/SparseCore>

#include "fem/contact/contact.h"
#include "fem/contact/contact_preconditioner.h"
#include "fem/dynamics/integrator.h"
#include "fem/dynamics/viscous_damping.h"
#include "fem/solvers/rest_operator.h"

namespace argil::fem {

struct Forces {
  Eigen::Matrix3Xd total;    // −∂Φ/∂p in the free control points, zero elsewhere
  Eigen::Matrix3Xd elastic;  // Aᵀ f of the model and of contact, everywhere: what is not linear
  double held = 0;           // 2-norm of −∂Φ/∂p in the other control points: the size of the reactions
};

struct Potential {
  const ForceModel* model = nullptr;
  const RestOperator* rest = nullptr;          // its rows are those that elements name
  const Eigen::SparseMatrix<double>* inertia;  // C; empty in statics
  Eigen::Matrix3Xd anchor;                     // p̄; unused in statics
  Eigen::Matrix3Xd constant_force;             // g
  const std::vector<AnchorSpring>* springs = nullptr;
  const std::vector<std::uint8_t>* free = nullptr;
  const ViscousDamping* viscous = nullptr;   // null: none
  double viscous_coefficient = 0;            // 1/c
  ContactStep* contact = nullptr;            // at the place of forces() that was asked for last; null: none
  PreconditionerColumns* columns = nullptr;  // kept for contact by whoever keeps the preconditioner; null: plain

  [[nodiscard]] Forces forces(const Eigen::Matrix3Xd& p) const;
  [[nodiscard]] double elastic_energy(const Eigen::Matrix3Xd& p) const;
  /// Of contact, with friction limited as where forces() was asked for last.
  [[nodiscard]] double contact_energy(const Eigen::Matrix3Xd& p) const;
  /// (C + springs) · direction: the part of the Hessian that does not change, in all control points.
  void constant_stiffness_product(const Eigen::Matrix3Xd& direction, Eigen::Matrix3Xd& result) const;
  /// Norm of the rounding error of the force: machine precision times the terms that cancel in it.
  [[nodiscard]] double rounding(const Eigen::Matrix3Xd& p) const;
};

struct NewtonOptions {
  int cap = 3;
  double tolerance = 1e-4;     // of the first residual, or of `reference` if that is given
  bool line_search = true;     // false takes whole steps, to show where they fail
  bool against_loads = false;  // statics: relative to the loads and reactions
  bool full_tangent = false;   // try the tangent as it is, and project it only where it is indefinite
  double linear_tolerance = 1e-4;
  int linear_cap = 2000;
  Progress progress{};
};

/// Minimises from `p`, which moves to the last iterate; counts and times are added to `report`.
/// @throws Error (not_converged) if a value is not finite.
void minimise(const Potential& potential, const Preconditioner& preconditioner, const NewtonOptions& options,
              Eigen::Matrix3Xd& p, StepReport& report, Clock clock);

/// @throws Error (not_converged) that says what to do.
[[noreturn]] void fail_not_finite();

}  // namespace argil::fem
