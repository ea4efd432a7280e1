#include "fem/contact/contact.h"

#include <algorithm>
#include <cmath>

#include "fem/parallel.h"
#include "fem/solvers/stencil_product.h"

namespace argil::fem {

namespace {

double size_of(const Eigen::Vector3d& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double along(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Energy of a spring that gives way at a force: Huber's function of its length.
double friction_energy(double stiffness, double length, double limit) {
  if (stiffness * length <= limit) return 0.5 * stiffness * length * length;
  return limit * (length - 0.5 * limit / stiffness);
}

}  // namespace

bool Touch::slips() const {
  return stiffness * size_of(stretch) > limit;
}

Eigen::Vector3d Touch::force() const {
  Eigen::Vector3d result = stiffness * depth * normal;
  if (limit > 0) result -= (slips() ? limit / size_of(stretch) : stiffness) * stretch;
  return result;
}

ContactStep::ContactStep(const Contact& contact, const BodyState& begin, double time)
    : contact_(&contact), begin_(&begin) {
  for (const Obstacle& obstacle : contact.obstacles) {
    now_.push_back(pose_at(obstacle, time));
    before_.push_back(pose_at(obstacle, begin.time));
  }
  multiply(contact.surface->rows, begin.positions, begin_points_);
  limits_.assign(contact.obstacles.size() * contact.surface->point_count(), 0.0);
}

Touch ContactStep::touch(std::size_t obstacle, std::size_t point, const Eigen::Vector3d& x,
                         const SignedDistance& own) const {
  const Obstacle& of = contact_->obstacles[obstacle];
  const ContactSurface& surface = *contact_->surface;
  Touch result;
  result.obstacle = static_cast<std::uint32_t>(obstacle);
  result.point = static_cast<std::uint32_t>(point);
  result.position = x;
  result.normal = now_[obstacle].rotation * own.normal;
  result.depth = -own.distance;
  result.stiffness = (of.stiffness > 0 ? of.stiffness : surface.stiffness[point]) * surface.areas[point];
  result.limit = of.friction * result.stiffness * result.depth;
  if (of.friction == 0) return result;
  const auto grip = std::lower_bound(begin_->grips.begin(), begin_->grips.end(), std::pair{of.id, result.point},
                                     [](const ContactGrip& g, const auto& key) {
                                       return std::pair{g.obstacle, g.point} < key;
                                     });
  const bool held = grip != begin_->grips.end() && grip->obstacle == of.id && grip->point == result.point;
  const Eigen::Vector3d anchor =
      held ? grip->anchor
           : before_[obstacle].own(Eigen::Vector3d(begin_points_.col(static_cast<Eigen::Index>(point))));
  const Eigen::Vector3d away = x - now_[obstacle].world(anchor);
  result.stretch = away - along(away, result.normal) * result.normal;
  return result;
}

void ContactStep::set_state(const Eigen::Matrix3Xd& positions) {
  const std::size_t points = contact_->surface->point_count();
  Eigen::Matrix3Xd x;
  multiply(contact_->surface->rows, positions, x);
  std::vector<std::uint8_t> touching(limits_.size());
  for (std::size_t o = 0; o < now_.size(); ++o)
    parallel_for(points, 1024, [&](std::size_t i) {
      const Eigen::Vector3d at = x.col(static_cast<Eigen::Index>(i));
      const SignedDistance own = signed_distance(contact_->obstacles[o], now_[o].own(at));
      touching[o * points + i] = own.distance < 0 ? 1 : 0;
    });
  touches_.clear();
  std::fill(limits_.begin(), limits_.end(), 0.0);
  for (std::size_t k = 0; k < touching.size(); ++k) {
    if (!touching[k]) continue;
    const std::size_t o = k / points, i = k % points;
    const Eigen::Vector3d at = x.col(static_cast<Eigen::Index>(i));
    touches_.push_back(touch(o, i, at, signed_distance(contact_->obstacles[o], now_[o].own(at))));
    limits_[k] = touches_.back().limit;
  }
}

void ContactStep::add_forces(Eigen::Matrix3Xd& forces) const {
  for (const Touch& t : touches_) {
    const Eigen::Vector3d force = t.force();
    const subdiv::StencilRow row = contact_->surface->rows.row(t.point);
    for (std::size_t e = 0; e < row.columns.size(); ++e)
      forces.col(static_cast<Eigen::Index>(row.columns[e])) += row.weights[e] * force;
  }
}

void ContactStep::add_product(const Eigen::Matrix3Xd& direction, Eigen::Matrix3Xd& result) const {
  for (const Touch& t : touches_) {
    const subdiv::StencilRow row = contact_->surface->rows.row(t.point);
    Eigen::Vector3d d = Eigen::Vector3d::Zero();
    for (std::size_t e = 0; e < row.columns.size(); ++e)
      d += row.weights[e] * direction.col(static_cast<Eigen::Index>(row.columns[e]));
    const double inwards = along(d, t.normal);
    Eigen::Vector3d force = t.stiffness * inwards * t.normal;
    if (t.limit > 0) {
      Eigen::Vector3d sideways = d - inwards * t.normal;
      double stiffness = t.stiffness;
      if (t.slips()) {
        // The force keeps its size: it changes as it turns with the stretch.
        const double length = size_of(t.stretch);
        sideways -= along(sideways, t.stretch) / (length * length) * t.stretch;
        stiffness = t.limit / length;
      }
      force += stiffness * sideways;
    }
    for (std::size_t e = 0; e < row.columns.size(); ++e)
      result.col(static_cast<Eigen::Index>(row.columns[e])) += row.weights[e] * force;
  }
}

Eigen::VectorXd ContactStep::diagonal() const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(begin_->positions.cols());
  for (const Touch& t : touches_) {
    const subdiv::StencilRow row = contact_->surface->rows.row(t.point);
    for (std::size_t e = 0; e < row.columns.size(); ++e)
      result[static_cast<Eigen::Index>(row.columns[e])] += t.stiffness * row.weights[e] * row.weights[e];
  }
  return result;
}

double ContactStep::energy(const Eigen::Matrix3Xd& positions) const {
  const std::size_t points = contact_->surface->point_count();
  Eigen::Matrix3Xd x;
  multiply(contact_->surface->rows, positions, x);
  return parallel_sum(limits_.size(), 1024, [&](std::size_t k) {
    const std::size_t o = k / points, i = k % points;
    const Eigen::Vector3d at = x.col(static_cast<Eigen::Index>(i));
    const SignedDistance own = signed_distance(contact_->obstacles[o], now_[o].own(at));
    double sum = 0;
    if (own.distance < 0) {
      const Touch t = touch(o, i, at, own);
      sum = 0.5 * t.stiffness * t.depth * t.depth;
      if (limits_[k] > 0) sum += friction_energy(t.stiffness, size_of(t.stretch), limits_[k]);
    } else if (limits_[k] > 0) {
      // It has left, but its friction was taken as it was: the energy stays continuous.
      const Touch t = touch(o, i, at, own);
      sum = friction_energy(t.stiffness, size_of(t.stretch), limits_[k]);
    }
    return sum;
  });
}

std::vector<ContactGrip> ContactStep::grips() const {
  std::vector<ContactGrip> result;
  for (const Touch& t : touches_) {
    const Obstacle& of = contact_->obstacles[t.obstacle];
    if (of.friction == 0) continue;
    const double share = t.slips() ? t.limit / (t.stiffness * size_of(t.stretch)) : 1.0;
    result.push_back({of.id, t.point, now_[t.obstacle].own(t.position - share * t.stretch)});
  }
  return result;
}

std::vector<AnchorSpring> ContactStep::springs() const {
  std::vector<AnchorSpring> result;
  for (const Touch& t : touches_) {
    const subdiv::StencilRow row = contact_->surface->rows.row(t.point);
    AnchorSpring spring;
    spring.control_points.assign(row.columns.begin(), row.columns.end());
    spring.weights.assign(row.weights.begin(), row.weights.end());
    spring.target = t.position;
    spring.stiffness = t.stiffness;
    result.push_back(std::move(spring));
  }
  return result;
}

Eigen::Matrix3Xd contact_forces(const Contact& contact, const BodyState& state) {
  ContactStep step(contact, state, state.time);
  step.set_state(state.positions);
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, state.positions.cols());
  step.add_forces(result);
  return result;
}

Wrench contact_wrench(const Contact& contact, const BodyState& state, std::uint32_t id) {
  ContactStep step(contact, state, state.time);
  step.set_state(state.positions);
  Wrench result;
  for (const Touch& t : step.touches()) {
    if (id != 0 && contact.obstacles[t.obstacle].id != id) continue;
    const Eigen::Vector3d force = t.force();
    result.force += force;
    result.moment += t.position.cross(force);
  }
  return result;
}

}  // namespace argil::fem
