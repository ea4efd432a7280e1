#include "subdiv/cell_lists.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solid_measures.h"
#include "subdiv/transaction.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;

// One cell's vertices, given as numbers that are then permuted, read back in VTK's order.
Loop vtk_numbers(const Built& built, CellId cell = CellId{0u}) {
  Loop numbers;
  for (const VertexId v : vtk_vertices(built.solid, cell)) numbers.push_back(built.point_from_vertex[v.index()]);
  return numbers;
}

TEST(CellLists, LowestVertexBeginsAndKindIsKept) {
  CellLists lists = points(9);
  add_cell(lists, CellKind::hexahedron, {6, 2, 3, 7, 4, 0, 1, 5});
  Built built = build(lists);
  EXPECT_EQ(cell_kind(built.solid, CellId{0u}), CellKind::hexahedron);
  // 0's neighbours are 1, 2 and 4; u goes to 1, and the frame is as right-handed as the list's.
  EXPECT_THAT(vtk_numbers(built), testing::ElementsAre(0, 1, 3, 2, 4, 5, 7, 6));

  lists = points(9);
  add_cell(lists, CellKind::pyramid, {7, 5, 3, 8, 0});
  EXPECT_THAT(vtk_numbers(build(lists)), testing::ElementsAre(3, 8, 7, 5, 0));

  lists = points(9);
  add_cell(lists, CellKind::wedge, {4, 3, 5, 1, 0, 2});
  EXPECT_THAT(vtk_numbers(build(lists)), testing::ElementsAre(0, 1, 2, 3, 4, 5));

  lists = points(9);
  add_cell(lists, CellKind::tetrahedron, {5, 2, 8, 1});
  EXPECT_THAT(vtk_numbers(build(lists)), testing::ElementsAre(1, 2, 5, 8));
}

TEST(CellLists, BackSidesGiveTheSameHandedness) {
  // Of a grid every cell has back uses; read back, each has its volume with the right sign.
  const Built built = box_grid(3, 2, 2, {3, 2, 2});
  const Built again = build(cell_lists(built.solid, built.positions));
  for (const CellId c : again.solid.cells()) {
    EXPECT_NEAR(cell_volume(again.solid, again.positions, c), 1, 1e-14);
    EXPECT_EQ(vtk_vertices(again.solid, c), vtk_vertices(built.solid, c));
    EXPECT_EQ(vtk_vertices(again.solid, c).front(), cell_vertices(again.solid, c).front());
  }
}

TEST(CellLists, RoundTripKeepsKindsAndVolumesOfAllKinds) {
  for (const auto& built : {tetrahedron({1, 2, 3}), wedge({1, 2, 3}), pyramid({1, 2, 3}), build(dodecahedron()),
                            build(wedges_about_edge(5, true))}) {
    const CellLists lists = cell_lists(built.solid, built.positions);
    const Built again = build(lists);
    ASSERT_EQ(again.solid.cell_count(), built.solid.cell_count());
    EXPECT_EQ(lists.kinds[0], cell_kind(built.solid, CellId{0u}));
    EXPECT_EQ(cell_lists(again.solid, again.positions).connectivity, lists.connectivity);
    EXPECT_GT(cell_volume(again.solid, again.positions, CellId{0u}), 0);
  }
}

TEST(CellLists, DeadIdsAreSqueezedOut) {
  Built built = box_grid(3, 1, 1, {3, 1, 1});
  Transaction transaction(built.solid);
  transaction.remove_cell(CellId{0u});
  (void)transaction.commit();
  const CellLists lists = cell_lists(built.solid, built.positions);
  EXPECT_EQ(lists.positions.cols(), 12);
  EXPECT_EQ(lists.positions(0, 0), 1);
  EXPECT_EQ(build(lists).solid.cell_count(), 2u);
}

TEST(CellLists, LookAlikesArePolyhedra) {
  // Six quadrilaterals and eight vertices, but two vertices have two faces and two have four.
  CellLists lists = points(8);
  add_polyhedron(lists, {{0, 1, 2, 3}, {0, 3, 4, 5}, {3, 2, 6, 4}, {2, 1, 7, 6}, {1, 0, 5, 7}, {5, 4, 6, 7}});
  EXPECT_EQ(cell_kind(build(lists).solid, CellId{0u}), CellKind::hexahedron);
  lists = points(8);
  add_polyhedron(lists, {{0, 1, 2, 3}, {0, 3, 2, 4}, {0, 4, 2, 5}, {0, 5, 6, 7}, {6, 5, 2, 1}, {0, 7, 6, 1}});
  EXPECT_EQ(cell_kind(build(lists).solid, CellId{0u}), CellKind::polyhedron);
  // A quadrilateral and four triangles with a vertex of two faces: no pyramid.
  lists = points(5);
  add_polyhedron(lists, {{4, 1, 0}, {4, 0, 2, 1}, {0, 3, 2}, {1, 2, 3}, {0, 1, 3}});
  EXPECT_EQ(cell_kind(build(lists).solid, CellId{0u}), CellKind::polyhedron);
}

}  // namespace
}  // namespace argil::subdiv
