#include "subdiv/inside_out.h"

#include <gtest/gtest.h>

#include "subdiv/build.h"
#include "subdiv/error.h"
#include "subdiv/hanging_vertices.h"
#include "subdiv/solid_measures.h"

namespace argil::subdiv {
namespace {

// One cell of each kind, apart from each other: a box, a wedge, a pyramid, a tetrahedron, a polyhedral box.
CellLists one_of_each() {
  CellLists lists;
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](CellKind kind, std::vector<Eigen::Vector3d> corners, std::vector<std::uint32_t> numbers) {
    const auto first = static_cast<std::uint32_t>(points.size());
    const Eigen::Vector3d apart(3.0 * static_cast<double>(lists.cell_count()), 0, 0);
    for (const auto& corner : corners) points.push_back(corner + apart);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      // Of a stream, the number of faces and the sizes are not points.
      const bool size = kind == CellKind::polyhedron && (i == 0 || (i - 1) % 5 == 0);
      lists.connectivity.push_back(numbers[i] + (size ? 0 : first));
    }
    lists.kinds.push_back(kind);
    lists.offsets.push_back(lists.connectivity.size());
  };
  const std::vector<Eigen::Vector3d> box{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  add(CellKind::hexahedron, box, {0, 1, 2, 3, 4, 5, 6, 7});
  add(CellKind::wedge, {box[0], box[3], box[1], box[4], box[7], box[5]}, {0, 1, 2, 3, 4, 5});
  add(CellKind::pyramid, {box[0], box[1], box[2], box[3], box[4]}, {0, 1, 2, 3, 4});
  add(CellKind::tetrahedron, {box[0], box[1], box[3], box[4]}, {0, 1, 2, 3});
  add(CellKind::polyhedron, box,
      {6, 4, 0, 3, 2, 1, 4, 4, 5, 6, 7, 4, 0, 1, 5, 4, 4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0, 4, 7});
  lists.positions.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) lists.positions.col(static_cast<Eigen::Index>(i)) = points[i];
  return lists;
}

TEST(InsideOut, CellsOfEveryKindAreFoundAndTurnedRound) {
  CellLists lists = one_of_each();
  EXPECT_TRUE(inside_out_cells(lists).empty());
  for (std::size_t c = 0; c < lists.cell_count(); ++c) {
    const CellLists sound = lists;
    turn_inside_out(lists, c);
    EXPECT_EQ(inside_out_cells(lists), std::vector<std::size_t>{c});
    const Built built = build(lists);
    EXPECT_EQ(inverted_cells(built.solid, built.positions).first.index(), c);
    turn_inside_out(lists, c);
    EXPECT_EQ(lists.connectivity, sound.connectivity);
  }
}

// A box below; above it blocks of n × n columns, n + 1 points a side, with the corners of the box.
CellLists box_under_columns(std::uint32_t n, bool shared_corners) {
  CellLists lists;
  std::vector<Eigen::Vector3d> points;
  const auto add_hexahedron = [&](std::vector<std::uint32_t> corners) {
    lists.connectivity.insert(lists.connectivity.end(), corners.begin(), corners.end());
    lists.kinds.push_back(CellKind::hexahedron);
    lists.offsets.push_back(lists.connectivity.size());
  };
  for (const double z : {0.0, 1.0, 2.0})
    for (std::uint32_t y = 0; y <= n; ++y)
      for (std::uint32_t x = 0; x <= n; ++x)
        points.push_back(Eigen::Vector3d(double(x) / n, double(y) / n, z) * 0.3);  // thirds are not exact
  const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return x + (n + 1) * (y + (n + 1) * z);
  };
  std::vector<std::uint32_t> top{at(0, 0, 1), at(n, 0, 1), at(n, n, 1), at(0, n, 1)};
  if (!shared_corners)
    for (std::uint32_t& corner : top) {
      points.push_back(points[corner]);
      corner = static_cast<std::uint32_t>(points.size() - 1);
    }
  add_hexahedron({at(0, 0, 0), at(n, 0, 0), at(n, n, 0), at(0, n, 0), top[0], top[1], top[2], top[3]});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x)
      add_hexahedron({at(x, y, 1), at(x + 1, y, 1), at(x + 1, y + 1, 1), at(x, y + 1, 1), at(x, y, 2),
                      at(x + 1, y, 2), at(x + 1, y + 1, 2), at(x, y + 1, 2)});
  lists.positions.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) lists.positions.col(static_cast<Eigen::Index>(i)) = points[i];
  return lists;
}

TEST(HangingVertices, TheLowestOneIsFoundOnAnEdgeAndOnAFace) {
  for (const std::uint32_t n : {2U, 3U, 7U}) {
    const Built built = build(box_under_columns(n, true));
    const auto hanging = find_hanging_vertex(built.solid, built.positions);
    ASSERT_TRUE(hanging) << n;
    EXPECT_EQ(hanging->cell.index(), 0U);
    const std::uint32_t point = built.point_from_vertex[hanging->vertex.index()];
    EXPECT_EQ(point, (n + 1) * (n + 1) + 1) << n;  // the first one along the edge of the box
  }
}

TEST(HangingVertices, SoundSolidsAndBodiesThatTouchHaveNone) {
  for (const bool shared : {true, false}) {
    const Built one = build(box_under_columns(1, shared));
    EXPECT_FALSE(find_hanging_vertex(one.solid, one.positions));
  }
  const Built touching = build(box_under_columns(4, false));
  EXPECT_FALSE(find_hanging_vertex(touching.solid, touching.positions));
  const Built apart = build(one_of_each());
  EXPECT_FALSE(find_hanging_vertex(apart.solid, apart.positions));
}

}  // namespace
}  // namespace argil::subdiv
