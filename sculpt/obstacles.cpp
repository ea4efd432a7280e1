#include "sculpt/obstacles.h"

#include <fmt/format.h>

#include <algorithm>

#include "sculpt/hash.h"

namespace argil::sculpt {

namespace {

std::string text_of(const Eigen::Vector3d& v) {
  // Rounding of a turn is not worth a reader's time, nor is a zero's sign.
  const auto shown = [](double value) { return std::abs(value) < 1e-12 ? 0.0 : value; };
  return fmt::format("{:.6g} {:.6g} {:.6g}", shown(v.x()), shown(v.y()), shown(v.z()));
}

std::vector<NamedObstacle> obstacles_of(const State& state) {
  return state.obstacles ? *state.obstacles : std::vector<NamedObstacle>{};
}

void take(State& state, std::vector<NamedObstacle> obstacles) {
  state.obstacles =
      obstacles.empty() ? nullptr : std::make_shared<std::vector<NamedObstacle>>(std::move(obstacles));
}

void let_go(State& state, std::uint32_t id) {
  if (std::ranges::none_of(state.motion->grips, [&](const auto& grip) { return grip.obstacle == id; })) return;
  auto motion = std::make_shared<fem::BodyState>(*state.motion);
  std::erase_if(motion->grips, [&](const auto& grip) { return grip.obstacle == id; });
  state.motion = motion;
}

}  // namespace

fem::Obstacle standing_obstacle(const NamedObstacle& obstacle, double time) {
  fem::Obstacle body = obstacle.body;
  body.time = time;
  if (obstacle.track.empty()) return body;
  const RigidMotion motion = motion_at(obstacle.track, obstacle.pivot, time);
  body.position = motion * body.position;
  body.orientation = (Eigen::Quaterniond(motion.rotation) * body.orientation).normalized();
  return body;
}

namespace {

/// Moves at the mean speed of the way that it has come since `begin`, so that it was where it was then; without one
/// at the speed that it comes with.
fem::Obstacle moving_obstacle(const NamedObstacle& obstacle, double begin, double time) {
  fem::Obstacle body = standing_obstacle(obstacle, time);
  if (obstacle.track.empty()) return body;
  const double length = time - begin;
  if (length > k_same_time) {
    const fem::Obstacle before = standing_obstacle(obstacle, begin);
    const Eigen::AngleAxisd turn(body.orientation * before.orientation.conjugate());
    body.velocity = (body.position - before.position) / length;
    body.angular_velocity = turn.angle() / length * turn.axis();
  } else {
    body.velocity = velocity_at(obstacle.track, obstacle.pivot, time, body.position);
    body.angular_velocity = angular_velocity_at(obstacle.track, time);
  }
  return body;
}

}  // namespace

std::vector<fem::Obstacle> moving_obstacles(const State& state, double time) {
  std::vector<fem::Obstacle> result;
  if (!state.obstacles) return result;
  for (const NamedObstacle& obstacle : *state.obstacles) {
    result.push_back(moving_obstacle(obstacle, state.motion->time, time));
  }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return result;
}

std::shared_ptr<const fem::Contact> contact_at(const Document& document, double time) {
  std::vector<fem::Obstacle> obstacles = moving_obstacles(document.state(), time);
  if (obstacles.empty()) return nullptr;
  auto contact = std::make_shared<fem::Contact>();
  contact->surface = document.contact_surface();
  contact->obstacles = std::move(obstacles);
  return contact;
}

fem::Loads standing_loads(const Document& document) {
  fem::Loads loads = document.loads();
  const fem::BodyState& motion = *document.state().motion;
  const auto contact = contact_at(document, motion.time);
  if (!contact) return loads;
  if (loads.forces.cols() == 0) loads.forces.setZero(3, motion.positions.cols());
  loads.forces += fem::contact_forces(*contact, motion);
  return loads;
}

const NamedObstacle* find_obstacle(const State& state, const std::string& name) {
  if (!state.obstacles) return nullptr;
  for (const NamedObstacle& obstacle : *state.obstacles)
    if (obstacle.name == name) return &obstacle;
  return nullptr;
}

void put_obstacle(State& state, NamedObstacle obstacle) {
  std::vector<NamedObstacle> obstacles = obstacles_of(state);
  std::uint32_t next = 1;
  for (const NamedObstacle& other : obstacles) next = std::max(next, other.body.id + 1);
  for (NamedObstacle& other : obstacles) {
    if (other.name != obstacle.name) continue;
    let_go(state, other.body.id);
    obstacle.body.id = other.body.id;
    other = std::move(obstacle);
    take(state, std::move(obstacles));
    return;
  }
  obstacle.body.id = next;
  obstacles.push_back(std::move(obstacle));
  take(state, std::move(obstacles));
}

void remove_obstacle(State& state, const std::string& name) {
  std::vector<NamedObstacle> obstacles = obstacles_of(state);
  for (const NamedObstacle& obstacle : obstacles)
    if (obstacle.name == name) let_go(state, obstacle.body.id);
  std::erase_if(obstacles, [&](const NamedObstacle& obstacle) { return obstacle.name == name; });
  take(state, std::move(obstacles));
}

void drop_grips(State& state) {
  if (state.motion->grips.empty()) return;
  auto motion = std::make_shared<fem::BodyState>(*state.motion);
  motion->grips.clear();
  state.motion = motion;
}

std::string description(const NamedObstacle& obstacle) {
  const fem::Obstacle& body = obstacle.body;
  const fem::ObstaclePose pose = fem::pose_at(body, body.time);
  std::string text = fmt::format("{}: {} ", obstacle.name, fem::word(body.shape));
  switch (body.shape) {
    case fem::ObstacleShape::plane:
      text += fmt::format("at {} m, normal {}", text_of(body.position), text_of(pose.rotation.col(2)));
      break;
    case fem::ObstacleShape::sphere:
      text += fmt::format("at {} m, radius {:.6g} m", text_of(body.position), body.size[0]);
      break;
    case fem::ObstacleShape::box:
      text += fmt::format("at {} m, size {} m", text_of(body.position), text_of(2 * body.size));
      break;
    case fem::ObstacleShape::capsule: {
      const Eigen::Vector3d half = body.size[1] * pose.rotation.col(2);
      text += fmt::format("from {} to {} m, radius {:.6g} m", text_of(body.position - half),
                          text_of(body.position + half), body.size[0]);
      break;
    }
  }
  text += fmt::format(", friction {:.6g}", body.friction);
  if (!obstacle.track.empty()) text += fmt::format(", {} keys", obstacle.track.times.size());
  if (body.stiffness > 0) text += fmt::format(", stiffness {:.6g} Pa/m", body.stiffness);
  return text;
}

std::vector<std::string> left_out_of_linearisation(const State& state) {
  std::vector<std::string> names;
  if (state.obstacles)
    for (const NamedObstacle& obstacle : *state.obstacles) names.push_back("obstacle " + obstacle.name);
  for (const AppliedPressure& pressure : state.loads->pressures)
    names.push_back(pressure.name.empty() ? "pressure" : "pressure " + pressure.name);
  return names;
}

void hash_obstacles(const std::vector<NamedObstacle>& obstacles, Hash& hash) {
  for (const NamedObstacle& obstacle : obstacles) {
    const fem::Obstacle& body = obstacle.body;
    hash.add(std::string_view(obstacle.name));
    hash.add(std::uint64_t{body.id});
    hash.add(fem::word(body.shape));
    for (const auto* v : {&body.size, &body.position, &body.velocity, &body.angular_velocity})
      hash.add(std::span<const double>(v->data(), 3));
    hash.add(std::span<const double>(body.orientation.coeffs().data(), 4));
    hash.add(body.friction);
    hash.add(body.stiffness);
    if (!obstacle.track.empty()) {
      hash.add(std::span<const double>(obstacle.pivot.data(), 3));
      add_to_hash(obstacle.track, hash);
    }
  }
}

}  // namespace argil::sculpt
