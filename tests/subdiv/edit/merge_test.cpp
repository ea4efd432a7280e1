#include "subdiv/edit/merge.h"

#include "subdiv/boundary.h"
#include "subdiv/primitives.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edit_model.h"

namespace argil::subdiv {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::IsEmpty;

EditModel::Tool gluing(std::vector<FaceId> first, std::vector<FaceId> second, MergeAt at = MergeAt::middle) {
  return [=](Transaction& t, const Eigen::Matrix3Xd& p) { return merge(t, p, first, second, at); };
}
auto at_x(double x) {
  return [x](const Eigen::Vector3d& m) { return m.x() == x; };
}

// Two cubes, the second from x = 2 to 3.
EditModel two_cubes() {
  return EditModel(build(cubes({{0, 0, 0}, {2, 0, 0}})));
}

TEST(Merge, TwoCubesBecomeABarAndMeetInTheMiddle) {
  EditModel model = two_cubes();
  const Edit edit = model.apply(gluing(model.boundary_faces(at_x(1)), model.boundary_faces(at_x(2))));
  EXPECT_EQ(model.solid.vertex_count(), 12u);
  EXPECT_EQ(model.solid.edge_count(), 20u);
  EXPECT_EQ(model.solid.face_count(), 11u);
  EXPECT_EQ(components(model.solid).count, 1);
  EXPECT_EQ(edit.merged.size(), 4u);
  EXPECT_EQ(edit.placed.size(), 4u);
  EXPECT_NEAR(model.volume(), 3, 1e-14);
  for (const double y : {0.0, 1.0})
    for (const double z : {0.0, 1.0}) {
      (void)model.vertex_at({1.5, y, z});
      (void)model.vertex_at({0, y, z});
      (void)model.vertex_at({3, y, z});
    }
}

TEST(Merge, StandsOnTheFirstOrTheSecondRegion) {
  for (const bool first : {true, false}) {
    EditModel model = two_cubes();
    model.apply(gluing(model.boundary_faces(at_x(1)), model.boundary_faces(at_x(2)),
                       first ? MergeAt::first : MergeAt::second));
    for (const double y : {0.0, 1.0}) (void)model.vertex_at({first ? 1.0 : 2.0, y, 1});
    EXPECT_NEAR(model.volume(), 3, 1e-14);
  }
}

TEST(Merge, RegionsOfManyFacesMatchFaceByFace) {
  Built built = box_grid(5, 3, 2, {5, 3, 2});
  {
    Transaction t(built.solid);
    for (std::size_t c = 2; c < 30; c += 5) t.remove_cell(CellId{c});
    (void)t.commit();
  }
  EditModel model(shuffled(built, 7));
  model.apply(gluing(model.boundary_faces(at_x(2)), model.boundary_faces(at_x(3))));
  const Built whole = box_grid(4, 3, 2, {4, 3, 2});
  EXPECT_EQ(model.solid.vertex_count(), whole.solid.vertex_count());
  EXPECT_EQ(model.solid.edge_count(), whole.solid.edge_count());
  EXPECT_EQ(model.solid.face_count(), whole.solid.face_count());
  EXPECT_NEAR(model.volume(), 30, 1e-12);
}

TEST(Merge, ARingThatClosesHasAHandle) {
  // Seven of the ring's eight cubes: the gap's two faces are glued at the middle.
  EditModel model(build(cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}})));
  EXPECT_EQ(boundary_surface(model.solid).genus, 0);
  model.apply(gluing({model.face_at({0.5, 1, 0.5})}, {model.face_at({0.5, 2, 0.5})}));
  EXPECT_EQ(boundary_surface(model.solid).genus, 1);
  EXPECT_EQ(components(model.solid).count, 1);
}

TEST(Merge, TwoPartsThatAreGluedAtTwoPlacesHaveAHandle) {
  // Two bows of three cubes, tips towards each other.
  EditModel model(build(cubes({{0, 0, 0},
                               {0, 1, 0},
                               {0, 2, 0},
                               {1, 0, 0},
                               {1, 2, 0},  //
                               {4, 0, 0},
                               {4, 1, 0},
                               {4, 2, 0},
                               {3, 0, 0},
                               {3, 2, 0}})));
  EXPECT_EQ(components(model.solid).count, 2);
  model.apply(gluing({model.face_at({2, 0.5, 0.5})}, {model.face_at({3, 0.5, 0.5})}));
  EXPECT_EQ(components(model.solid).count, 1);
  EXPECT_EQ(boundary_surface(model.solid).genus, 0);
  model.apply(gluing({model.face_at({2, 2.5, 0.5})}, {model.face_at({3, 2.5, 0.5})}));
  EXPECT_EQ(boundary_surface(model.solid).genus, 1);
}

TEST(Merge, AWedgeShapedGapIsZippedAlongItsEdge) {
  // Three wedges about an axis; the first and the third face each other across the fourth quarter.
  EditModel model(build(wedges_about_edge(3, false)));
  std::vector<FaceId> gap;
  model.solid.for_each_face(model.edge({0, 0, 0}, {0, 0, 1}), [&](FaceId f) {
    if (model.solid.is_boundary(f)) gap.push_back(f);
  });
  ASSERT_EQ(gap.size(), 2u);
  const Edit edit = model.apply(gluing({gap[0]}, {gap[1]}));
  EXPECT_EQ(edit.merged.size(), 2u);
  const EdgeId axis = model.edge({0, 0, 0}, {0, 0, 1});
  EXPECT_FALSE(model.solid.is_boundary(axis));
  EXPECT_EQ(model.solid.edge_valence(axis), 3u);
}

TEST(Merge, CubesThatShareAnEdgeFoldTogether) {
  EditModel model(build(cubes({{0, 0, 0}, {1, 1, 0}})));
  model.apply(gluing({model.face_at({1, 0.5, 0.5})}, {model.face_at({1.5, 1, 0.5})}));
  EXPECT_EQ(model.solid.face_count(), 11u);
  EXPECT_EQ(model.solid.vertex_count(), 12u);
  EXPECT_EQ(boundary_surface(model.solid).component_count, 1u);
}

TEST(Merge, ShortestWayWinsAmongTheFourThatFit) {
  EditModel model = two_cubes();
  Transaction t(model.solid);
  const Edit edit = merge(t, model.positions, model.boundary_faces(at_x(1)), model.boundary_faces(at_x(2)));
  for (const PlacedVertex& placed : edit.placed)
    EXPECT_EQ((model.at(placed.sources[0].first) - model.at(placed.sources[1].first)).norm(), 1);
}

TEST(Merge, CellsAndFacesThatAreRewrittenDescendFromWhatTheyWere) {
  EditModel model = two_cubes();
  const Solid old = model.solid;
  const Edit edit = model.apply(gluing(model.boundary_faces(at_x(1)), model.boundary_faces(at_x(2))));
  std::vector<CellId> lost;
  for (const CellId c : old.cells())
    if (!model.solid.is_live(c)) lost.push_back(c);
  ASSERT_EQ(lost.size(), 1u);
  ASSERT_EQ(edit.cells.size(), 1u);
  EXPECT_EQ(edit.cells[0].source, lost[0]);
  const auto parts = [](const auto& descent, auto source) {
    return std::count_if(descent.begin(), descent.end(), [&](const auto& d) { return d.source == source; });
  };
  for (const FaceId f : old.faces()) EXPECT_EQ(parts(edit.faces, f), model.solid.is_live(f) ? 0 : 1);
  for (const EdgeId e : old.edges()) EXPECT_EQ(parts(edit.edges, e), model.solid.is_live(e) ? 0 : 1);
}

TEST(Merge, RimStaysSharpAndWhatIsInsideIsSmooth) {
  Built built = box_grid(5, 2, 2, {5, 2, 2});
  {
    Transaction t(built.solid);
    for (std::size_t c = 2; c < 20; c += 5) t.remove_cell(CellId{c});
    (void)t.commit();
  }
  EditModel model(std::move(built));
  sharpen(model.solid, box_edges(model.solid));
  model.apply(gluing(model.boundary_faces(at_x(2)), model.boundary_faces(at_x(3))));
  EXPECT_EQ(model.solid.edge_sharpness(model.edge({2.5, 0, 0}, {2.5, 1, 0})), k_infinitely_sharp);
  EXPECT_EQ(model.solid.edge_sharpness(model.edge({1, 0, 0}, {2.5, 0, 0})), k_infinitely_sharp);
  EXPECT_EQ(model.solid.edge_sharpness(model.edge({4, 0, 0}, {2.5, 0, 0})), k_infinitely_sharp);
  EXPECT_EQ(model.solid.edge_sharpness(model.edge({2.5, 1, 0}, {2.5, 1, 1})), 0);
}

TEST(Merge, PolygonsOfAnySizeGlue) {
  CellLists lists = dodecahedron();
  const auto count = static_cast<std::uint32_t>(lists.positions.cols());
  const auto first = lists.connectivity;
  lists.positions.conservativeResize(3, 2 * count);
  lists.positions.rightCols(count) = lists.positions.leftCols(count).eval().colwise() + Eigen::Vector3d(4, 0, 0);
  lists.kinds.push_back(CellKind::polyhedron);
  lists.connectivity.push_back(first[0]);
  for (std::size_t i = 1; i < first.size(); i += first[i] + 1) {
    lists.connectivity.push_back(first[i]);
    for (std::uint32_t k = 1; k <= first[i]; ++k) lists.connectivity.push_back(first[i + k] + count);
  }
  lists.offsets.push_back(lists.connectivity.size());
  EditModel two(build(lists));
  two.apply(gluing({FaceId{0u}}, {FaceId{12u}}));
  EXPECT_EQ(two.solid.vertex_count(), 35u);
  EXPECT_EQ(two.solid.face_count(), 23u);
  EXPECT_EQ(components(two.solid).count, 1);
}

TEST(Merge, SaysHowShapesDiffer) {
  EditModel model(build(mixed_cells()));
  FaceId triangle, quadrilateral;
  for (const FaceId f : model.solid.faces())
    if (model.solid.is_boundary(f)) (model.solid.face_vertices(f).size() == 3 ? triangle : quadrilateral) = f;
  EXPECT_THAT(model.refusal(gluing({triangle}, {quadrilateral})), HasSubstr("has 3 vertices where"));

  EditModel boxes = two_cubes();
  const auto right = boxes.boundary_faces([](const Eigen::Vector3d& m) { return m.x() > 1.5; });
  EXPECT_THAT(boxes.refusal(gluing(boxes.boundary_faces(at_x(1)), {right[0], right[1]})),
              testing::AnyOf(HasSubstr("the first has 1 and the second 2 faces"), HasSubstr("found one of 2")));
  EXPECT_THAT(boxes.refusal(gluing({right[0]}, {right[0]})), HasSubstr("twice, or lies in both"));
  EXPECT_THAT(boxes.refusal(gluing({}, right)), HasSubstr("expected"));
  EXPECT_THAT(boxes.refusal(gluing({FaceId{999u}}, {right[0]})), HasSubstr("no face 999"));
}

TEST(Merge, ACellThatWouldTouchItselfIsNamed) {
  EditModel cube(box_grid(1, 1, 1, {1, 1, 1}));
  EXPECT_THAT(cube.refusal(gluing({cube.face_at({0, 0.5, 0.5})}, {cube.face_at({1, 0.5, 0.5})})),
              HasSubstr("same cell 0"));
  EditModel bar(box_grid(2, 1, 1, {2, 1, 1}));
  EXPECT_THAT(bar.refusal(gluing({bar.face_at({0.5, 1, 0.5})}, {bar.face_at({1.5, 0, 0.5})})),
              HasSubstr("would touch itself"));
}

TEST(Merge, EndsOfABarMakeARing) {
  EditModel bar(box_grid(3, 1, 1, {3, 1, 1}));
  bar.apply(gluing({bar.face_at({0, 0.5, 0.5})}, {bar.face_at({3, 0.5, 0.5})}));
  EXPECT_EQ(boundary_surface(bar.solid).genus, 1);
  EXPECT_EQ(bar.solid.vertex_count(), 12u);
}

}  // namespace
}  // namespace argil::subdiv
