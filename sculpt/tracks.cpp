#include "sculpt/tracks.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "sculpt/hash.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

constexpr std::array k_interpolations{Interpolation::smooth, Interpolation::linear, Interpolation::step};

/// The place of the first key that is not before the time.
std::size_t first_not_before(const Track& track, double time) {
  const auto found = std::lower_bound(track.times.begin(), track.times.end(), time - k_same_time);
  return static_cast<std::size_t>(found - track.times.begin());
}

/// Between two keys: the place of the first, and how far it is from there to the second, in (0, 1].
struct Place {
  Eigen::Index key = 0;
  double length = 0, share = 0;
};

Place place_of(const Track& track, std::size_t next, double time) {
  const double from = track.times[next - 1], to = track.times[next];
  return {static_cast<Eigen::Index>(next) - 1, to - from, std::clamp((time - from) / (to - from), 0.0, 1.0)};
}

double slope_at(const Track& track, Eigen::Index component, Eigen::Index key) {
  const Eigen::Index last = track.values.cols() - 1;
  if (key == 0 || key == last) return 0;
  const auto k = static_cast<std::size_t>(key);
  const double before = track.times[k] - track.times[k - 1], after = track.times[k + 1] - track.times[k];
  const double a = (track.values(component, key) - track.values(component, key - 1)) / before;
  const double b = (track.values(component, key + 1) - track.values(component, key)) / after;
  if (!(a * b > 0)) return 0;
  const double wa = 2 * after + before, wb = after + 2 * before;
  return (wa + wb) / (wa / a + wb / b);
}

}  // namespace

const char* word(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::smooth:
      return "smooth";
    case Interpolation::linear:
      return "linear";
    case Interpolation::step:
      return "step";
  }
  return "";
}

Interpolation interpolation_by_word(const std::string& name) {
  for (const Interpolation interpolation : k_interpolations)
    if (name == word(interpolation)) return interpolation;
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not a way between keys: smooth, linear or step", name));
}

bool Track::has_key(double time) const {
  const std::size_t at = first_not_before(*this, time);
  return at < times.size() && times[at] <= time + k_same_time;
}

void set_key(Track& track, double time, const Eigen::VectorXd& value) {
  assert(track.empty() || track.values.rows() == value.size());
  const std::size_t at = first_not_before(track, time);
  const auto column = static_cast<Eigen::Index>(at);
  if (!track.has_key(time)) {
    Eigen::MatrixXd values(value.size(), track.values.cols() + 1);
    values.leftCols(column) = track.values.leftCols(column);
    values.rightCols(track.values.cols() - column) = track.values.rightCols(track.values.cols() - column);
    track.values = std::move(values);
    track.times.insert(track.times.begin() + static_cast<std::ptrdiff_t>(at), time);
  }
  track.values.col(column) = value;
}

bool remove_key(Track& track, double time) {
  if (!track.has_key(time)) return false;
  const std::size_t at = first_not_before(track, time);
  const auto column = static_cast<Eigen::Index>(at);
  const Eigen::Index after = track.values.cols() - column - 1;
  Eigen::MatrixXd values(track.values.rows(), track.values.cols() - 1);
  values.leftCols(column) = track.values.leftCols(column);
  values.rightCols(after) = track.values.rightCols(after);
  track.values = std::move(values);
  track.times.erase(track.times.begin() + static_cast<std::ptrdiff_t>(at));
  return true;
}

Eigen::VectorXd value_at(const Track& track, double time) {
  assert(!track.empty());
  const std::size_t next = first_not_before(track, time);
  if (next == track.times.size()) return track.values.col(track.values.cols() - 1);
  const auto column = static_cast<Eigen::Index>(next);
  if (next == 0 || track.times[next] <= time + k_same_time) return track.values.col(column);
  const Place at = place_of(track, next, time);
  const double s = at.share;
  if (track.interpolation == Interpolation::step) return track.values.col(at.key);
  Eigen::VectorXd result = (1 - s) * track.values.col(at.key) + s * track.values.col(at.key + 1);
  if (track.interpolation == Interpolation::linear) return result;
  for (Eigen::Index c = 0; c < result.size(); ++c) {
    const double from = track.values(c, at.key), to = track.values(c, at.key + 1);
    result[c] =
        from + (to - from) * s * s * (3 - 2 * s) +
        at.length * s * (1 - s) * ((1 - s) * slope_at(track, c, at.key) - s * slope_at(track, c, at.key + 1));
  }
  return result;
}

Eigen::VectorXd rate_at(const Track& track, double time) {
  assert(!track.empty());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(track.values.rows());
  const std::size_t next = first_not_before(track, time);
  if (next == 0 || next == track.times.size() || track.interpolation == Interpolation::step) return none;
  const Place at = place_of(track, next, time);
  Eigen::VectorXd result = (track.values.col(at.key + 1) - track.values.col(at.key)) / at.length;
  if (track.interpolation == Interpolation::linear) return result;
  const double s = at.share;
  for (Eigen::Index c = 0; c < result.size(); ++c)
    result[c] = 6 * s * (1 - s) * result[c] + (1 - s) * (1 - 3 * s) * slope_at(track, c, at.key) +
                s * (3 * s - 2) * slope_at(track, c, at.key + 1);
  return result;
}

void add_to_hash(const Track& track, Hash& hash) {
  hash.add(std::string_view(word(track.interpolation)));
  hash.add(std::span<const double>(track.times));
  hash.add(std::span<const double>(track.values.data(), static_cast<std::size_t>(track.values.size())));
}

RigidMotion RigidMotion::operator*(const RigidMotion& first) const {
  return {rotation * first.rotation, rotation * first.translation + translation};
}

RigidMotion RigidMotion::inverse() const {
  return {rotation.transpose(), -(rotation.transpose() * translation)};
}

RigidMotion motion_at(const Track& track, const Eigen::Vector3d& pivot, double time) {
  const Eigen::VectorXd value = value_at(track, time);
  const Eigen::Vector3d way = value.head<3>(), turn = value.tail<3>();
  RigidMotion motion;
  const double angle = turn.norm();
  if (angle > 0) motion.rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  motion.translation = pivot + way - motion.rotation * pivot;
  return motion;
}

Eigen::Vector3d angular_velocity_at(const Track& track, double time) {
  const Eigen::Vector3d turn = value_at(track, time).tail<3>(), turning = rate_at(track, time).tail<3>();
  // The spatial angular velocity of a rotation vector: its left Jacobian, by series where it is small.
  const double angle = turn.norm(), square = angle * angle;
  const double a = angle > 1e-4 ? (1 - std::cos(angle)) / square : 0.5 - square / 24;
  const double b = angle > 1e-4 ? (angle - std::sin(angle)) / (square * angle) : 1.0 / 6 - square / 120;
  return turning + a * turn.cross(turning) + b * turn.cross(turn.cross(turning));
}

Eigen::Vector3d velocity_at(const Track& track, const Eigen::Vector3d& pivot, double time,
                            const Eigen::Vector3d& point) {
  const Eigen::Vector3d way = value_at(track, time).head<3>(), speed = rate_at(track, time).head<3>();
  return speed + angular_velocity_at(track, time).cross(point - pivot - way);
}

}  // namespace argil::sculpt
