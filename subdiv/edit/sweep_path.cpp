#include "subdiv/edit/sweep_path.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "subdiv/error.h"

namespace argil::subdiv {

namespace {

using Points = std::vector<Eigen::Vector3d>;

// A place on the path with the directions of the path before and after it.
struct Waypoint {
  Eigen::Vector3d at, before, after;
  double length;  // from the start
};

constexpr double k_straight_back = 1e-6;  // sine of half the angle between the legs
constexpr double k_longest_mitre = 4;

Eigen::Matrix3d rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

// Across a corner the plane is the one between the legs, and what was a circle on a leg is an ellipse there.
Eigen::Matrix3d mitre(const Waypoint& w) {
  const Eigen::Vector3d outward = w.before - w.after;
  if (outward.norm() < 1e-12) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d b = outward.normalized();
  const double cosine = (w.before + w.after).norm() / 2;
  return Eigen::Matrix3d::Identity() + (std::min(1 / cosine, k_longest_mitre) - 1) * b * b.transpose();
}

std::vector<Waypoint> along_legs(const Points& points, int steps) {
  const std::size_t legs = points.size() - 1;
  if (static_cast<std::size_t>(steps) < legs)
    throw Error(ErrorCode::bad_input,
                fmt::format("the path has {} legs, and there are only {} steps; give at least {} steps, or `curve`",
                            legs, steps, legs));
  std::vector<int> count(legs, 1);
  const auto step_length = [&](std::size_t leg) { return (points[leg + 1] - points[leg]).norm() / count[leg]; };
  for (int spare = steps - static_cast<int>(legs); spare > 0; --spare) {
    std::size_t longest = 0;
    for (std::size_t leg = 1; leg < legs; ++leg)
      if (step_length(leg) > step_length(longest)) longest = leg;
    ++count[longest];
  }
  std::vector<Waypoint> result;
  double length = 0;
  for (std::size_t leg = 0; leg < legs; ++leg) {
    const Eigen::Vector3d way = points[leg + 1] - points[leg];
    const Eigen::Vector3d direction = way.normalized();
    for (int i = 1; i <= count[leg]; ++i) {
      const double part = static_cast<double>(i) / count[leg];
      result.push_back({i == count[leg] ? points[leg + 1] : Eigen::Vector3d(points[leg] + part * way), direction,
                        direction, length + part * way.norm()});
    }
    length += way.norm();
    if (leg + 1 < legs) result.back().after = (points[leg + 2] - points[leg + 1]).normalized();
  }
  return result;
}

// Barry and Goldman 1988, with knots the square roots of the distances.
Eigen::Vector3d catmull_rom(const Eigen::Vector3d* p, double t) {
  double knot[4] = {0};
  for (int i = 0; i < 3; ++i) knot[i + 1] = knot[i] + std::sqrt((p[i + 1] - p[i]).norm());
  const double u = knot[1] + t * (knot[2] - knot[1]);
  const auto mix = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, int i, int j) -> Eigen::Vector3d {
    return ((knot[j] - u) * a + (u - knot[i]) * b) / (knot[j] - knot[i]);
  };
  const Eigen::Vector3d a = mix(p[0], p[1], 0, 1), b = mix(p[1], p[2], 1, 2), c = mix(p[2], p[3], 2, 3);
  return mix(mix(a, b, 0, 2), mix(b, c, 1, 3), 1, 2);
}

std::vector<Waypoint> along_curve(const Points& points, const Eigen::Vector3d& normal, int steps) {
  constexpr int k_samples = 64;
  Points control{points[0] - (points[1] - points[0]).norm() * normal};
  control.insert(control.end(), points.begin(), points.end());
  control.push_back(2 * points.back() - points[points.size() - 2]);
  Points samples{points[0]};
  for (std::size_t leg = 0; leg + 1 < points.size(); ++leg)
    for (int i = 1; i <= k_samples; ++i)
      samples.push_back(i == k_samples ? points[leg + 1]
                                       : catmull_rom(&control[leg], static_cast<double>(i) / k_samples));
  std::vector<double> length{0};
  for (std::size_t i = 1; i < samples.size(); ++i)
    length.push_back(length.back() + (samples[i] - samples[i - 1]).norm());
  std::vector<Waypoint> result;
  for (int s = 1; s <= steps; ++s) {
    const double wanted = length.back() * s / steps;
    auto i = static_cast<std::size_t>(std::lower_bound(length.begin(), length.end(), wanted) - length.begin());
    i = std::clamp<std::size_t>(s == steps ? samples.size() - 1 : i, 1, samples.size() - 1);
    const double span = length[i] - length[i - 1];
    const double part = s == steps || span == 0 ? 1 : (wanted - length[i - 1]) / span;
    const std::size_t next = std::min(i + 1, samples.size() - 1);
    const Eigen::Vector3d direction = (samples[next] - samples[i - 1]).normalized();
    result.push_back({samples[i - 1] + part * (samples[i] - samples[i - 1]), direction, direction, wanted});
  }
  return result;
}

}  // namespace

std::vector<Station> stations(const Eigen::Vector3d& start, const Eigen::Vector3d& normal,
                              std::span<const Eigen::Vector3d> path, bool curve, int steps) {
  Points points{start};
  points.insert(points.end(), path.begin(), path.end());
  if (path.empty())
    throw Error(ErrorCode::bad_input, "expected points for the path, found none; give X Y Z of each");
  const double size = (*std::max_element(points.begin(), points.end(),
                                         [&](const auto& a, const auto& b) {
                                           return (a - start).squaredNorm() < (b - start).squaredNorm();
                                         }) -
                       start)
                          .norm();
  for (std::size_t i = 1; i < points.size(); ++i)
    if (!((points[i] - points[i - 1]).norm() > 1e-9 * size))
      throw Error(ErrorCode::bad_input,
                  i == 1 ? "the path begins at the middle of the faces by itself; leave out its first point"
                         : fmt::format("point {} of the path is where the one before it is; leave it out", i));
  const std::vector<Waypoint> ways = curve ? along_curve(points, normal, steps) : along_legs(points, steps);
  std::vector<Station> result;
  Eigen::Vector3d tangent = normal;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  for (const Waypoint& w : ways) {
    const Eigen::Vector3d sum = w.before + w.after;
    if (sum.norm() < 2 * k_straight_back)
      throw Error(ErrorCode::bad_input, "the path turns straight back; give it a point to turn round, or `curve`");
    if ((tangent + sum.normalized()).norm() < 2 * k_straight_back)
      throw Error(ErrorCode::bad_input,
                  "the path goes straight into the faces; give it a point before them to turn round");
    turn = rotation(tangent, sum.normalized()) * turn;
    tangent = sum.normalized();
    result.push_back({w.at, mitre(w) * turn, w.length / ways.back().length});
  }
  return result;
}

}  // namespace argil::subdiv
