#include "subdiv/primitives/platonic.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "subdiv/primitives/round_parts.h"

namespace argil::subdiv {

namespace {

// Corners on a common sphere. (p, q) rotated through the axes with every sign gives the points of a regular body.
std::vector<Eigen::Vector3d> corners(Platonic body) {
  std::vector<Eigen::Vector3d> points;
  const auto cube = [&](bool even_only) {
    for (int x = -1; x <= 1; x += 2)
      for (int y = -1; y <= 1; y += 2)
        for (int z = -1; z <= 1; z += 2)
          if (!even_only || x * y * z > 0) points.emplace_back(x, y, z);
  };
  const auto rectangles = [&](double p, double q) {
    for (int axis = 0; axis < 3; ++axis)
      for (int sp = -1; sp <= 1; sp += 2)
        for (int sq = -1; sq <= 1; sq += 2) {
          Eigen::Vector3d point = Eigen::Vector3d::Zero();
          point[(axis + 1) % 3] = sp * p;
          point[(axis + 2) % 3] = sq * q;
          points.push_back(point);
        }
  };
  constexpr double phi = std::numbers::phi;
  switch (body) {
    case Platonic::tetrahedron:
      cube(true);
      break;
    case Platonic::cube:
      cube(false);
      break;
    case Platonic::octahedron:
      for (int axis = 0; axis < 3; ++axis)
        for (int sign = -1; sign <= 1; sign += 2) points.push_back(sign * Eigen::Vector3d::Unit(axis));
      break;
    case Platonic::dodecahedron:
      cube(false);
      rectangles(1 / phi, phi);
      break;
    case Platonic::icosahedron:
      rectangles(1, phi);
      break;
  }
  for (Eigen::Vector3d& point : points) point.normalize();
  return points;
}

// The faces of the convex hull of a few points about the origin, each counter-clockwise from outside.
std::vector<std::vector<std::uint32_t>> hull(const std::vector<Eigen::Vector3d>& points) {
  constexpr double k_flat = 1e-9;
  std::vector<std::vector<std::uint32_t>> faces;
  std::set<std::vector<std::uint32_t>> known;
  const std::size_t n = points.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c) {
        Eigen::Vector3d normal = (points[b] - points[a]).cross(points[c] - points[a]);
        if (normal.dot(points[a]) < 0) normal = -normal;
        std::vector<std::uint32_t> on;
        bool outermost = true;
        for (std::size_t i = 0; i < n; ++i) {
          const double above = normal.dot(points[i] - points[a]);
          outermost = outermost && above < k_flat;
          if (std::abs(above) < k_flat) on.push_back(static_cast<std::uint32_t>(i));
        }
        if (!outermost || !known.insert(on).second) continue;
        const Eigen::Vector3d x = points[on[0]] - normal * normal.dot(points[on[0]]) / normal.squaredNorm();
        const Eigen::Vector3d y = normal.cross(x);
        const auto angle = [&](std::uint32_t i) {
          return std::atan2(points[i].dot(y) / y.norm(), points[i].dot(x) / x.norm());
        };
        std::sort(on.begin(), on.end(), [&](std::uint32_t i, std::uint32_t j) { return angle(i) < angle(j); });
        faces.push_back(on);
      }
  return faces;
}

}  // namespace

Built platonic(Platonic body, double radius) {
  check_length(radius, "radius");
  const std::vector<Eigen::Vector3d> points = corners(body);
  const auto faces = hull(points);
  Eigen::Vector3d down = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : faces[0]) down += points[i];
  const auto upright = Eigen::Quaterniond::FromTwoVectors(down, -Eigen::Vector3d::UnitZ());
  CellLists lists;
  lists.positions.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    lists.positions.col(static_cast<Eigen::Index>(i)) = radius * (upright * points[i]);
  lists.positions.row(2).array() -= lists.positions.row(2).minCoeff();
  lists.connectivity.push_back(static_cast<std::uint32_t>(faces.size()));
  for (const auto& face : faces) {
    lists.connectivity.push_back(static_cast<std::uint32_t>(face.size()));
    lists.connectivity.insert(lists.connectivity.end(), face.begin(), face.end());
  }
  end_cell(lists, CellKind::polyhedron);
  return build(lists);
}

}  // namespace argil::subdiv
