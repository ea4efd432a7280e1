#pragma once
// Values over time by keys: a track says what a force, gravity, the place of a pin or the pose of an obstacle is at
// a time. Before the first key and after the last it keeps their values. Smooth tracks are the monotone cubics of
// Fritsch and Butland (1984), level at both ends and at turning points: once differentiable, never beyond the keys
// about them.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace argil::sculpt {

class Hash;

enum class Interpolation { smooth, linear, step };
[[nodiscard]] const char* word(Interpolation interpolation);
/// @throws Error (not_found) that lists the words.
[[nodiscard]] Interpolation interpolation_by_word(const std::string& word);

/// Times that differ by less are one: the clock of a simulation is a sum of steps.
inline constexpr double k_same_time = 1e-9;  // [s]

struct Track {
  Interpolation interpolation = Interpolation::smooth;
  std::vector<double> times;  // ascending [s]
  Eigen::MatrixXd values;     // components x keys

  [[nodiscard]] bool empty() const { return times.empty(); }
  [[nodiscard]] bool has_key(double time) const;
};

/// Adds a key, or gives the one at that time another value. All keys of a track have as many components.
void set_key(Track& track, double time, const Eigen::VectorXd& value);
/// False if there is none.
bool remove_key(Track& track, double time);
void add_to_hash(const Track& track, Hash& hash);

/// The value at a time, and how fast it changes on the way there (from the left; of a step: 0). The track has keys.
/// Cost O(log keys).
[[nodiscard]] Eigen::VectorXd value_at(const Track& track, double time);
[[nodiscard]] Eigen::VectorXd rate_at(const Track& track, double time);

/// x ↦ rotation · x + translation.
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  [[nodiscard]] RigidMotion operator*(const RigidMotion& first) const;
  [[nodiscard]] RigidMotion inverse() const;
};

/// Of a track of 6 components, the way of the pivot [m] and the turn about it as a rotation vector [rad]: a turn
/// about one axis passes through every angle between two keys, several times round if it says so.
[[nodiscard]] RigidMotion motion_at(const Track& track, const Eigen::Vector3d& pivot, double time);
/// Of that turn, in the world [rad/s].
[[nodiscard]] Eigen::Vector3d angular_velocity_at(const Track& track, double time);
/// Velocity [m/s] of the point of the moving body that is at `point` then.
[[nodiscard]] Eigen::Vector3d velocity_at(const Track& track, const Eigen::Vector3d& pivot, double time,
                                          const Eigen::Vector3d& point);

}  // namespace argil::sculpt
