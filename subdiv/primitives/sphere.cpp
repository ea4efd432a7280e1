#include <cmath>
#include <numbers>

#include "subdiv/primitives/round_parts.h"

namespace argil::subdiv {

namespace {

// The cube [−1, 1]³ onto the unit ball, its boundary onto the sphere.
Eigen::Vector3d ball_from_cube(const Eigen::Vector3d& p) {
  const Eigen::Vector3d s = p.cwiseAbs2();
  const auto stretch = [](double a, double b) { return std::sqrt(1 - a / 2 - b / 2 + a * b / 3); };
  return {p.x() * stretch(s.y(), s.z()), p.y() * stretch(s.z(), s.x()), p.z() * stretch(s.x(), s.y())};
}

// Equal steps then make equal angles along the great circles through the middles of the sides.
Eigen::Vector3d equal_angles(const Eigen::Vector3d& p) {
  return p.unaryExpr([](double t) { return std::numbers::sqrt2 * std::sin(std::numbers::pi / 4 * t); });
}

}  // namespace

double sphere_cell_count(const RoundGrid& grid) {
  const double side = grid.around / 4;
  return side * side * side + 6 * side * side * grid.rings;
}

Built sphere(double radius, const RoundGrid& grid) {
  check_length(radius, "radius");
  check_grid(grid, sphere_cell_count(grid), 0, true);
  const int n = grid.around / 4;
  const double core = core_radius(n, grid.rings);
  const auto lattice = [&](int i, int j, int k) {
    return static_cast<std::size_t>((k * (n + 1) + j) * (n + 1) + i);
  };
  std::vector<Eigen::Vector3d> points, outline;
  std::vector<std::uint32_t> outline_from_core;  // of inner points, nothing
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const Eigen::Vector3d p(2.0 * i / n - 1, 2.0 * j / n - 1, 2.0 * k / n - 1);
        points.push_back(core * ((1 - k_bulge) / std::sqrt(3.0) * p + k_bulge * ball_from_cube(p)));
        outline_from_core.push_back(static_cast<std::uint32_t>(outline.size()));
        if (p.cwiseAbs().maxCoeff() == 1) outline.push_back(ball_from_cube(equal_angles(p)).normalized());
      }
  const std::size_t core_points = points.size();
  for (int ring = 1; ring <= grid.rings; ++ring)
    for (std::size_t c = 0; c < core_points; ++c) {
      const std::size_t o = outline_from_core[c];
      if (o == (c + 1 < core_points ? outline_from_core[c + 1] : outline.size())) continue;
      const double part = static_cast<double>(ring) / grid.rings;
      points.push_back((1 - part) * points[c] + part * outline[o]);
    }

  CellLists lists;
  lists.positions.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    lists.positions.col(static_cast<Eigen::Index>(i)) = radius * (points[i] + Eigen::Vector3d::UnitZ());
  const auto add = [&](std::initializer_list<std::size_t> corners) {
    for (const std::size_t v : corners) lists.connectivity.push_back(static_cast<std::uint32_t>(v));
    end_cell(lists, CellKind::hexahedron);
  };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        add({lattice(i, j, k), lattice(i + 1, j, k), lattice(i + 1, j + 1, k), lattice(i, j + 1, k),
             lattice(i, j, k + 1), lattice(i + 1, j, k + 1), lattice(i + 1, j + 1, k + 1),
             lattice(i, j + 1, k + 1)});
  const auto point = [&](int ring, std::size_t c) {
    return ring == 0 ? c : core_points + static_cast<std::size_t>(ring - 1) * outline.size() + outline_from_core[c];
  };
  for (int ring = 0; ring < grid.rings; ++ring)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int end : {0, n})
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) {
            const auto at = [&](int u, int v) {
              std::array<int, 3> p{};
              p[axis] = end;
              p[(axis + 1) % 3] = end == 0 ? v : u;  // counter-clockwise from outside
              p[(axis + 2) % 3] = end == 0 ? u : v;
              return lattice(p[0], p[1], p[2]);
            };
            const std::size_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            add({point(ring, a), point(ring, b), point(ring, c), point(ring, d), point(ring + 1, a),
                 point(ring + 1, b), point(ring + 1, c), point(ring + 1, d)});
          }
  return build(lists);
}

}  // namespace argil::subdiv
