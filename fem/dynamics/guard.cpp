#include "fem/dynamics/guard.h"

#include <algorithm>
#include <cmath>

#include "fem/dynamics/step_judge.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr int k_substep_rungs[] = {2, 4, 8};
constexpr double k_guard_newton_tolerance = 1e-6;
// Of the force out of balance that an eased step lets through. From rest a body of stiffness E held by a tool of
// some 1e3 E is still drawn by no more than its own size.
constexpr double k_shares_in_motion[] = {1.0 / 2, 1.0 / 8, 1.0 / 32, 0};
constexpr double k_shares_from_rest[] = {1.0 / 2, 1.0 / 8, 1.0 / 32, 1.0 / 128, 1.0 / 512};
constexpr int k_eased_parts = 8;

void add(StepReport& sum, const StepReport& report) {
  const StepReport before = sum;
  sum = report;
  sum.newton_iterations += before.newton_iterations;
  sum.linear_iterations += before.linear_iterations;
  sum.ms_forces += before.ms_forces;
  sum.ms_tangent += before.ms_tangent;
  sum.ms_solve += before.ms_solve;
  sum.ms_line_search += before.ms_line_search;
}

/// The body where it is, at rest and without history.
BodyState at_rest(const BodyState& state) {
  BodyState result;
  result.positions = state.positions;
  result.velocities.setZero(3, state.positions.cols());
  result.time = state.time;
  return result;
}

/// The loads with a dead force that holds back all but a share of what is out of balance at `positions`.
Loads eased(const System& system, const Loads& loads, const Eigen::Matrix3Xd& positions, double share) {
  Eigen::Matrix3Xd node_forces;
  system.model->forces(nodes(system, positions), node_forces);
  Eigen::Matrix3Xd unbalanced = generalised_forces(system, node_forces);
  if (loads.forces.cols() > 0) unbalanced += loads.forces;
  add_spring_forces(loads.springs, positions, unbalanced);
  Loads result = loads;
  if (result.forces.cols() == 0) result.forces.setZero(3, positions.cols());
  result.forces -= (1 - share) * unbalanced;
  return result;
}

/// Sizes of what acts on a body [N].
struct LoadSize {
  double dead = 0, pull = 0;
};
LoadSize size_of(const Loads& loads, const Eigen::Matrix3Xd& positions) {
  LoadSize result;
  for (Eigen::Index i = 0; i < loads.forces.cols(); ++i) result.dead += loads.forces.col(i).norm();
  for (const AnchorSpring& spring : loads.springs)
    result.pull += spring.stiffness * (spring.target - held_point(spring, positions)).norm();
  return result;
}

/// One way to take a step.
struct Attempt {
  StepOptions options;
  int parts = 1;
  GuardRemedy remedy = GuardRemedy::none;
  double share = 1;  // of the force out of balance
};

class Ladder {
 public:
  Ladder(Integrator& integrator, const Loads& loads, BodyState& state, GuardState& guard, double time_step,
         Clock clock)
      : integrator_(integrator),
        loads_(loads),
        state_(state),
        guard_(guard),
        time_step_(time_step),
        clock_(clock),
        judge_(integrator),
        begin_(state),
        worth_(judge_.worth(state, guard.surplus)) {}

  /// True if the step is good, which is then taken.
  bool take(const Attempt& attempt) {
    BodyState trial = begin_;
    Worth worth = worth_;
    StepReport sum;
    const GuardFinding finding = run(attempt, trial, worth, sum);
    if (finding != GuardFinding::none) {
      if (report.finding == GuardFinding::none) report.finding = finding;
      return false;
    }
    trial.time = begin_.time + time_step_;
    state_ = std::move(trial);
    guard_.surplus = worth.surplus;
    report.step = sum;
    report.remedy = attempt.remedy;
    report.substeps = attempt.parts;
    report.share = attempt.share;
    return true;
  }

  /// Goes on from the body at rest. The motion that is lost pays back what was made of nothing; what is stored
  /// stays on the account.
  void stop() {
    begin_ = at_rest(begin_);
    worth_.surplus = std::max(0.0, worth_.surplus - worth_.kinetic);
    worth_.kinetic = 0;
  }
  bool moves() const { return worth_.kinetic > 0; }

  void stand_still() {
    stop();
    state_ = begin_;
    state_.time += time_step_;
    guard_.surplus = worth_.surplus;
  }

  GuardedReport report;

 private:
  GuardFinding run(const Attempt& attempt, BodyState& trial, Worth& worth, StepReport& sum) {
    Loads held_back;
    if (attempt.share < 1) {
      held_back = eased(integrator_.system(), loads_, trial.positions, attempt.share);
      if (!held_back.forces.allFinite()) return GuardFinding::not_finite;
    }
    for (int part = 0; part < attempt.parts; ++part) {
      const Eigen::Matrix3Xd from = trial.positions;
      try {
        add(sum, integrator_.step(attempt.share < 1 ? held_back : loads_, trial, time_step_ / attempt.parts,
                                  attempt.options, clock_));
      } catch (const Error& error) {
        if (error.code() != ErrorCode::not_converged) throw;
        return GuardFinding::not_finite;
      }
      // The work is that of the true loads: what holds them back may take energy, but gives none.
      const GuardFinding finding = judge_.judge(loads_, from, trial, worth);
      if (finding != GuardFinding::none) return finding;
    }
    return GuardFinding::none;
  }

  Integrator& integrator_;
  const Loads& loads_;
  BodyState& state_;
  GuardState& guard_;
  double time_step_;
  Clock clock_;
  StepJudge judge_;
  BodyState begin_;
  Worth worth_;
};

}  // namespace

std::string_view word(GuardFinding finding) {
  switch (finding) {
    case GuardFinding::none:
      return "none";
    case GuardFinding::not_finite:
      return "not_finite";
    case GuardFinding::energy:
      return "energy";
    case GuardFinding::inversion:
      return "inversion";
  }
  return "";
}

std::string_view word(GuardRemedy remedy) {
  switch (remedy) {
    case GuardRemedy::none:
      return "none";
    case GuardRemedy::substeps:
      return "substeps";
    case GuardRemedy::iterations:
      return "iterations";
    case GuardRemedy::implicit_euler:
      return "implicit_euler";
    case GuardRemedy::eased:
      return "eased";
    case GuardRemedy::eased_from_rest:
      return "eased_from_rest";
    case GuardRemedy::restored:
      return "restored";
    case GuardRemedy::frozen:
      return "frozen";
  }
  return "";
}

GuardedReport guarded_step(Integrator& integrator, const Loads& loads, BodyState& state, GuardState& guard,
                           double time_step, const StepOptions& options, Clock clock) {
  const LoadSize load = guard.frozen || guard.failures > 0 ? size_of(loads, state.positions) : LoadSize{};
  if (guard.frozen && load.dead >= k_guard_thaw * guard.dead_load && load.pull >= k_guard_thaw * guard.pull) {
    GuardedReport report;
    const double time = state.time + time_step;
    state = at_rest(state);
    state.time = time;
    report.remedy = GuardRemedy::frozen;
    report.step.converged = true;
    report.step.preconditioner = PreconditionerKind::none;
    return report;
  }
  if (guard.frozen) {
    guard.frozen = false;
    guard.failures = k_guard_failures - 1;
    guard.dead_load = guard.pull = 0;
  }
  Ladder ladder(integrator, loads, state, guard, time_step, clock);
  if (ladder.take({options})) {
    if (guard.surplus == 0) guard.failures = 0;
    return ladder.report;
  }
  for (const int parts : k_substep_rungs)
    if (ladder.take({options, parts, GuardRemedy::substeps})) return ladder.report;
  StepOptions careful = options;
  careful.line_search = true;
  careful.newton_cap = std::max(options.newton_cap, k_guard_newton_cap);
  careful.newton_tolerance = std::min(options.newton_tolerance, k_guard_newton_tolerance);
  if (method_kind(options.method).is_implicit && options.method != Method::semi_implicit &&
      ladder.take({careful, 1, GuardRemedy::iterations}))
    return ladder.report;
  careful.method = Method::implicit_euler;
  for (const int parts : {1, k_eased_parts})
    if (ladder.take({careful, parts, GuardRemedy::implicit_euler})) return ladder.report;
  if (ladder.moves())
    for (const double share : k_shares_in_motion)
      if (ladder.take({careful, k_eased_parts, GuardRemedy::eased, share})) return ladder.report;
  ladder.stop();
  for (const double share : k_shares_from_rest)
    if (ladder.take({careful, k_eased_parts, GuardRemedy::eased_from_rest, share})) return ladder.report;

  ladder.stand_still();
  guard.cause = ladder.report.finding;
  guard.frozen = ++guard.failures >= k_guard_failures;
  if (guard.frozen) {
    const LoadSize load_now = size_of(loads, state.positions);
    guard.dead_load = load_now.dead;
    guard.pull = load_now.pull;
  }
  ladder.report.remedy = guard.frozen ? GuardRemedy::frozen : GuardRemedy::restored;
  return ladder.report;
}

}  // namespace argil::fem
