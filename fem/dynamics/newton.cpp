#include "fem/dynamics/newton.h"

#include <cmath>
#include <limits>
#include <optional>

#include "fem/parallel.h"
#include "fem/solvers/pcg.h"
#include "fem/solvers/stencil_product.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr double k_armijo = 1e-4;
constexpr int k_halvings = 24;
constexpr double k_epsilon = std::numeric_limits<double>::epsilon();

double dot(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cwiseProduct(b).sum();
}

/// Adds the time that passes until it dies to a part of the report.
class Stopwatch {
 public:
  Stopwatch(Clock clock, double& milliseconds)
      : clock_(clock), milliseconds_(milliseconds), start_(clock ? clock() : 0) {}
  ~Stopwatch() {
    if (clock_) milliseconds_ += 1e3 * (clock_() - start_);
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  Clock clock_;
  double& milliseconds_;
  double start_;
};

void mask(const std::vector<std::uint8_t>& free, Eigen::Matrix3Xd& values) {
  for (std::size_t i = 0; i < free.size(); ++i)
    if (!free[i]) values.col(static_cast<Eigen::Index>(i)).setZero();
}

/// result += sign · matrix · values, for a symmetric matrix: one column a sum, in parallel.
void add_symmetric_product(const Eigen::SparseMatrix<double>& matrix, const Eigen::Matrix3Xd& values, double sign,
                           Eigen::Matrix3Xd& result) {
  parallel_for(static_cast<std::size_t>(matrix.outerSize()), 256, [&](std::size_t c) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, static_cast<Eigen::Index>(c)); it; ++it)
      sum += it.value() * values.col(it.row());
    result.col(static_cast<Eigen::Index>(c)) += sign * sum;
  });
}

/// result += sign · Aᵀ V A · values / c.
void add_viscous_product(const Potential& potential, const Eigen::Matrix3Xd& values, double sign,
                         Eigen::Matrix3Xd& result) {
  Eigen::Matrix3Xd nodes, node_product, product;
  multiply(potential.rest->rows, values, nodes);
  potential.viscous->product(nodes, node_product);
  multiply(potential.rest->rows_transposed, node_product, product);
  result += (sign * potential.viscous_coefficient) * product;
}

/// Φ(p + length · direction) − Φ(p). The quadratic part is taken exactly, so that it does not cancel.
struct LineFunction {
  double slope = 0;      // of all but the elastic energy
  double curvature = 0;  // likewise
  double start_energy = 0;
  double change(double length, double energy) const {
    return length * slope + 0.5 * length * length * curvature + (energy - start_energy);
  }
};

}  // namespace

void fail_not_finite() {
  throw Error(
      ErrorCode::not_converged,
      "The step met a value that is not finite. Take smaller steps, lower the loads, or look for cells that "
      "are inside out; the body is as it was before the step.");
}

Forces Potential::forces(const Eigen::Matrix3Xd& p) const {
  Forces result;
  Eigen::Matrix3Xd x, node_forces;
  multiply(rest->rows, p, x);
  model->forces(x, node_forces);
  multiply(rest->rows_transposed, node_forces, result.elastic);
  if (contact) {
    contact->set_state(p);
    contact->add_forces(result.elastic);
  }
  result.total = result.elastic + constant_force;
  if (inertia->size() > 0) add_symmetric_product(*inertia, p - anchor, -1.0, result.total);
  if (viscous) add_viscous_product(*this, p - anchor, -1.0, result.total);
  add_spring_forces(*springs, p, result.total);
  double sum = 0;
  for (std::size_t i = 0; i < free->size(); ++i)
    if (!(*free)[i]) sum += result.total.col(static_cast<Eigen::Index>(i)).squaredNorm();
  result.held = std::sqrt(sum);
  mask(*free, result.total);
  return result;
}

double Potential::elastic_energy(const Eigen::Matrix3Xd& p) const {
  Eigen::Matrix3Xd x;
  multiply(rest->rows, p, x);
  return model->energy(x);
}

double Potential::contact_energy(const Eigen::Matrix3Xd& p) const {
  return contact ? contact->energy(p) : 0;
}

void Potential::constant_stiffness_product(const Eigen::Matrix3Xd& direction, Eigen::Matrix3Xd& result) const {
  result.setZero(3, direction.cols());
  if (inertia->size() > 0) add_symmetric_product(*inertia, direction, 1.0, result);
  if (viscous) add_viscous_product(*this, direction, 1.0, result);
  for (const AnchorSpring& spring : *springs) {
    const Eigen::Vector3d force = spring.stiffness * held_point(spring, direction);
    for (std::size_t e = 0; e < spring.control_points.size(); ++e)
      result.col(static_cast<Eigen::Index>(spring.control_points[e])) += spring.weights[e] * force;
  }
}

double Potential::rounding(const Eigen::Matrix3Xd& p) const {
  double sum = 0;
  const Eigen::VectorXd touched = contact ? contact->diagonal() : Eigen::VectorXd::Zero(p.cols());
  for (std::size_t i = 0; i < free->size(); ++i) {
    if (!(*free)[i]) continue;
    const auto c = static_cast<Eigen::Index>(i);
    double diagonal = rest->diagonal[i].diagonal().maxCoeff() + touched[c];
    if (inertia->size() > 0) diagonal += inertia->coeff(c, c);
    sum += p.col(c).squaredNorm() * diagonal * diagonal;
  }
  return 4 * k_epsilon * std::sqrt(sum);
}

namespace {

/// One Newton direction: solves with the tangent at p, projected if need be.
class DirectionSolver {
 public:
  DirectionSolver(const Potential& potential, const Preconditioner& preconditioner, const NewtonOptions& options,
                  StepReport& report, Clock clock)
      : potential_(potential), preconditioner_(preconditioner), options_(options), report_(report), clock_(clock) {}

  /// `part`: the share of the whole that is done.
  const Eigen::Matrix3Xd& operator()(const Eigen::Matrix3Xd& p, const Eigen::Matrix3Xd& force, double part) {
    part_ = part;
    if (options_.full_tangent && solve(p, force, Projection::none)) return direction_;
    static_cast<void>(solve(p, force, Projection::positive_semidefinite));
    return direction_;
  }

 private:
  /// False if the tangent has a direction of negative curvature.
  bool solve(const Eigen::Matrix3Xd& p, const Eigen::Matrix3Xd& force, Projection projection) {
    std::unique_ptr<Tangent> tangent;
    {
      Stopwatch watch(clock_, report_.ms_tangent);
      multiply(potential_.rest->rows, p, node_direction_);
      tangent = potential_.model->tangent(node_direction_, projection);
    }
    Stopwatch watch(clock_, report_.ms_solve);
    std::unique_ptr<Preconditioner> corrected;
    if (potential_.contact && potential_.columns)
      corrected = with_contact(preconditioner_, *potential_.columns, *potential_.contact, p.cols());
    const LinearOutcome linear = pcg(
        [&](const Eigen::Matrix3Xd& d, Eigen::Matrix3Xd& result) {
          multiply(potential_.rest->rows, d, node_direction_);
          tangent->stiffness_product(node_direction_, node_product_);
          multiply(potential_.rest->rows_transposed, node_product_, result);
          potential_.constant_stiffness_product(d, product_);
          result += product_;
          if (potential_.contact) potential_.contact->add_product(d, result);
          mask(*potential_.free, result);
        },
        corrected ? *corrected : preconditioner_, force, direction_, options_.linear_tolerance, options_.linear_cap,
        options_.progress.part(part_, part_ + 0.8 * (1 - part_)));
    report_.linear_iterations += linear.iterations;
    return !linear.negative_curvature;
  }

  const Potential& potential_;
  const Preconditioner& preconditioner_;
  const NewtonOptions& options_;
  StepReport& report_;
  Clock clock_;
  double part_ = 0;
  Eigen::Matrix3Xd direction_, node_direction_, node_product_, product_;
};

}  // namespace

void minimise(const Potential& potential, const Preconditioner& preconditioner, const NewtonOptions& options,
              Eigen::Matrix3Xd& p, StepReport& report, Clock clock) {
  const bool has_energy = potential.model->promises().has_energy;
  DirectionSolver solve(potential, preconditioner, options, report, clock);
  Forces forces;
  std::optional<double> energy;  // at p
  Eigen::Matrix3Xd product;
  {
    Stopwatch watch(clock, report.ms_forces);
    forces = potential.forces(p);
  }
  double residual = forces.total.norm(), done = 0;
  const double first = residual;
  report.preconditioner = preconditioner.kind();
  report.converged = false;
  for (int iteration = 0;; ++iteration) {
    if (!std::isfinite(residual)) fail_not_finite();
    const double load = std::max(potential.constant_force.norm(), forces.held);
    const double reference = options.against_loads && load > 0 ? load : first;
    report.residual = reference > 0 ? residual / reference : 0;
    if (residual <= std::max(options.tolerance * reference, potential.rounding(p))) {
      report.converged = true;
      return;
    }
    if (iteration == options.cap) return;
    ++report.newton_iterations;
    // Of the iterations allowed most are seldom needed: each is half of what is left.
    options.progress.at(done);
    const Eigen::Matrix3Xd& direction = solve(p, forces.total, done);
    done += 0.5 * (1 - done);

    Stopwatch watch(clock, report.ms_line_search);
    const double descent = -dot(forces.total, direction);  // Φ's slope along the direction
    if (!std::isfinite(descent)) fail_not_finite();
    LineFunction line;
    if (has_energy && options.line_search) {
      if (!energy) energy = potential.elastic_energy(p);
      line.start_energy = *energy + potential.contact_energy(p);
      line.slope = descent + dot(forces.elastic, direction);
      potential.constant_stiffness_product(direction, product);
      line.curvature = dot(direction, product);
    }
    Eigen::Matrix3Xd trial;
    Forces trial_forces;
    bool accepted = false;
    double length = 1;
    for (int halving = 0; halving <= k_halvings && !accepted; ++halving, length *= 0.5) {
      trial = p + length * direction;
      if (!options.line_search) {
        accepted = true;
        trial_forces = potential.forces(trial);
      } else if (has_energy) {
        energy = potential.elastic_energy(trial);
        const double stored = *energy + potential.contact_energy(trial);
        const double slack = 64 * k_epsilon * (std::abs(stored) + std::abs(line.start_energy));
        accepted = line.change(length, stored) <= k_armijo * length * descent + slack;
      } else {
        trial_forces = potential.forces(trial);
        accepted = trial_forces.total.norm() <= (1 - k_armijo * length) * residual;
      }
    }
    if (!accepted) return;
    p = trial;
    forces = has_energy && options.line_search ? potential.forces(p) : std::move(trial_forces);
    residual = forces.total.norm();
  }
}

}  // namespace argil::fem
