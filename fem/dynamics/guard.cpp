#include "fem/dynamics/guard.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "fem/dynamics/eased_loads.h"
#include "fem/dynamics/step_judge.h"
#include "fem/dynamics/whole_motion.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr int k_substep_rungs[] = {2, 4, 8};
constexpr double k_guard_newton_tolerance = 1e-6;
// Of the force out of balance that acts. 1/256 lets a tool draw a body that it is a hundred times too strong for.
constexpr double k_shares_in_motion[] = {1.0 / 2, 1.0 / 8, 0};
constexpr double k_shares_from_rest[] = {1.0 / 2, 1.0 / 8, 1.0 / 32, 1.0 / 256};
constexpr double k_shares_held[] = {1, 1.0 / 16};
// Of the largest influence that a control point has on a cell that would turn: those that have more are held.
constexpr double k_influence_held[] = {0.75, 0.25, 0};
constexpr int k_eased_parts = 8;

/// The body where it is, at rest and without history.
BodyState at_rest(const BodyState& state) {
  BodyState result;
  result.positions = state.positions;
  result.velocities.setZero(3, state.positions.cols());
  result.time = state.time;
  result.grips = state.grips;
  return result;
}

/// True if less than half is left of what acted when the body froze.
bool has_lessened(const Loads& loads, const BodyState& state, const GuardState& guard) {
  const LoadSize load = size_of(loads, state);
  return load.dead < k_guard_thaw * guard.dead_load || load.pull < k_guard_thaw * guard.pull;
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
        given_(state),
        begin_(state),
        given_worth_(judge_.worth(state, guard.surplus)),
        worth_(given_worth_) {}

  /// True if the step is good, which is then taken.
  bool take(const Attempt& attempt) {
    BodyState trial = begin_;
    Worth worth = worth_;
    StepReport sum;
    int parts = 0;
    const GuardFinding finding = last_ = run(attempt, trial, worth, sum, parts);
    if (finding != GuardFinding::none) {
      if (report.finding == GuardFinding::none) report.finding = finding;
      // The larger shares come first.
      if (attempt.remedy == GuardRemedy::eased_from_rest && parts > 0 && !broken_off_) {
        Kept kept{attempt, std::move(trial), worth, sum};
        kept.attempt.share *= static_cast<double>(parts) / attempt.parts;
        broken_off_ = std::move(kept);
      }
      return false;
    }
    keep({attempt, std::move(trial), worth, sum});
    return true;
  }

  /// Takes the good beginning of an attempt from rest, and stops the body there.
  bool take_broken_off() {
    if (!broken_off_) return false;
    Kept kept = std::move(*broken_off_);
    kept.state = at_rest(kept.state);
    kept.worth.surplus = std::max(0.0, kept.worth.surplus - kept.worth.kinetic);
    keep(std::move(kept));
    return true;
  }

  /// The motion that the body had counts again.
  bool take_as_a_whole() {
    const System& system = integrator_.system();
    if (last_ == GuardFinding::not_finite || !moves_as_a_whole(system)) return false;
    Kept kept{{{}, 1, GuardRemedy::as_a_whole}, given_, given_worth_, {}};
    step_as_a_whole(system, loads_, kept.state, time_step_);
    if (judge_.judge(loads_, given_, kept.state, 0, kept.worth) != GuardFinding::none) return false;
    kept.sum.converged = true;
    kept.sum.preconditioner = PreconditionerKind::none;
    keep(std::move(kept));
    return true;
  }

  /// Goes on from the body at rest. The motion that is lost pays back what was made of nothing; what is stored
  /// stays on the account.
  void stop() {
    begin_ = at_rest(begin_);
    worth_.surplus = std::max(0.0, worth_.surplus - worth_.kinetic);
    worth_.kinetic = 0;
  }
  /// Tries a step with the cells held that turned inside out in the last attempt, and if others do, those as well.
  bool take_holding(const Attempt& attempt) {
    const Pins pins(integrator_);
    for (const double influence : k_influence_held) {
      if (turned_.cols() == 0) return false;
      if (held_.empty()) held_ = pins.given;
      mark_turned(integrator_.system(), begin_.positions, turned_, influence, held_);
      if (std::find(held_.begin(), held_.end(), std::uint8_t{0}) == held_.end()) return false;
      integrator_.set_fixed(held_);
      if (take(attempt)) return true;
    }
    return false;
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
  /// Gives the integrator its own pins back at the end.
  struct Pins {
    explicit Pins(Integrator& of) : integrator(of), given(of.system().fixed) {}
    ~Pins() { integrator.set_fixed(given); }
    Pins(const Pins&) = delete;
    Pins& operator=(const Pins&) = delete;
    Integrator& integrator;
    std::vector<std::uint8_t> given;
  };

  struct Kept {
    Attempt attempt;
    BodyState state;
    Worth worth;
    StepReport sum;
  };
  void keep(Kept kept) {
    kept.state.time = begin_.time + time_step_;
    state_ = std::move(kept.state);
    guard_.surplus = kept.worth.surplus;
    report.step = kept.sum;
    report.remedy = kept.attempt.remedy;
    report.substeps = kept.attempt.parts;
    report.share = kept.attempt.share;
  }

  /// `trial`, `worth` and `parts` are those of the last good part.
  GuardFinding run(const Attempt& attempt, BodyState& trial, Worth& worth, StepReport& sum, int& parts) {
    turned_.resize(3, 0);
    Loads held_back;
    double held_back_work = 0;  // of the dead force that eases, over the step until here [J]
    if (attempt.share < 1) {
      held_back = eased(integrator_.system(), loads_, trial, attempt.share);
      if (!held_back.forces.allFinite()) return GuardFinding::not_finite;
    }
    for (; parts < attempt.parts; ++parts) {
      BodyState next = trial;
      try {
        append(sum, integrator_.step(attempt.share < 1 ? held_back : loads_, next, time_step_ / attempt.parts,
                                     attempt.options, clock_));
      } catch (const Error& error) {
        if (error.code() != ErrorCode::not_converged) throw;
        return GuardFinding::not_finite;
      }
      // The force that eases may give back what it has taken in this step; more has come from nowhere.
      double given = 0;
      if (attempt.share < 1) {
        held_back_work += dead_work(held_back, trial.positions, next.positions) -
                          dead_work(loads_, trial.positions, next.positions);
        given = std::max(0.0, held_back_work);
        held_back_work -= given;
      }
      const GuardFinding finding = judge_.judge(attempt.share < 1 ? held_back : loads_, trial, next, given, worth);
      if (finding == GuardFinding::inversion) turned_ = next.positions;
      if (finding != GuardFinding::none) return finding;
      trial = std::move(next);
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
  BodyState given_, begin_;
  Worth given_worth_, worth_;
  Eigen::Matrix3Xd turned_;  // where the last attempt had turned cells inside out; else empty
  GuardFinding last_ = GuardFinding::none;
  std::optional<Kept> broken_off_;
  std::vector<std::uint8_t> held_;  // control points
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
    case GuardRemedy::held:
      return "held";
    case GuardRemedy::as_a_whole:
      return "as_a_whole";
    case GuardRemedy::restored:
      return "restored";
    case GuardRemedy::frozen:
      return "frozen";
  }
  return "";
}

GuardedReport guarded_step(Integrator& integrator, const Loads& loads, BodyState& state, GuardState& guard,
                           double time_step, const StepOptions& options, Clock clock) {
  if (guard.frozen && !has_lessened(loads, state, guard)) {
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
  // Newton's method may find no way down the residual of forces whose tangent is another's; a single solve needs
  // none.
  StepOptions one_solve = careful;
  one_solve.method = Method::semi_implicit;
  const bool has_energy = integrator.system().model->promises().has_energy;
  for (const double share : k_shares_from_rest) {
    if (ladder.take({careful, k_eased_parts, GuardRemedy::eased_from_rest, share})) return ladder.report;
    if (!has_energy && ladder.take({one_solve, k_eased_parts, GuardRemedy::eased_from_rest, share}))
      return ladder.report;
  }
  for (const double share : k_shares_held)
    if (ladder.take_holding({careful, k_eased_parts, GuardRemedy::held, share})) return ladder.report;
  if (ladder.take_broken_off()) return ladder.report;
  if (ladder.take_as_a_whole()) return ladder.report;

  ladder.stand_still();
  guard.cause = ladder.report.finding;
  guard.frozen = ++guard.failures >= k_guard_failures;
  if (guard.frozen) {
    const LoadSize load_now = size_of(loads, state);
    guard.dead_load = load_now.dead;
    guard.pull = load_now.pull;
  }
  ladder.report.remedy = guard.frozen ? GuardRemedy::frozen : GuardRemedy::restored;
  return ladder.report;
}

}  // namespace argil::fem
