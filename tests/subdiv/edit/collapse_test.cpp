#include "subdiv/edit/collapse.h"

#include "subdiv/boundary.h"
#include "subdiv/primitives.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edit_model.h"

namespace argil::subdiv {
namespace {

using namespace test;
using testing::HasSubstr;

template <class IdType>
EditModel::Tool collapsing(std::vector<IdType> ids, std::vector<VertexId> anchors = {}) {
  return [=](Transaction& t, const Eigen::Matrix3Xd&) { return collapse(t, ids, anchors); };
}

TEST(Collapse, AnEdgeOfAHexahedronLeavesAPolyhedron) {
  EditModel model(box_grid(1, 1, 1, {1, 1, 1}));
  const Edit edit = model.apply(collapsing(std::vector{model.edge({0, 0, 0}, {1, 0, 0})}));
  ASSERT_EQ(model.solid.cell_count(), 1u);
  EXPECT_EQ(model.solid.vertex_count(), 7u);
  EXPECT_EQ(model.solid.face_count(), 6u);
  EXPECT_EQ(edit.next_vertices.size(), 1u);
  EXPECT_EQ(edit.cells.size(), 1u);
  (void)model.vertex_at({0.5, 0, 0});
}

TEST(Collapse, FourEdgesOfALayerGlueTheLayersAboutIt) {
  EditModel model(box_grid(3, 1, 1, {3, 1, 1}));
  std::vector<EdgeId> edges;
  for (const double y : {0.0, 1.0})
    for (const double z : {0.0, 1.0}) edges.push_back(model.edge({1, y, z}, {2, y, z}));
  const Edit edit = model.apply(collapsing(edges));
  EXPECT_EQ(model.solid.cell_count(), 2u);
  EXPECT_EQ(model.solid.vertex_count(), 12u);
  EXPECT_EQ(model.solid.face_count(), 11u);
  EXPECT_EQ(components(model.solid).count, 1);
  EXPECT_EQ(edit.next_vertices.size(), 4u);
  EXPECT_NEAR(model.volume(), 3, 1e-14);
}

TEST(Collapse, AnInnerCellMakesItsNeighboursPyramids) {
  EditModel model(box_grid(3, 3, 3, {3, 3, 3}));
  model.apply(collapsing(std::vector{CellId{13u}}));
  EXPECT_EQ(model.solid.cell_count(), 26u);
  EXPECT_NEAR(model.volume(), 27, 1e-12);
  const VertexId centre = model.vertex_at({1.5, 1.5, 1.5});
  EXPECT_EQ(vertex_cells(model.solid, centre).size(), 26u);
  std::size_t pyramids = 0;
  for (const CellId c : model.solid.cells()) pyramids += cell_kind(model.solid, c) == CellKind::pyramid;
  EXPECT_EQ(pyramids, 6u);
}

TEST(Collapse, AFaceOfAHexahedronLeavesAPyramid) {
  EditModel model(box_grid(1, 1, 1, {1, 1, 1}));
  model.apply(collapsing(std::vector{model.face_at({0.5, 0.5, 1})}));
  EXPECT_EQ(cell_kind(model.solid, *model.solid.cells().begin()), CellKind::pyramid);
  (void)model.vertex_at({0.5, 0.5, 1});
  EXPECT_NEAR(model.volume(), 1.0 / 3, 1e-14);
}

TEST(Collapse, ATetrahedronVanishesAndItsNeighboursMeet) {
  EditModel model(build(octahedron_of_tetrahedra()));
  const Edit edit = model.apply(collapsing(std::vector{model.edge({1, 0, 0}, {0, 1, 0})}));
  EXPECT_EQ(model.solid.cell_count(), 6u);
  EXPECT_EQ(edit.cells.size() + 2, 4u);  // two of the edge's vertex vanished, the others were rewritten
  EXPECT_EQ(components(model.solid).count, 1);
}

TEST(Collapse, StandsOnThePinnedThenTheCornerThenTheCrease) {
  const auto at = [](const EditModel& model) { return model.at(VertexId{0u}); };
  EditModel free(box_grid(1, 1, 1, {1, 1, 1}));
  const std::vector edge{free.edge({0, 0, 0}, {1, 0, 0})};
  free.apply(collapsing(edge));
  EXPECT_EQ(at(free), Eigen::Vector3d(0.5, 0, 0));

  EditModel pinned(box_grid(1, 1, 1, {1, 1, 1}));
  pinned.apply(collapsing(edge, {VertexId{1u}}));
  EXPECT_EQ(at(pinned), Eigen::Vector3d(1, 0, 0));

  EditModel corner(box_grid(1, 1, 1, {1, 1, 1}));
  sharpen(corner.solid, {}, {VertexId{1u}});
  corner.apply(collapsing(edge));
  EXPECT_EQ(at(corner), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(corner.solid.vertex_sharpness(VertexId{0u}), k_infinitely_sharp);

  EditModel crease(box_grid(1, 1, 1, {1, 1, 1}));
  sharpen(crease.solid, {crease.edge({1, 0, 0}, {1, 1, 0})});
  crease.apply(collapsing(edge));
  EXPECT_EQ(at(crease), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(crease.solid.edge_sharpness(crease.edge({1, 0, 0}, {1, 1, 0})), k_infinitely_sharp);
}

TEST(Collapse, RefusesWhatWouldTouchItself) {
  // Two edges that share no vertex, at opposite corners of one face's diagonal.
  EditModel model(box_grid(1, 1, 1, {1, 1, 1}));
  EXPECT_THAT(model.refusal(collapsing(std::vector{CellId{0u}})), HasSubstr("nothing would be left"));
  EXPECT_THAT(model.refusal(collapsing(std::vector<EdgeId>{})), HasSubstr("select some first"));
  EXPECT_THAT(model.refusal(collapsing(std::vector{EdgeId{99u}})), HasSubstr("there is no edge 99"));

  // The ring's inner edges: its hole would close in one point, where cells meet like a fan around an axis.
  EditModel bar(box_grid(1, 1, 3, {1, 1, 3}));
  const std::vector ends{bar.edge({0, 0, 1}, {0, 0, 2}), bar.edge({1, 1, 1}, {1, 1, 2})};
  bar.apply(collapsing(ends));
  EXPECT_EQ(bar.solid.cell_count(), 3u);
}

}  // namespace
}  // namespace argil::subdiv
