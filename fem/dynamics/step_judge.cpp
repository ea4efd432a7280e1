#include "fem/dynamics/step_judge.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "fem/contact/contact.h"
#include "fem/dynamics/led_points.h"
#include "fem/parallel.h"

namespace argil::fem {

namespace {

double extent(const Eigen::Matrix3Xd& positions) {
  if (positions.cols() == 0) return 0;
  Eigen::Vector3d low = positions.col(0), high = low;
  for (Eigen::Index i = 1; i < positions.cols(); ++i) {
    low = low.cwiseMin(positions.col(i));
    high = high.cwiseMax(positions.col(i));
  }
  return (high - low).norm();
}

/// Work of loads, springs and contact on the way, their forces, targets and obstacles standing still as at its end.
double work(const Loads& loads, const BodyState& begin, const BodyState& end) {
  const Eigen::Matrix3Xd &from = begin.positions, &to = end.positions;
  double sum = dead_work(loads, from, to);
  if (loads.contact) {
    ContactStep contact(*loads.contact, begin, end.time);
    contact.set_state(to);
    sum += contact.energy(from) - contact.energy(to);
  }
  for (const AnchorSpring& spring : loads.springs)
    sum += 0.5 * spring.stiffness *
           ((held_point(spring, from) - spring.target).squaredNorm() -
            (held_point(spring, to) - spring.target).squaredNorm());
  return sum;
}

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

bool is_inverted(const ElementBlock& block, std::size_t element, int point, const Eigen::Matrix3Xd& x) {
  const auto n = static_cast<std::size_t>(block.kind->node_count);
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  const double* gradient = block.kind->gradients.data() + static_cast<std::size_t>(point) * n * 3;
  for (std::size_t a = 0; a < n; ++a, gradient += 3)
    for (int axis = 0; axis < 3; ++axis) jacobian.col(axis) += gradient[axis] * x.col(block.nodes[element * n + a]);
  return jacobian.determinant() <= 0;
}

}  // namespace

StepJudge::StepJudge(Integrator& integrator) : integrator_(&integrator) {
  const System& system = integrator.system();
  const Promises promises = system.model->promises();
  has_energy_ = promises.has_energy;
  counts_inverted_ = promises.inversion_is_error && !system.blocks.empty();
  const double speed = k_guard_negligible * extent(*system.rest_nodes);
  double mass = 0;
  for (Eigen::Index c = 0; c < system.mass->outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(*system.mass, c); it; ++it) mass += it.value();
  negligible_ = 0.5 * mass * speed * speed;
}

Worth StepJudge::worth(const BodyState& state, double surplus) {
  const System& system = integrator_->system();
  Worth result;
  result.kinetic = kinetic_energy(system, state.velocities);
  result.elastic =
      has_energy_ ? integrator_->elastic_energy(state.positions) : energy_of_forces(system, state.positions);
  result.surplus = surplus;
  if (counts_inverted_) result.inverted = inverted_points(system, state.positions);
  return result;
}

GuardFinding StepJudge::judge(const Loads& loads, const BodyState& from, const BodyState& to, double given,
                              Worth& before) {
  if (!to.positions.allFinite() || !to.velocities.allFinite()) return GuardFinding::not_finite;
  Worth next = worth(to, 0);
  if (!std::isfinite(next.energy())) return GuardFinding::not_finite;
  const double gain = next.energy() - before.energy() - work(loads, from, to) -
                      led_work(integrator_->system(), loads, from, to) + given;
  next.surplus = std::max(0.0, before.surplus + gain);
  const double present = std::abs(next.energy());
  const double rounding = k_guard_rounding * (present + std::abs(before.energy()));
  if (next.surplus <= rounding) next.surplus = 0;
  if (next.surplus > k_guard_share * present + negligible_ && gain > rounding) return GuardFinding::energy;
  if (counts_inverted_ && next.inverted > before.inverted) return GuardFinding::inversion;
  before = next;
  return GuardFinding::none;
}

double dead_work(const Loads& loads, const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  double sum = 0;
  for (Eigen::Index i = 0; i < loads.forces.cols(); ++i) sum += loads.forces.col(i).dot(to.col(i) - from.col(i));
  return sum;
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
  for (const ElementBlock& block : system.blocks)
    count += parallel_sum(block.element_count(), 64, [&](std::size_t e) {
      double inverted = 0;
      for (int q = 0; q < block.kind->point_count; ++q)
        if (is_inverted(block, e, q, x)) inverted += 1;
      return inverted;
    });
  return static_cast<std::size_t>(count);
}

void mark_turned(const System& system, const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, double influence,
                 std::vector<std::uint8_t>& marks) {
  const Eigen::Matrix3Xd x_from = nodes(system, from), x_to = nodes(system, to);
  for (const ElementBlock& block : system.blocks)
    for (std::size_t e = 0; e < block.element_count(); ++e) {
      bool turned = false;
      for (int q = 0; q < block.kind->point_count && !turned; ++q)
        turned = is_inverted(block, e, q, x_to) && !is_inverted(block, e, q, x_from);
      if (!turned) continue;
      const auto n = static_cast<std::size_t>(block.kind->node_count);
      std::map<std::uint32_t, double> weights;
      for (std::size_t a = 0; a < n; ++a) {
        const subdiv::StencilRow row = system.rows->row(block.nodes[e * n + a]);
        for (std::size_t k = 0; k < row.columns.size(); ++k) weights[row.columns[k]] += row.weights[k];
      }
      double largest = 0;
      for (const auto& [point, weight] : weights) largest = std::max(largest, weight);
      for (const auto& [point, weight] : weights)
        if (weight > influence * largest) marks[point] = 1;
    }
}

}  // namespace argil::fem
