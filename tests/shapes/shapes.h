#pragma once
// A catalogue of nasty shapes: every kind of cell, valences from three up, boundaries that are no manifold, holes,
// hanging nodes, and what is sharp on them. Each refines without a refusal.

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "subdiv/primitives.h"
#include "subdiv/transaction.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv::test {

struct Shape {
  std::string name;
  Solid solid;
  Eigen::Matrix3Xd positions;
  bool has_dart = false;  // a smooth vertex with one sharp edge
};

inline Eigen::Matrix3Xd random_positions(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(count));
  for (Eigen::Index i = 0; i < positions.size(); ++i)
    positions.data()[i] = static_cast<double>(random()) / 4294967296.0 * 2 - 1;
  return positions;
}

/// Moves every point by up to `amount` in each direction.
inline Eigen::Matrix3Xd jittered(const Eigen::Matrix3Xd& positions, double amount, unsigned seed) {
  return positions + amount * random_positions(static_cast<std::size_t>(positions.cols()), seed);
}

inline void sharpen(Solid& solid, const std::vector<EdgeId>& edges, const std::vector<VertexId>& corners = {}) {
  Transaction edit(solid);
  for (const EdgeId e : edges) edit.set_sharpness(e, k_infinitely_sharp);
  for (const VertexId v : corners) edit.set_sharpness(v, k_infinitely_sharp);
  (void)edit.commit();
}

/// The edges that only one cell holds: of a grid, the edges of the box.
inline std::vector<EdgeId> box_edges(const Solid& solid) {
  std::vector<EdgeId> edges;
  for (const EdgeId e : solid.edges())
    if (solid.edge_valence(e) == 2) edges.push_back(e);
  return edges;
}

inline Built sharp_box_grid(int nx, int ny, int nz, const Eigen::Vector3d& size) {
  Built built = box_grid(nx, ny, nz, size);
  sharpen(built.solid, box_edges(built.solid));
  return built;
}

/// The same solid with its vertices numbered in random order, so that frames of cells lie in every way.
inline Built shuffled(const Built& built, unsigned seed) {
  CellLists lists = cell_lists(built.solid, built.positions);
  std::vector<std::uint32_t> new_from_old(static_cast<std::size_t>(lists.positions.cols()));
  for (std::size_t i = 0; i < new_from_old.size(); ++i) new_from_old[i] = static_cast<std::uint32_t>(i);
  std::mt19937 random(seed);
  for (std::size_t i = new_from_old.size(); i > 1; --i) std::swap(new_from_old[i - 1], new_from_old[random() % i]);
  const Eigen::Matrix3Xd old = lists.positions;
  for (std::size_t i = 0; i < new_from_old.size(); ++i)
    lists.positions.col(new_from_old[i]) = old.col(static_cast<Eigen::Index>(i));
  for (std::uint32_t& number : lists.connectivity) number = new_from_old[number];
  return build(lists);
}

/// Prisms over polygons of the plane, stacked: point (x, y) at height h.
inline CellLists stacked(const std::vector<std::array<double, 2>>& plane, const std::vector<Loop>& polygons,
                         std::size_t layers) {
  CellLists lists;
  const auto count = static_cast<std::uint32_t>(plane.size());
  lists.positions.resize(3, static_cast<Eigen::Index>(plane.size() * (layers + 1)));
  for (std::size_t h = 0; h <= layers; ++h)
    for (std::size_t i = 0; i < plane.size(); ++i)
      lists.positions.col(static_cast<Eigen::Index>(h * plane.size() + i)) << plane[i][0], plane[i][1],
          static_cast<double>(h);
  for (std::uint32_t h = 0; h < layers; ++h)
    for (const Loop& polygon : polygons) {
      const std::size_t n = polygon.size();
      std::vector<Loop> faces(2);
      for (std::size_t i = 0; i < n; ++i) {
        faces[0].push_back(polygon[n - 1 - i] + h * count);
        faces[1].push_back(polygon[i] + (h + 1) * count);
        const std::uint32_t a = polygon[i] + h * count, b = polygon[(i + 1) % n] + h * count;
        faces.push_back({a, b, b + count, a + count});
      }
      add_polyhedron(lists, faces);
    }
  return lists;
}

/// `valence` quadrilateral prisms about an axis, in layers: an extraordinary edge unless the valence is 4.
inline CellLists fan(std::uint32_t valence, std::size_t layers) {
  std::vector<std::array<double, 2>> plane{{0, 0}};
  std::vector<Loop> polygons;
  for (std::uint32_t i = 0; i < 2 * valence; ++i) {
    const double angle = std::numbers::pi * i / valence, radius = i % 2 == 0 ? 1 : 1.3;
    plane.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  for (std::uint32_t i = 0; i < valence; ++i)
    polygons.push_back({0, 1 + 2 * i, 2 + 2 * i, 1 + (2 * i + 2) % (2 * valence)});
  return stacked(plane, polygons, layers);
}

/// A pyramid on every side of a cube's centre: an interior vertex of six cells, none a hexahedron.
inline CellLists cube_of_pyramids() {
  CellLists lists = cubes({{0, 0, 0}});
  const Loop c = lists.connectivity;
  lists.kinds.clear();
  lists.connectivity.clear();
  lists.offsets = {0};
  lists.positions.conservativeResize(3, 9);
  lists.positions.col(8).setConstant(0.5);
  for (const Loop& f :
       {Loop{0, 1, 2, 3}, Loop{4, 7, 6, 5}, Loop{0, 4, 5, 1}, Loop{1, 5, 6, 2}, Loop{2, 6, 7, 3}, Loop{3, 7, 4, 0}})
    add_cell(lists, CellKind::pyramid, {c[f[0]], c[f[1]], c[f[2]], c[f[3]], 8});
  return lists;
}

/// Eight tetrahedra about the centre of an octahedron.
inline CellLists octahedron_of_tetrahedra() {
  CellLists lists;
  lists.positions.resize(3, 7);
  lists.positions << 1, -1, 0, 0, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 0, 1, -1, 0;
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t x = octant & 1U, y = 2 + (octant >> 1 & 1U), z = 4 + (octant >> 2 & 1U);
    const bool mirrored = ((octant & 1U) + (octant >> 1 & 1U) + (octant >> 2 & 1U)) % 2 == 1;
    add_cell(lists, CellKind::tetrahedron, mirrored ? Loop{6, y, x, z} : Loop{6, x, y, z});
  }
  return lists;
}

/// A cube whose upper neighbour is split into 2 × 2 columns: a cell of nine faces, hanging nodes on its edges.
inline CellLists hanging_nodes() {
  CellLists lists;
  lists.positions.resize(3, 4 + 18);
  const auto at = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return 4 + 9 * z + 3 * y + x; };
  lists.positions.leftCols(4) << 0, 2, 2, 0, 0, 0, 2, 2, 0, 0, 0, 0;
  for (std::uint32_t z = 0; z < 2; ++z)
    for (std::uint32_t y = 0; y < 3; ++y)
      for (std::uint32_t x = 0; x < 3; ++x) lists.positions.col(at(x, y, z)) << x, y, 2 + z;
  std::vector<Loop> faces{{0, 3, 2, 1},
                          {0, 1, at(2, 0, 0), at(1, 0, 0), at(0, 0, 0)},
                          {1, 2, at(2, 2, 0), at(2, 1, 0), at(2, 0, 0)},
                          {2, 3, at(0, 2, 0), at(1, 2, 0), at(2, 2, 0)},
                          {3, 0, at(0, 0, 0), at(0, 1, 0), at(0, 2, 0)}};
  for (std::uint32_t y = 0; y < 2; ++y)
    for (std::uint32_t x = 0; x < 2; ++x) {
      const Loop low{at(x, y, 0), at(x + 1, y, 0), at(x + 1, y + 1, 0), at(x, y + 1, 0)};
      faces.push_back(low);
      add_cell(lists, CellKind::hexahedron,
               {low[0], low[1], low[2], low[3], low[0] + 9, low[1] + 9, low[2] + 9, low[3] + 9});
    }
  add_polyhedron(lists, faces);
  return lists;
}

/// A hexahedron with a pyramid above, a wedge beside and a tetrahedron on the pyramid.
inline CellLists mixed_cells() {
  CellLists lists = cubes({{0, 0, 0}});
  const Loop c = lists.connectivity;
  lists.positions.conservativeResize(3, 12);
  lists.positions.rightCols(4) << 0.5, 2, 2, 1.5, 0.5, 0, 1, -0.2, 2, 0, 0, 1.8;
  add_cell(lists, CellKind::pyramid, {c[4], c[5], c[6], c[7], 8});
  add_polyhedron(
      lists,
      {{c[1], c[5], c[6], c[2]}, {9, 10, c[6], c[5]}, {c[1], c[2], 10, 9}, {c[1], 9, c[5]}, {c[2], c[6], 10}});
  add_cell(lists, CellKind::tetrahedron, {c[4], 11, c[5], 8});
  return lists;
}

/// Every shape of the catalogue, with coordinates off any symmetry.
inline std::vector<Shape> catalogue() {
  std::vector<Shape> shapes;
  const auto add = [&](const std::string& name, Built built) -> Shape& {
    const auto seed = static_cast<unsigned>(shapes.size() + 1);
    shapes.push_back({name, std::move(built.solid), jittered(built.positions, 0.1, seed), false});
    return shapes.back();
  };
  const Eigen::Vector3d unit(1, 1, 1);
  add("cube", box_grid(1, 1, 1, unit));
  add("2 x 2 x 2", box_grid(2, 2, 2, unit));
  add("3 x 4 x 3, shuffled", shuffled(box_grid(3, 4, 3, {3, 4, 3}), 5));
  add("slab", box_grid(4, 3, 1, {4, 3, 1}));
  add("tetrahedron", tetrahedron(unit));
  add("wedge", wedge(unit));
  add("pyramid", pyramid(unit));
  for (const std::uint32_t valence : {3U, 5U, 7U}) add("fan of " + std::to_string(valence), build(fan(valence, 2)));
  add("fan of 6, three layers", build(fan(6, 3)));
  add("cube of pyramids", build(cube_of_pyramids()));
  add("octahedron of tetrahedra", build(octahedron_of_tetrahedra()));
  add("octagonal prism", build(stacked({{2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2}, {2, -1}},
                                       {{0, 1, 2, 3, 4, 5, 6, 7}}, 1)));
  add("hanging nodes", build(hanging_nodes()));
  add("mixed cells", build(mixed_cells()));
  add("ring", build(ring()));
  add("dodecahedron", build(dodecahedron()));
  add("cubes that share a vertex", build(cubes({{0, 0, 0}, {1, 1, 1}})));
  add("cubes that share an edge", build(cubes({{0, 0, 0}, {1, 1, 0}})));
  add("bars that share two edges", build(cubes({{0, 0, 0}, {0, 0, 1}, {1, 1, 0}, {1, 1, 1}})));
  add("bars that cross at an edge", build(cubes({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}})));
  add("two solids", build(cubes({{0, 0, 0}, {3, 0, 0}})));
  add("notched box", build(cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}})));

  add("sharp cube", sharp_box_grid(1, 1, 1, unit));
  add("sharp box", sharp_box_grid(3, 2, 4, {3, 2, 4}));
  {
    Shape& loop = add("cube with one sharp face", box_grid(2, 2, 2, unit));
    std::vector<EdgeId> edges;
    for (const EdgeId e : box_edges(loop.solid)) {
      const auto& ends = loop.solid.edge_vertices(e);
      if (ends[0].index() < 9 && ends[1].index() < 9) edges.push_back(e);
    }
    sharpen(loop.solid, edges);
  }
  {
    Shape& corner = add("cube with a sharp corner and three meeting creases", box_grid(2, 2, 2, unit));
    std::vector<EdgeId> edges;
    for (const EdgeId e : box_edges(corner.solid))
      if (corner.solid.edge_vertices(e)[0].index() == 0) edges.push_back(e);
    sharpen(corner.solid, edges, {VertexId{26}});
    corner.has_dart = true;
  }
  {
    Shape& dart = add("fan with a dart", build(fan(5, 1)));
    sharpen(dart.solid, {*dart.solid.find_edge(VertexId{11}, VertexId{12})});
    dart.has_dart = true;
  }
  return shapes;
}

}  // namespace argil::subdiv::test
