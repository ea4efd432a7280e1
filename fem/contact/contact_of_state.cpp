// Of contact.h: what is measured of a state, outside a step.

#include "fem/contact/contact.h"

#include <algorithm>
#include <utility>

#include "fem/solvers/stencil_product.h"

namespace argil::fem {

namespace {

/// Calls with every point within, and its depth.
template <class Visit>
void visit_within(const Contact& contact, const BodyState& state, std::uint32_t id, const Visit& visit) {
  const auto obstacle = std::ranges::find(contact.obstacles, id, &Obstacle::id);
  if (obstacle == contact.obstacles.end()) return;
  const ObstaclePose pose = pose_at(*obstacle, state.time);
  Eigen::Matrix3Xd x;
  multiply(contact.surface->rows, state.positions, x);
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Eigen::Vector3d own = pose.own(x.col(i));
    const double distance = signed_distance(*obstacle, own).distance;
    if (distance < 0) visit(static_cast<std::uint32_t>(i), own, -distance);
  }
}

}  // namespace

Overlap overlap(const Contact& contact, const BodyState& state, std::uint32_t id) {
  Overlap result;
  visit_within(contact, state, id, [&](std::uint32_t, const Eigen::Vector3d&, double depth) {
    ++result.points;
    result.depth = std::max(result.depth, depth);
  });
  return result;
}

void allow_overlap(const Contact& contact, BodyState& state, std::uint32_t id, double duration) {
  const double rate = overlap(contact, state, id).depth / duration;
  std::erase_if(state.grips, [&](const ContactGrip& grip) { return grip.obstacle == id; });
  visit_within(contact, state, id, [&](std::uint32_t point, const Eigen::Vector3d& own, double depth) {
    ContactGrip grip{.obstacle = id, .point = point, .anchor = own};
    grip.allowed = depth;
    grip.allowed_rate = rate;
    state.grips.push_back(grip);
  });
  std::ranges::stable_sort(state.grips, [](const ContactGrip& a, const ContactGrip& b) {
    return std::pair{a.obstacle, a.point} < std::pair{b.obstacle, b.point};
  });
}

double stored_energy(const Contact& contact, const BodyState& state) {
  ContactStep step(contact, state, state.time);
  step.set_state(state.positions);
  double sum = 0;
  for (const Touch& t : step.touches()) {
    sum += 0.5 * t.stiffness * t.depth * t.depth;
    if (t.limit > 0) sum += t.friction_energy(t.limit);
  }
  return sum;
}

double friction_loss(const Contact& contact, const BodyState& begin, const BodyState& end) {
  ContactStep before(contact, begin, begin.time), step(contact, begin, end.time);
  before.set_state(begin.positions);
  step.set_state(end.positions);
  const auto key = [](const Touch& t) { return std::pair{t.obstacle, t.point}; };
  double sum = 0;
  auto still = step.touches().begin();
  for (const Touch& t : before.touches()) {
    if (!(t.limit > 0)) continue;
    while (still != step.touches().end() && key(*still) < key(t)) ++still;
    if (still == step.touches().end() || key(*still) != key(t)) sum += t.friction_energy(t.limit);
  }
  for (const Touch& t : step.touches())
    if (t.limit > 0) sum += t.limit * t.slid();
  return sum;
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
