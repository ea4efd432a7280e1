#include "fem/dynamics/integrator_body.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "fem/solvers/stencil_product.h"

namespace argil::fem {

namespace {

bool same_bits(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cols() == b.cols() && a.cols() > 0 &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

}  // namespace

bool same_hold(const std::vector<AnchorSpring>& a, const std::vector<AnchorSpring>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const AnchorSpring& x, const AnchorSpring& y) {
    return x.stiffness == y.stiffness && x.weights == y.weights && x.control_points == y.control_points;
  });
}

bool Integrator::Impl::Key::fits(const Divisors& others, const std::vector<AnchorSpring>& other_springs) const {
  return divisors == others && (without_springs || same_hold(springs, other_springs));
}

void Integrator::Impl::forget_pins() {
  free.clear();
  preconditioner.reset();
  columns.forget();
  mass_factor.reset();
  scheme.reset();
}

void Integrator::Impl::forget_materials() {
  rest.reset();
  viscous_rest.reset();
  viscous.reset();
  contrast = -1;
  forget_values();
  forget_pins();
}

void Integrator::Impl::forget_values() {
  forces_at_.resize(3, 0);
  energy_at_.resize(3, 0);
}

void Integrator::Impl::find_free() {
  if (!free.empty()) return;
  // Every element has mass, so that a control point without any is one that no element depends on.
  free.assign(system.fixed.size(), 0);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    free[i] = !system.fixed[i] && system.mass->coeff(c, c) > 0 ? 1 : 0;
  }
}

ViscousDamping* Integrator::Impl::stiffness_damping() {
  if (!viscous) viscous.emplace(system.blocks, system.rows->row_count());
  return viscous->present() ? &*viscous : nullptr;
}

void Integrator::Impl::prepare(const Divisors& divisors, const std::vector<AnchorSpring>& springs,
                               const Progress& progress) {
  find_free();
  if (preconditioner && key_.fits(divisors, springs)) return;
  columns.forget();
  const auto make_rest = [&](bool with_stiffness) {
    rest = rest_operator(system, with_stiffness, progress.of("reducing the stiffness"));
    viscous_rest.reset();
  };
  SolverInputs inputs{3 * system.rows->column_count, 1, 0};
  if (!rest) make_rest(inputs.unknowns <= k_largest_factor);
  if (contrast < 0) contrast = stiffness_contrast(system);
  inputs.contrast = contrast;
  inputs.stiffness_number = stiffness_number(system, *rest, divisors.mass, free);
  const PreconditionerKind kind = choose_solver(inputs);
  const bool with_stiffness = kind != PreconditionerKind::jacobi;
  if (with_stiffness && rest->stiffness.size() == 0) make_rest(true);
  const bool viscid = divisors.damping > 0 && stiffness_damping() != nullptr;
  if (viscid && !viscous_rest)
    viscous_rest = reduce_elements(
        *system.rows, [&](const Tangent::Visit& visit) { viscous->element_matrices(visit); },
        rest->stiffness.size() > 0);
  progress.at(1);  // the last word: what follows belongs together
  if (divisors.mass > 0) {
    inertia = *system.mass / divisors.mass;
    if (system.damping) inertia += *system.damping / divisors.damping;
  } else {
    inertia.resize(0, 0);
  }
  if (viscid) {
    RestOperator sum = *rest;
    add_scaled(sum, *viscous_rest, 1 / divisors.damping);
    preconditioner = make_preconditioner(kind, sum, inertia, springs, free);
  } else {
    preconditioner = make_preconditioner(kind, *rest, inertia, springs, free);
  }
  key_ = {divisors, springs, preconditioner->kind() == PreconditionerKind::supernodal};
}

const MassFactor& Integrator::Impl::factored_mass(double damping_share) {
  find_free();
  const bool has_matrix = system.damping && system.damping->nonZeros() > 0;
  if (!has_matrix && damping_rate == 0) damping_share = 0;
  const double rate = damping_share > 0 ? damping_rate : 0;
  if (mass_factor && mass_share == damping_share && mass_rate == rate) return *mass_factor;
  if (damping_share > 0) {
    Eigen::SparseMatrix<double> sum = *system.mass;
    if (rate > 0) sum *= 1 + damping_share * rate;
    if (has_matrix) sum += damping_share * *system.damping;
    mass_factor = std::make_unique<MassFactor>(sum, free);
  } else {
    mass_factor = std::make_unique<MassFactor>(*system.mass, free);
  }
  mass_share = damping_share;
  mass_rate = rate;
  return *mass_factor;
}

Potential Integrator::Impl::potential(const std::vector<AnchorSpring>& springs) const {
  Potential result;
  result.model = system.model;
  result.rest = &*rest;
  result.inertia = &inertia;
  result.springs = &springs;
  result.free = &free;
  return result;
}

void Integrator::Impl::set_viscosity(Potential& potential, const Eigen::Matrix3Xd& positions, double divisor) {
  if (!stiffness_damping()) return;
  Eigen::Matrix3Xd x;
  multiply(*system.rows, positions, x);
  viscous->set_state(x);
  potential.viscous = &*viscous;
  potential.viscous_coefficient = 1 / divisor;
}

Eigen::Matrix3Xd Integrator::Impl::viscous_product(const Eigen::Matrix3Xd& velocities) const {
  Eigen::Matrix3Xd v, product, result;
  multiply(*system.rows, velocities, v);
  viscous->product(v, product);
  multiply(*system.rows_transposed, product, result);
  return result;
}

Eigen::Matrix3Xd Integrator::Impl::load_forces(const Loads& loads) const {
  return loads.forces.cols() > 0 ? loads.forces : Eigen::Matrix3Xd(Eigen::Matrix3Xd::Zero(3, size()));
}

Eigen::Matrix3Xd Integrator::Impl::velocity_forces(const BodyState& state) const {
  Eigen::Matrix3Xd x, v, node_forces, result;
  multiply(*system.rows, state.positions, x);
  multiply(*system.rows, state.velocities, v);
  system.model->velocity_forces(x, v, node_forces);
  multiply(*system.rows_transposed, node_forces, result);
  return result;
}

const Eigen::Matrix3Xd& Integrator::Impl::elastic_forces(const Eigen::Matrix3Xd& positions) {
  if (same_bits(positions, forces_at_)) return elastic_forces_;
  Eigen::Matrix3Xd x, node_forces;
  multiply(*system.rows, positions, x);
  system.model->forces(x, node_forces);
  multiply(*system.rows_transposed, node_forces, elastic_forces_);
  forces_at_ = positions;
  return elastic_forces_;
}

double Integrator::Impl::elastic_energy(const Eigen::Matrix3Xd& positions) {
  if (same_bits(positions, energy_at_)) return elastic_energy_;
  Eigen::Matrix3Xd x;
  multiply(*system.rows, positions, x);
  elastic_energy_ = system.model->energy(x);
  energy_at_ = positions;
  return elastic_energy_;
}

Eigen::Matrix3Xd Integrator::Impl::forces(const Loads& loads, const BodyState& begin, double time,
                                          const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& velocities) {
  Eigen::Matrix3Xd result = elastic_forces(positions), x, v, node_forces, damping_forces;
  if (loads.forces.cols() > 0) result += loads.forces;
  add_spring_forces(loads.springs, positions, result);
  if (std::optional<ContactStep> contact = contact_step(loads, begin, time)) {
    contact->set_state(positions);
    contact->add_forces(result);
  }
  multiply(*system.rows, positions, x);
  multiply(*system.rows, velocities, v);
  system.model->velocity_forces(x, v, node_forces);
  if (ViscousDamping* damping = stiffness_damping()) {
    Eigen::Matrix3Xd product;
    damping->set_state(x);
    damping->product(v, product);
    node_forces -= product;
  }
  multiply(*system.rows_transposed, node_forces, damping_forces);
  result += damping_forces;
  return result;
}

Eigen::Matrix3Xd Integrator::Impl::with_mass_damping(Eigen::Matrix3Xd forces,
                                                     const Eigen::Matrix3Xd& velocities) const {
  if (system.damping && system.damping->nonZeros() > 0) forces -= velocities * *system.damping;
  if (damping_rate > 0) forces -= damping_rate * (velocities * *system.mass);
  return forces;
}

NewtonOptions newton_options(const StepOptions& options) {
  NewtonOptions newton;
  newton.cap = options.newton_cap;
  newton.tolerance = options.newton_tolerance;
  newton.line_search = options.line_search;
  newton.linear_tolerance = options.linear_tolerance;
  newton.linear_cap = options.linear_cap;
  return newton;
}

std::optional<ContactStep> contact_step(const Loads& loads, const BodyState& begin, double time) {
  if (!loads.contact || loads.contact->obstacles.empty()) return std::nullopt;
  return std::optional<ContactStep>(std::in_place, *loads.contact, begin, time);
}

std::vector<ContactGrip> grips_at(std::optional<ContactStep>& contact, const Eigen::Matrix3Xd& positions) {
  if (!contact) return {};
  contact->set_state(positions);
  return contact->grips();
}

void advance(BodyState& state, Eigen::Matrix3Xd positions, Eigen::Matrix3Xd velocities, double h) {
  BodyState next;
  next.positions = std::move(positions);
  next.velocities = std::move(velocities);
  next.previous_positions = std::move(state.positions);
  next.previous_velocities = std::move(state.velocities);
  next.previous_step = h;
  next.time = state.time + h;
  state = std::move(next);
}

void clear_held(const std::vector<std::uint8_t>& free, Eigen::Matrix3Xd& values) {
  for (std::size_t i = 0; i < free.size(); ++i)
    if (!free[i]) values.col(static_cast<Eigen::Index>(i)).setZero();
}

}  // namespace argil::fem
