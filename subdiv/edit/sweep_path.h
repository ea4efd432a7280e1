#pragma once
// The rings of a sweep along a path: where each stands and how it is turned.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace argil::subdiv {

struct Station {
  Eigen::Vector3d at;
  Eigen::Matrix3d
      turn;  // of the plane across the start of the path; at a corner stretched, so that the legs keep their width
  double part = 0;  // of the length of the path
};

/// Stations after the start, as many as steps, the last at the end. Legs get their steps by length, at least one
/// each; along a curve they are equally far apart. @throws Error (bad_input) as `sweep`.
[[nodiscard]] std::vector<Station> stations(const Eigen::Vector3d& start, const Eigen::Vector3d& normal,
                                            std::span<const Eigen::Vector3d> path, bool curve, int steps);

}  // namespace argil::subdiv
