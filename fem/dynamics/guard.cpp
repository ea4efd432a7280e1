#include "fem/dynamics/guard.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/parallel.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr int k_substep_rungs[] = {2, 4, 8};
constexpr double k_guard_newton_tolerance = 1e-6;

/// What the last good state is worth, and by which the steps that follow it are judged.
struct Ledger {
  double kinetic = 0, elastic = 0, surplus = 0;
  std::size_t inverted = 0;
  double energy() const { return kinetic + elastic; }
};

double extent(const Eigen::Matrix3Xd& positions) {
  if (positions.cols() == 0) return 0;
  Eigen::Vector3d low = positions.col(0), high = low;
  for (Eigen::Index i = 1; i < positions.cols(); ++i) {
    low = low.cwiseMin(positions.col(i));
    high = high.cwiseMax(positions.col(i));
  }
  return (high - low).norm();
}

/// Work of loads and springs on the way, their forces and targets standing still.
double work(const Loads& loads, const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  double sum = 0;
  if (loads.forces.cols() > 0)
    for (Eigen::Index i = 0; i < to.cols(); ++i) sum += loads.forces.col(i).dot(to.col(i) - from.col(i));
  for (const AnchorSpring& spring : loads.springs)
    sum += 0.5 * spring.stiffness *
           ((held_point(spring, from) - spring.target).squaredNorm() -
            (held_point(spring, to) - spring.target).squaredNorm());
  return sum;
}

/// Of a model without an energy, what it would have were its forces linear in the displacement from the rest shape
/// turned along: −½ f · (x − R X).
double energy_of_forces(const System& system, const Eigen::Matrix3Xd& positions) {
  const Eigen::Matrix3Xd x = nodes(system, positions);
  const Eigen::Matrix3Xd& rest = *system.rest_nodes;
  Eigen::Matrix3Xd forces;
  system.model->forces(x, forces);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), rest_middle = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    middle += x.col(i);
    rest_middle += rest.col(i);
  }
  middle /= static_cast<double>(std::max<Eigen::Index>(1, x.cols()));
  rest_middle /= static_cast<double>(std::max<Eigen::Index>(1, x.cols()));
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    moments += (x.col(i) - middle) * (rest.col(i) - rest_middle).transpose();
  if (!moments.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d signs = Eigen::Matrix3d::Identity();
  signs(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d rotation = svd.matrixU() * signs * svd.matrixV().transpose();
  double sum = 0;
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    sum -= 0.5 * forces.col(i).dot(x.col(i) - middle - rotation * (rest.col(i) - rest_middle));
  return std::abs(sum);
}

class Ladder {
 public:
  Ladder(Integrator& integrator, const Loads& loads, const BodyState& begin, const GuardState& guard,
         double time_step, Clock clock)
      : integrator_(integrator), loads_(loads), begin_(begin), time_step_(time_step), clock_(clock) {
    const Promises promises = integrator.system().model->promises();
    has_energy_ = promises.has_energy;
    counts_inverted_ = promises.inversion_is_error && !integrator.system().blocks.empty();
    const double size = k_guard_negligible * extent(*integrator.system().rest_nodes);
    double mass = 0;
    for (Eigen::Index c = 0; c < integrator.system().mass->outerSize(); ++c)
      for (Eigen::SparseMatrix<double>::InnerIterator it(*integrator.system().mass, c); it; ++it)
        mass += it.value();
    negligible_ = 0.5 * mass * size * size;
    first_ = ledger_of(begin);
    first_.surplus = guard.surplus;
  }

  /// Tries the step in parts; `state`, `surplus` and `report` are set if it is good.
  GuardFinding attempt(const StepOptions& options, int parts, BodyState& state, double& surplus,
                       StepReport& report) {
    BodyState trial = begin_;
    Ledger ledger = first_;
    StepReport sum;
    for (int part = 0; part < parts; ++part) {
      const Eigen::Matrix3Xd from = trial.positions;
      try {
        add(sum, integrator_.step(loads_, trial, time_step_ / parts, options, clock_));
      } catch (const Error& error) {
        if (error.code() != ErrorCode::not_converged) throw;
        return GuardFinding::not_finite;
      }
      const GuardFinding finding = judge(from, trial, ledger);
      if (finding != GuardFinding::none) return finding;
    }
    trial.time = begin_.time + time_step_;
    state = std::move(trial);
    surplus = ledger.surplus;
    report = sum;
    return GuardFinding::none;
  }

 private:
  Ledger ledger_of(const BodyState& state) {
    Ledger result;
    result.kinetic = kinetic_energy(integrator_.system(), state.velocities);
    result.elastic = has_energy_ ? integrator_.elastic_energy(state.positions)
                                 : energy_of_forces(integrator_.system(), state.positions);
    if (counts_inverted_) result.inverted = inverted_points(integrator_.system(), state.positions);
    return result;
  }

  GuardFinding judge(const Eigen::Matrix3Xd& from, const BodyState& to, Ledger& ledger) {
    if (!to.positions.allFinite() || !to.velocities.allFinite()) return GuardFinding::not_finite;
    Ledger next = ledger_of(to);
    if (!std::isfinite(next.energy())) return GuardFinding::not_finite;
    const double gain = next.energy() - ledger.energy() - work(loads_, from, to.positions);
    next.surplus = std::max(0.0, ledger.surplus + gain);
    const double present = std::abs(next.energy());
    const double rounding = k_guard_rounding * (present + std::abs(ledger.energy()));
    if (next.surplus <= rounding) next.surplus = 0;
    if (next.surplus > k_guard_share * present + negligible_ && gain > rounding) return GuardFinding::energy;
    if (counts_inverted_ && next.inverted > ledger.inverted) return GuardFinding::inversion;
    ledger = next;
    return GuardFinding::none;
  }

  static void add(StepReport& sum, const StepReport& report) {
    const StepReport before = sum;
    sum = report;
    sum.newton_iterations += before.newton_iterations;
    sum.linear_iterations += before.linear_iterations;
    sum.ms_forces += before.ms_forces;
    sum.ms_tangent += before.ms_tangent;
    sum.ms_solve += before.ms_solve;
    sum.ms_line_search += before.ms_line_search;
  }

  Integrator& integrator_;
  const Loads& loads_;
  const BodyState& begin_;
  double time_step_;
  Clock clock_;
  bool has_energy_ = true, counts_inverted_ = false;
  double negligible_ = 0;
  Ledger first_;
};

/// The body as it was, at rest and without history.
void stand_still(BodyState& state, double time_step) {
  const double time = state.time + time_step;
  Eigen::Matrix3Xd positions = std::move(state.positions);
  state = BodyState{};
  state.velocities.setZero(3, positions.cols());
  state.positions = std::move(positions);
  state.time = time;
}

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
    case GuardRemedy::restored:
      return "restored";
    case GuardRemedy::frozen:
      return "frozen";
  }
  return "";
}

double kinetic_energy(const System& system, const Eigen::Matrix3Xd& velocities) {
  const Eigen::SparseMatrix<double>& mass = *system.mass;
  return 0.5 * parallel_sum(static_cast<std::size_t>(mass.outerSize()), 256, [&](std::size_t c) {
           const auto column = static_cast<Eigen::Index>(c);
           Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
           for (Eigen::SparseMatrix<double>::InnerIterator it(mass, column); it; ++it)
             momentum += it.value() * velocities.col(it.row());
           return momentum.dot(velocities.col(column));
         });
}

std::size_t inverted_points(const System& system, const Eigen::Matrix3Xd& positions) {
  const Eigen::Matrix3Xd x = nodes(system, positions);
  double count = 0;
  for (const ElementBlock& block : system.blocks) {
    const auto n = static_cast<std::size_t>(block.kind->node_count);
    count += parallel_sum(block.element_count(), 64, [&](std::size_t e) {
      double inverted = 0;
      for (int q = 0; q < block.kind->point_count; ++q) {
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
        const double* gradient = block.kind->gradients.data() + static_cast<std::size_t>(q) * n * 3;
        for (std::size_t a = 0; a < n; ++a, gradient += 3)
          for (int axis = 0; axis < 3; ++axis) jacobian.col(axis) += gradient[axis] * x.col(block.nodes[e * n + a]);
        if (jacobian.determinant() <= 0) inverted += 1;
      }
      return inverted;
    });
  }
  return static_cast<std::size_t>(count);
}

GuardedReport guarded_step(Integrator& integrator, const Loads& loads, BodyState& state, GuardState& guard,
                           double time_step, const StepOptions& options, Clock clock) {
  GuardedReport report;
  if (guard.frozen) {
    stand_still(state, time_step);
    report.remedy = GuardRemedy::frozen;
    report.step.converged = true;
    report.step.preconditioner = PreconditionerKind::none;
    return report;
  }
  const BodyState begin = state;
  Ladder ladder(integrator, loads, begin, guard, time_step, clock);
  const auto attempt = [&](const StepOptions& by, int parts, GuardRemedy remedy) {
    const GuardFinding finding = ladder.attempt(by, parts, state, guard.surplus, report.step);
    if (finding != GuardFinding::none) {
      if (report.finding == GuardFinding::none) report.finding = finding;
      return false;
    }
    report.remedy = remedy;
    report.substeps = parts;
    return true;
  };

  if (attempt(options, 1, GuardRemedy::none)) {
    if (guard.surplus == 0) guard.failures = 0;
    return report;
  }
  for (const int parts : k_substep_rungs)
    if (attempt(options, parts, GuardRemedy::substeps)) return report;
  StepOptions careful = options;
  careful.line_search = true;
  careful.newton_cap = std::max(options.newton_cap, k_guard_newton_cap);
  careful.newton_tolerance = std::min(options.newton_tolerance, k_guard_newton_tolerance);
  if (method_kind(options.method).is_implicit && options.method != Method::semi_implicit &&
      attempt(careful, 1, GuardRemedy::iterations))
    return report;
  careful.method = Method::implicit_euler;
  for (const int parts : {1, 8})
    if (attempt(careful, parts, GuardRemedy::implicit_euler)) return report;

  guard.cause = report.finding;
  guard.frozen = ++guard.failures >= k_guard_failures;
  // What stands still has paid back its motion; what is stored stays on the account.
  guard.surplus = std::max(0.0, guard.surplus - kinetic_energy(integrator.system(), begin.velocities));
  state = begin;
  stand_still(state, time_step);
  report.remedy = guard.frozen ? GuardRemedy::frozen : GuardRemedy::restored;
  return report;
}

}  // namespace argil::fem
