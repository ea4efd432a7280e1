#pragma once
// Small solids for the tests of topology.

#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "subdiv/build.h"

namespace argil::subdiv::test {

using Loop = std::vector<std::uint32_t>;

/// `count` points, no three of a grid's in line by accident.
inline CellLists points(std::size_t count) {
  CellLists lists;
  lists.positions.resize(3, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = static_cast<double>(i);
    lists.positions.col(static_cast<Eigen::Index>(i)) << t, t * t, t * t * t;
  }
  return lists;
}

inline void add_cell(CellLists& lists, CellKind kind, const Loop& numbers) {
  lists.kinds.push_back(kind);
  lists.connectivity.insert(lists.connectivity.end(), numbers.begin(), numbers.end());
  lists.offsets.push_back(lists.connectivity.size());
}

/// The face stream of a polyhedron.
inline Loop stream(const std::vector<Loop>& faces) {
  Loop numbers{static_cast<std::uint32_t>(faces.size())};
  for (const Loop& face : faces) {
    numbers.push_back(static_cast<std::uint32_t>(face.size()));
    numbers.insert(numbers.end(), face.begin(), face.end());
  }
  return numbers;
}

inline void add_polyhedron(CellLists& lists, const std::vector<Loop>& faces) {
  add_cell(lists, CellKind::polyhedron, stream(faces));
}

/// Unit cubes with their lowest corners at the given grid points; cubes share the corners that coincide.
inline CellLists cubes(std::initializer_list<std::array<int, 3>> corners) {
  CellLists lists;
  std::vector<std::array<int, 3>> known;
  const auto point = [&](int x, int y, int z) {
    const std::array<int, 3> p{x, y, z};
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i] == p) return static_cast<std::uint32_t>(i);
    known.push_back(p);
    return static_cast<std::uint32_t>(known.size() - 1);
  };
  for (const auto& [x, y, z] : corners)
    add_cell(lists, CellKind::hexahedron,
             {point(x, y, z), point(x + 1, y, z), point(x + 1, y + 1, z), point(x, y + 1, z), point(x, y, z + 1),
              point(x + 1, y, z + 1), point(x + 1, y + 1, z + 1), point(x, y + 1, z + 1)});
  lists.positions.resize(3, static_cast<Eigen::Index>(known.size()));
  for (std::size_t i = 0; i < known.size(); ++i)
    lists.positions.col(static_cast<Eigen::Index>(i)) << known[i][0], known[i][1], known[i][2];
  return lists;
}

/// A closed ring of eight cubes about a hole: genus 1.
inline CellLists ring() {
  return cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

/// `count` wedges about the z axis; all the way round if closed, else over half a turn.
inline CellLists wedges_about_edge(int count, bool closed) {
  CellLists lists;
  const int spokes = closed ? count : count + 1;
  lists.positions.resize(3, 2 + 2 * spokes);
  lists.positions.col(0) << 0, 0, 0;
  lists.positions.col(1) << 0, 0, 1;
  for (int i = 0; i < spokes; ++i) {
    const double angle = (closed ? 2.0 : 1.0) * 3.14159265358979323846 * i / count;
    lists.positions.col(2 + 2 * i) << std::cos(angle), std::sin(angle), 0;
    lists.positions.col(3 + 2 * i) << std::cos(angle), std::sin(angle), 1;
  }
  for (int i = 0; i < count; ++i) {
    const auto a = static_cast<std::uint32_t>(2 + 2 * i),
               b = static_cast<std::uint32_t>(2 + 2 * ((i + 1) % spokes));
    add_cell(lists, CellKind::wedge, {0, b, a, 1, b + 1, a + 1});
  }
  return lists;
}

/// The regular dodecahedron of edge 1 about the origin: one cell of twelve pentagons.
CellLists dodecahedron();

}  // namespace argil::subdiv::test
