#include "fem/contact/contact.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fem/parallel.h"
#include "fem/solvers/stencil_product.h"

namespace argil::fem {

namespace {

// Of an obstacle's half thickness in a step: points that are slower are met by its nearest side.
constexpr double k_fast_share = 0.5;
// Times as far as it would go by itself a point is looked ahead for, as loads may drive it on.
constexpr double k_reach = 1.5;

double size_of(const Eigen::Vector3d& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double along(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

bool Touch::slips() const {
  return stiffness * size_of(stretch) > limit;
}

double Touch::friction_energy(double at_limit) const {
  const double length = size_of(stretch);
  if (stiffness * length <= at_limit) return 0.5 * stiffness * length * length;
  return at_limit * (length - 0.5 * at_limit / stiffness);
}

double Touch::slid() const {
  return slips() ? size_of(stretch) - limit / stiffness : 0;
}

Eigen::Vector3d Touch::force() const {
  Eigen::Vector3d result = stiffness * depth * normal;
  if (limit > 0) result -= (slips() ? limit / size_of(stretch) : stiffness) * stretch;
  return result;
}

Eigen::Matrix3d Touch::tangent() const {
  const Eigen::Matrix3d across = normal * normal.transpose();
  Eigen::Matrix3d result = stiffness * across;
  if (!(limit > 0)) return result;
  const Eigen::Matrix3d sideways = Eigen::Matrix3d::Identity() - across;
  if (!slips()) return result + stiffness * sideways;
  // The force keeps its size: it changes as it turns with the stretch.
  const double length = size_of(stretch);
  const Eigen::Vector3d direction = stretch / length;
  return result + limit / length * (sideways - direction * direction.transpose());
}

ContactStep::ContactStep(const Contact& contact, const BodyState& begin, double time)
    : contact_(&contact), begin_(&begin) {
  for (const Obstacle& obstacle : contact.obstacles) {
    now_.push_back(pose_at(obstacle, time));
    before_.push_back(pose_at(obstacle, begin.time));
  }
  multiply(contact.surface->rows, begin.positions, begin_points_);
  limits_.assign(contact.obstacles.size() * contact.surface->point_count(), 0.0);
  length_ = time - begin.time;
  find_entries();
  for (const ContactGrip& grip : begin.grips) {
    const double left = grip.allowed - grip.allowed_rate * length_;
    if (!(left > 0) || grip.point >= contact.surface->point_count()) continue;
    const auto obstacle = std::ranges::find(contact.obstacles, grip.obstacle, &Obstacle::id);
    if (obstacle == contact.obstacles.end()) continue;
    allowed_.resize(limits_.size(), 0.0);
    allowed_[static_cast<std::size_t>(obstacle - contact.obstacles.begin()) * contact.surface->point_count() +
             grip.point] = left;
  }
}

void ContactStep::take_entry(std::size_t obstacle, std::size_t point, const Entry& entry) {
  entry_of_.resize(limits_.size(), 0);
  entries_.push_back(entry);
  entry_of_[obstacle * contact_->surface->point_count() + point] = static_cast<std::uint32_t>(entries_.size());
}

void ContactStep::find_entries() {
  const std::size_t points = contact_->surface->point_count();
  Eigen::Matrix3Xd velocities;
  for (std::size_t o = 0; o < now_.size(); ++o) {
    const Obstacle& obstacle = contact_->obstacles[o];
    const double thickness = largest_depth(obstacle);
    if (!std::isfinite(thickness)) continue;
    if (velocities.size() == 0) multiply(contact_->surface->rows, begin_->velocities, velocities);
    std::vector<std::optional<Entry>> found(points);
    parallel_for(points, 1024, [&](std::size_t i) {
      const auto column = static_cast<Eigen::Index>(i);
      const Eigen::Vector3d x = begin_points_.col(column), v = velocities.col(column);
      const Eigen::Vector3d from = before_[o].own(x);
      const ContactGrip* grip = begin_->grips.empty() ? nullptr : held(o, i);
      if (grip && grip->came_in_fast()) {
        const Entry entry{grip->entry, grip->entry_normal};
        if (signed_distance(obstacle, entry, from).normal == entry.normal &&
            along(entry.at - from, entry.normal) > 0)
          found[i] = entry;
      }
      if (found[i] || !(length_ > 0)) return;
      const Eigen::Vector3d way = now_[o].own(x + length_ * v) - from;
      if (size_of(way) > k_fast_share * thickness) found[i] = first_touch(obstacle, from, from + k_reach * way);
    });
    for (std::size_t i = 0; i < points; ++i)
      if (found[i]) take_entry(o, i, *found[i]);
  }
}

const ContactGrip* ContactStep::held(std::size_t obstacle, std::size_t point) const {
  const std::pair key{contact_->obstacles[obstacle].id, static_cast<std::uint32_t>(point)};
  const auto grip = std::lower_bound(begin_->grips.begin(), begin_->grips.end(), key,
                                     [](const ContactGrip& g, const auto& wanted) {
                                       return std::pair{g.obstacle, g.point} < wanted;
                                     });
  return grip != begin_->grips.end() && std::pair{grip->obstacle, grip->point} == key ? &*grip : nullptr;
}

SignedDistance ContactStep::distance(std::size_t obstacle, std::size_t point, const Eigen::Vector3d& own) const {
  const std::size_t place = obstacle * contact_->surface->point_count() + point;
  const std::uint32_t entry = entry_of_.empty() ? 0 : entry_of_[place];
  SignedDistance result = entry > 0 ? signed_distance(contact_->obstacles[obstacle], entries_[entry - 1], own)
                                    : signed_distance(contact_->obstacles[obstacle], own);
  if (!allowed_.empty()) result.distance += allowed_[place];
  return result;
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
  const ContactGrip* grip = held(obstacle, point);
  Eigen::Vector3d anchor = before_[obstacle].own(begin_points_.col(static_cast<Eigen::Index>(point)));
  if (grip)
    anchor = grip->anchor;
  else if (!entry_of_.empty() && entry_of_[obstacle * surface.point_count() + point] > 0)
    anchor = entries_[entry_of_[obstacle * surface.point_count() + point] - 1].at;
  const Eigen::Vector3d away = x - now_[obstacle].world(anchor);
  result.stretch = away - along(away, result.normal) * result.normal;
  return result;
}

void ContactStep::set_state(const Eigen::Matrix3Xd& positions) {
  const std::size_t points = contact_->surface->point_count();
  multiply(contact_->surface->rows, positions, points_);
  const Eigen::Matrix3Xd& x = points_;
  std::vector<std::uint8_t> touching(limits_.size());
  for (std::size_t o = 0; o < now_.size(); ++o)
    parallel_for(points, 1024, [&](std::size_t i) {
      const Eigen::Vector3d at = x.col(static_cast<Eigen::Index>(i));
      touching[o * points + i] = distance(o, i, now_[o].own(at)).distance < 0 ? 1 : 0;
    });
  touches_.clear();
  std::fill(limits_.begin(), limits_.end(), 0.0);
  for (std::size_t k = 0; k < touching.size(); ++k) {
    if (!touching[k]) continue;
    const std::size_t o = k / points, i = k % points;
    const Eigen::Vector3d at = x.col(static_cast<Eigen::Index>(i));
    touches_.push_back(touch(o, i, at, distance(o, i, now_[o].own(at))));
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
    const Eigen::Vector3d force = t.tangent() * d;
    for (std::size_t e = 0; e < row.columns.size(); ++e)
      result.col(static_cast<Eigen::Index>(row.columns[e])) += row.weights[e] * force;
  }
}

std::vector<std::uint32_t> ContactStep::touched_control_points() const {
  std::vector<std::uint32_t> result;
  for (const Touch& t : touches_) {
    const subdiv::StencilRow row = contact_->surface->rows.row(t.point);
    result.insert(result.end(), row.columns.begin(), row.columns.end());
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Eigen::MatrixXd ContactStep::stiffness(const std::vector<std::uint32_t>& control_points) const {
  const auto size = static_cast<Eigen::Index>(3 * control_points.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  std::vector<Eigen::Index> places;
  for (const Touch& t : touches_) {
    const subdiv::StencilRow row = contact_->surface->rows.row(t.point);
    places.clear();
    for (const std::uint32_t column : row.columns)
      places.push_back(
          3 * (std::lower_bound(control_points.begin(), control_points.end(), column) - control_points.begin()));
    const Eigen::Matrix3d tangent = t.tangent();
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < places.size(); ++j)
        result.block<3, 3>(places[i], places[j]) += row.weights[i] * row.weights[j] * tangent;
  }
  return result;
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
    const SignedDistance own = distance(o, i, now_[o].own(at));
    double sum = 0;
    if (own.distance < 0) {
      const Touch t = touch(o, i, at, own);
      sum = 0.5 * t.stiffness * t.depth * t.depth;
      if (limits_[k] > 0) sum += t.friction_energy(limits_[k]);
    } else if (limits_[k] > 0) {
      // It has left, but its friction was taken as it was: the energy stays continuous.
      const Touch t = touch(o, i, at, own);
      sum = t.friction_energy(limits_[k]);
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
    result.push_back(
        {.obstacle = of.id, .point = t.point, .anchor = now_[t.obstacle].own(t.position - share * t.stretch)});
  }
  const std::vector<ContactGrip> others = grips_without_friction();
  if (others.empty()) return result;
  // A point that both have is one grip.
  std::vector<ContactGrip> all;
  auto friction = result.cbegin();
  for (const ContactGrip& entry : others) {
    const auto before = [](const ContactGrip& a, const ContactGrip& b) {
      return std::pair{a.obstacle, a.point} < std::pair{b.obstacle, b.point};
    };
    while (friction != result.cend() && before(*friction, entry)) all.push_back(*friction++);
    all.push_back(entry);
    if (friction != result.cend() && !before(entry, *friction)) all.back().anchor = (friction++)->anchor;
  }
  all.insert(all.end(), friction, result.cend());
  return all;
}

std::optional<Entry> ContactStep::entry_kept(std::size_t obstacle, std::size_t point,
                                             const Eigen::Vector3d& own) const {
  const Obstacle& of = contact_->obstacles[obstacle];
  const double thickness = largest_depth(of);
  if (!std::isfinite(thickness)) return std::nullopt;
  std::optional<Entry> entry;
  if (const std::uint32_t known =
          entry_of_.empty() ? 0 : entry_of_[obstacle * contact_->surface->point_count() + point]) {
    entry = entries_[known - 1];
  } else {
    // What was driven on so that it could not be foreseen.
    const Eigen::Vector3d from = before_[obstacle].own(begin_points_.col(static_cast<Eigen::Index>(point)));
    if (size_of(own - from) > k_fast_share * thickness) entry = first_touch(of, from, own);
  }
  if (!entry) return entry;
  const SignedDistance nearest = signed_distance(of, own);
  const bool plain = nearest.distance < 0 && -nearest.distance < k_fast_share * thickness &&
                     along(nearest.normal, entry->normal) > 0.5;
  return plain ? std::nullopt : entry;
}

std::vector<ContactGrip> ContactStep::grips_without_friction() const {
  std::vector<ContactGrip> result;
  const std::size_t points = contact_->surface->point_count();
  for (std::size_t o = 0; o < now_.size(); ++o) {
    const Obstacle& of = contact_->obstacles[o];
    if (allowed_.empty() && !std::isfinite(largest_depth(of))) continue;
    for (std::size_t i = 0; i < points; ++i) {
      const Eigen::Vector3d own = now_[o].own(points_.col(static_cast<Eigen::Index>(i)));
      ContactGrip grip{.obstacle = of.id, .point = static_cast<std::uint32_t>(i), .anchor = own};
      if (const std::optional<Entry> entry = entry_kept(o, i, own)) {
        grip.anchor = grip.entry = entry->at;
        grip.entry_normal = entry->normal;
      }
      if (const double left = allowed_.empty() ? 0 : allowed_[o * points + i]; left > 0) {
        grip.allowed = std::clamp(-signed_distance(of, own).distance, 0.0, left);
        grip.allowed_rate = held(o, i)->allowed_rate;
      }
      if (grip.came_in_fast() || grip.allowed > 0) result.push_back(grip);
    }
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

}  // namespace argil::fem
