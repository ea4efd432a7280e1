#pragma once
// The guard about a step (DESIGN, "Physics that is true"): no method hides an instability, and none loses the
// model.
//
// After each step it asks whether every value is finite, whether energy has come from nowhere, and, for models to
// which an inside-out cell is a state of rest (Promises::inversion_is_error), whether a cell has newly turned
// inside out. Energy: kinetic + elastic at the end, less at the beginning, less the work of loads and springs
// during the step, whose targets stand still in it, is what the step made of nothing, or lost. The gains are added
// up over steps, losses pay them back (never below zero); the step is refused if the sum has come to more than half
// of the energy that is there and still grows (for models without an energy: the half-product of force and
// displacement). So the energy of a body never exceeds twice what was put in. An explicit method below its limit
// swings by less than that unless its highest frequency carries the motion; implicit methods lose energy, and what
// Newton's tolerance adds is some 1e-4 of it. Motion of less than a hundredth of the body's size a second is let
// pass, since nothing is lost by it.
//
// A refused step is taken back, and tried again by a ladder of remedies, each from the last good state:
// * 2, 4 and 8 substeps;
// * Newton's method with line search and up to 50 iterations (implicit methods);
// * implicit Euler with both, in 1 and in 8 substeps, and in 8 substeps for all that follows;
// * eased: of the force that is out of balance at the start (loads, springs and the body's answer) only 1/2, 1/8 or
//   nothing acts, a dead force holding back the rest for this step, so that a tool draws the body as far as it can
//   follow;
// * eased from rest: the same with 1/2, 1/8, 1/32 and 1/256, the body starting without motion;
// * held: the body starts without motion, and the control points on which the cells that would turn inside out
//   depend most are held where they are for this step, as by pins, and more of them if that is not enough, under
//   the whole load or 1/16 of what is out of balance;
// * the good beginning of the first of the steps eased from rest that had one, the body being stopped there;
// * as a whole: a body without pins, if its forces are finite, keeps its shape and moves as its momentum and loads
// do. What holds back in an eased step may give back what it took in the same step; more of it counts as energy
// from nowhere; pins do no work but where they are led, by the forces that they need at both ends of the step. In
// the parts of a step they are led straight, and they stop with a body that is stopped. If none helps the body
// stays where it was for this step, at rest. After three such failures it is frozen, until it is thawed or until
// less than half is left of the dead loads, or of the pull of springs, that acted when it froze: then it is tried
// again by itself, and one more failure freezes it. An untroubled step with no energy on the account forgets
// failures.

#include <array>
#include <string>
#include <string_view>

#include "fem/dynamics/integrator.h"

namespace argil::fem {

inline constexpr double k_guard_share = 0.5;        // of the energy present, that may have come from nowhere
inline constexpr double k_guard_rounding = 1e-9;    // of the energy present: no growth
inline constexpr double k_guard_negligible = 0.01;  // of the body's size a second: motion that harms nothing
inline constexpr int k_guard_failures = 3;          // failed ladders that freeze a body
inline constexpr double k_guard_thaw = 0.5;         // of the load at freezing, below which it is tried again
inline constexpr int k_guard_newton_cap = 50;

enum class GuardFinding { none, not_finite, energy, inversion };
enum class GuardRemedy {
  none,
  substeps,
  iterations,
  implicit_euler,
  eased,
  eased_from_rest,
  held,
  as_a_whole,
  restored,
  frozen
};
inline constexpr std::array k_guard_findings{GuardFinding::not_finite, GuardFinding::energy,
                                             GuardFinding::inversion};
inline constexpr std::array k_guard_remedies{
    GuardRemedy::substeps,   GuardRemedy::iterations,      GuardRemedy::implicit_euler,
    GuardRemedy::eased,      GuardRemedy::eased_from_rest, GuardRemedy::held,
    GuardRemedy::as_a_whole, GuardRemedy::restored,        GuardRemedy::frozen};
[[nodiscard]] std::string_view word(GuardFinding finding);
[[nodiscard]] std::string_view word(GuardRemedy remedy);

/// What the guard carries from step to step: part of a body's state, as its history is.
struct GuardState {
  double surplus = 0;  // energy made of nothing and not yet paid back [J]
  int failures = 0;    // failed ladders that no untroubled step has made up for
  bool frozen = false;
  GuardFinding cause = GuardFinding::none;  // of the last failure
  double dead_load = 0, pull = 0;           // of a frozen body when it was frozen: Σ |force|, of springs apart [N]
  bool operator==(const GuardState&) const = default;
};

struct GuardedReport {
  StepReport step;  // of the attempt that was kept, counts summed over its substeps
  GuardFinding finding = GuardFinding::none;
  GuardRemedy remedy = GuardRemedy::none;
  int substeps = 1;
  double share = 1;  // of the force out of balance that the step let through
};

/// One step under guard; at most 154 substeps in all. A frozen body only gets older. Beside the step it costs one
/// elastic energy, a mass product, and for models that ask for it the Jacobians; holding cells factors anew.
/// @throws Error for what is wrong with the arguments, never for what a method makes of them.
GuardedReport guarded_step(Integrator& integrator, const Loads& loads, BodyState& state, GuardState& guard,
                           double time_step, const StepOptions& options, Clock clock = nullptr);

/// Kinetic energy [J].
[[nodiscard]] double kinetic_energy(const System& system, const Eigen::Matrix3Xd& velocities);
/// Quadrature points where det F ≤ 0; 0 if the system names no blocks. Cost O(points), in parallel.
[[nodiscard]] std::size_t inverted_points(const System& system, const Eigen::Matrix3Xd& positions);

}  // namespace argil::fem
