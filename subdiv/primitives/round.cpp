#include "subdiv/primitives/round.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "subdiv/error.h"
#include "subdiv/primitives/round_parts.h"

namespace argil::subdiv {

namespace {

using std::numbers::pi;

struct Section {
  std::vector<Eigen::Vector2d> points;              // of the unit disk
  std::vector<std::array<std::uint32_t, 4>> quads;  // counter-clockwise
};

Section disk(int around, int rings) {
  const int n = around / 4;
  const double core = core_radius(n, rings);
  Section section;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Eigen::Vector2d p(2.0 * i / n - 1, 2.0 * j / n - 1);
      const Eigen::Vector2d bulged(p.x() * std::sqrt(1 - p.y() * p.y() / 2),
                                   p.y() * std::sqrt(1 - p.x() * p.x() / 2));
      section.points.push_back(core * ((1 - k_bulge) / std::numbers::sqrt2 * p + k_bulge * bulged));
    }
  const auto core_point = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  // Ring 0 is the outline of the core, from its corner at −45 degrees.
  const auto point = [&](int ring, int k) {
    k %= around;
    if (ring > 0) return static_cast<std::uint32_t>((n + 1) * (n + 1) + (ring - 1) * around + k);
    const int side = k / n, t = k % n;
    return side == 0   ? core_point(n, t)
           : side == 1 ? core_point(n - t, n)
           : side == 2 ? core_point(0, n - t)
                       : core_point(t, 0);
  };
  for (int ring = 1; ring <= rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * pi * k / around - pi / 4, part = static_cast<double>(ring) / rings;
      section.points.push_back((1 - part) * section.points[point(0, k)] +
                               part * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      section.quads.push_back(
          {core_point(i, j), core_point(i + 1, j), core_point(i + 1, j + 1), core_point(i, j + 1)});
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < around; ++k)
      section.quads.push_back({point(ring, k), point(ring + 1, k), point(ring + 1, k + 1), point(ring, k + 1)});
  return section;
}

Section annulus(double hole, int around, int rings) {
  Section section;
  for (int ring = 0; ring <= rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * pi * k / around, radius = hole + (1 - hole) * ring / rings;
      section.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  const auto point = [&](int ring, int k) { return static_cast<std::uint32_t>(ring * around + k % around); };
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < around; ++k)
      section.quads.push_back({point(ring, k), point(ring + 1, k), point(ring + 1, k + 1), point(ring, k + 1)});
  return section;
}

using Place = std::function<Eigen::Vector3d(const Eigen::Vector2d&, int layer)>;

// Hexahedra between `layers` + 1 copies of the section, or as many if they close to a ring.
CellLists sweep(const Section& section, int layers, bool closed, const Place& place) {
  CellLists lists;
  const auto count = static_cast<std::uint32_t>(section.points.size());
  const int copies = closed ? layers : layers + 1;
  lists.positions.resize(3, static_cast<Eigen::Index>(count) * copies);
  for (int layer = 0; layer < copies; ++layer)
    for (std::uint32_t i = 0; i < count; ++i)
      lists.positions.col(static_cast<Eigen::Index>(layer) * count + i) = place(section.points[i], layer);
  for (int layer = 0; layer < layers; ++layer)
    for (const auto& quad : section.quads) {
      for (const int l : {layer, (layer + 1) % copies})
        for (const std::uint32_t corner : quad)
          lists.connectivity.push_back(static_cast<std::uint32_t>(l) * count + corner);
      end_cell(lists, CellKind::hexahedron);
    }
  return lists;
}

}  // namespace

void check_length(double length, const char* what) {
  if (!(std::isfinite(length) && length > 0))
    throw Error(ErrorCode::bad_input,
                fmt::format("the {} is {:g}; expected a positive, finite length [m]", what, length));
}

void check_grid(const RoundGrid& grid, double cells, int least_along, bool in_quarters) {
  if (in_quarters ? grid.around < 4 || grid.around % 4 != 0 : grid.around < 3)
    throw Error(ErrorCode::bad_input,
                fmt::format("{} cells around; expected {}", grid.around,
                            in_quarters ? "a multiple of 4, because a square core lies in the middle: 4, 8, 12, …"
                                        : "at least 3"));
  if (grid.along < least_along)
    throw Error(ErrorCode::bad_input, fmt::format("{} cells along; expected at least {}", grid.along, least_along));
  if (grid.rings < 1) throw Error(ErrorCode::bad_input, fmt::format("{} rings; expected at least 1", grid.rings));
  if (cells > 1e8)
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("{:.3g} cells are beyond the 1e8 that a solid holds; ask for fewer", cells));
}

double disk_cell_count(const RoundGrid& grid) {
  const double side = grid.around / 4;
  return side * side + double(grid.around) * grid.rings;
}

Built cylinder(double radius, double height, const RoundGrid& grid) {
  return cone(radius, radius, height, grid);
}

Built tube(double radius, double inner, double height, const RoundGrid& grid) {
  check_length(radius, "radius");
  check_length(inner, "inner radius");
  check_length(height, "height");
  check_grid(grid, double(grid.around) * grid.rings * grid.along, 1, false);
  if (inner >= radius)
    throw Error(ErrorCode::bad_input,
                fmt::format("the hole has the radius {:g}, the tube {:g}; expected a smaller hole", inner, radius));
  return build(sweep(annulus(inner / radius, grid.around, grid.rings), grid.along, false,
                     [&](const Eigen::Vector2d& p, int layer) {
                       return Eigen::Vector3d(radius * p.x(), radius * p.y(), height * layer / grid.along);
                     }));
}

Built cone(double radius, double top, double height, const RoundGrid& grid) {
  check_length(radius, "radius");
  check_length(height, "height");
  if (top != 0) check_length(top, "top radius");
  check_grid(grid, disk_cell_count(grid) * grid.along, 1, true);
  const Section section = disk(grid.around, grid.rings);
  const int layers = top > 0 ? grid.along : grid.along - 1;
  CellLists lists = sweep(section, layers, false, [&](const Eigen::Vector2d& p, int layer) {
    const double part = static_cast<double>(layer) / grid.along, r = (1 - part) * radius + part * top;
    return Eigen::Vector3d(r * p.x(), r * p.y(), height * part);
  });
  if (top > 0) return build(lists);
  const auto apex = static_cast<std::uint32_t>(lists.positions.cols());
  lists.positions.conservativeResize(3, apex + 1);
  lists.positions.col(apex) << 0, 0, height;
  for (const auto& quad : section.quads) {
    for (const std::uint32_t corner : quad)
      lists.connectivity.push_back(apex - static_cast<std::uint32_t>(section.points.size()) + corner);
    lists.connectivity.push_back(apex);
    end_cell(lists, CellKind::pyramid);
  }
  return build(lists);
}

Built torus(double radius, double thickness, const RoundGrid& grid) {
  check_length(radius, "radius");
  check_length(thickness, "thickness");
  check_grid(grid, disk_cell_count(grid) * grid.along, 3, true);
  if (thickness >= radius)
    throw Error(ErrorCode::bad_input,
                fmt::format("the section has the radius {:g}, the ring {:g}; expected a thinner section, which "
                            "leaves a hole",
                            thickness, radius));
  // Outward × upward points against the angle about z, so the sections follow one another clockwise.
  return build(sweep(disk(grid.around, grid.rings), grid.along, true, [&](const Eigen::Vector2d& p, int layer) {
    const double angle = -2 * pi * layer / grid.along, r = radius + thickness * p.x();
    return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), thickness * (1 + p.y()));
  }));
}

}  // namespace argil::subdiv
