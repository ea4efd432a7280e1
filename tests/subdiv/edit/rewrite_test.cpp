#include "subdiv/edit/rewrite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/validate.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/slow_check.h"

namespace argil::subdiv::test {
namespace {

using testing::IsEmpty;

TEST(LinkFault, NoShapeOfTheCatalogueHasOne) {
  for (const Shape& shape : catalogue())
    for (const VertexId v : shape.solid.vertices()) EXPECT_EQ(link_fault(shape.solid, v), "") << shape.name;
}

TEST(LinkFault, ARingOfCellsAboutAVertexThatTouchesItselfIsNone) {
  // Six of the eight cells about the middle of a 2³ box, without two opposite ones: the link is a sphere with two
  // holes.
  Solid solid = box_grid(2, 2, 2, {1, 1, 1}).solid;
  Transaction edit(solid);
  edit.remove_cell(CellId{0});
  edit.remove_cell(CellId{7});
  EXPECT_EQ(link_fault(edit.solid(), VertexId{13}), "");
}

TEST(LinkFault, ATorusAboutAVertexIsOne) {
  // A 3 × 3 grid of pyramids with one apex whose bases are glued along opposite sides: the link is a torus.
  Solid solid;
  Transaction edit(solid);
  const VertexId apex = edit.add_vertex();
  std::vector<VertexId> grid;
  for (int i = 0; i < 9; ++i) grid.push_back(edit.add_vertex());
  const auto at = [&](int i, int j) { return grid[static_cast<std::size_t>(i % 3 * 3 + j % 3)]; };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const std::vector<VertexId> base{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      std::vector<std::vector<VertexId>> loops{{base.rbegin(), base.rend()}};
      for (std::size_t k = 0; k < 4; ++k) loops.push_back({base[k], base[(k + 1) % 4], apex});
      edit.add_cell(loops);
    }
  EXPECT_THAT(link_fault(edit.solid(), apex), testing::HasSubstr("vertex 0"));
  EXPECT_EQ(link_fault(edit.solid(), grid[0]), "");
  EXPECT_THROW(check_links(edit.solid(), std::vector{grid[0], apex}), Error);
  const EulerRelation relation = euler_relation(edit.solid());
  EXPECT_NE(relation.solid, relation.boundary);
}

TEST(Rewrite, KeepsTheIdsAndTheSharpnessOfWhatIsShared) {
  Built built = sharp_box_grid(2, 1, 1, {2, 1, 1});
  const std::uint64_t before = built.solid.topology_hash();
  const auto loops = cell_loops(built.solid, CellId{1});
  Transaction transaction(built.solid);
  Edit edit;
  rewrite(transaction, {.removed = {CellId{1}}, .added = {{loops, CellId{1}}}}, edit);
  EXPECT_EQ(built.solid.face_capacity(), 11U);
  EXPECT_EQ(built.solid.edge_capacity(), 20U);
  ASSERT_EQ(edit.cells.size(), 1U);
  EXPECT_EQ(edit.cells[0].made, CellId{2});
  EXPECT_THAT(edit.faces, IsEmpty());
  EXPECT_THAT(validate(built.solid), IsEmpty());
  for (const EdgeId e : built.solid.edges())
    EXPECT_EQ(built.solid.edge_sharpness(e), built.solid.edge_valence(e) == 2 ? k_infinitely_sharp : 0);
  transaction.roll_back();
  EXPECT_EQ(built.solid.topology_hash(), before);
}

TEST(Rewrite, WhatIsGluedIsSweptAndPassesItsSharpnessOn) {
  // Two boxes side by side, the second one made anew on the first one's vertices.
  CellLists lists = cubes({{0, 0, 0}, {2, 0, 0}});
  Built built = build(lists);
  sharpen(built.solid, box_edges(built.solid));
  std::map<VertexId, VertexId> replaced;
  for (const VertexId v : cell_vertices(built.solid, CellId{1}))
    for (const VertexId w : cell_vertices(built.solid, CellId{0}))
      if ((built.positions.col(v.value) - Eigen::Vector3d(1, 0, 0) - built.positions.col(w.value)).norm() < 1e-9)
        replaced[v] = w;
  ASSERT_EQ(replaced.size(), 4U);
  auto loops = cell_loops(built.solid, CellId{1});
  for (auto& loop : loops)
    for (VertexId& v : loop)
      if (const auto found = replaced.find(v); found != replaced.end()) v = found->second;
  Transaction transaction(built.solid);
  Edit edit;
  rewrite(transaction, {.removed = {CellId{1}}, .added = {{loops, CellId{1}}}, .replaced = replaced}, edit);
  const Solid& solid = built.solid;
  EXPECT_THAT(validate(solid), IsEmpty());
  EXPECT_THAT(slow_check(solid), IsEmpty());
  EXPECT_EQ(solid.vertex_count(), 12U);
  EXPECT_EQ(solid.face_count(), 11U);
  EXPECT_EQ(edit.merged.size(), 4U);
  std::size_t sharp = 0;
  for (const EdgeId e : solid.edges()) sharp += solid.edge_sharpness(e) > 0 ? 1 : 0;
  EXPECT_EQ(sharp, 20U);  // all edges lie on the boundary still, and all were sharp
}

}  // namespace
}  // namespace argil::subdiv::test
