#include "subdiv/edit/fill.h"

#include "subdiv/boundary.h"
#include "subdiv/primitives.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edit_model.h"

namespace argil::subdiv {
namespace {

using namespace test;
using testing::HasSubstr;

EditModel::Tool filling(std::vector<FaceId> faces) {
  return [=](Transaction& t, const Eigen::Matrix3Xd& p) { return fill(t, p, faces); };
}

EditModel grid_without(int nx, int ny, int nz, CellId gone) {
  Built built = box_grid(nx, ny, nz, {double(nx), double(ny), double(nz)});
  Transaction t(built.solid);
  t.remove_cell(gone);
  (void)t.commit();
  return EditModel(std::move(built));
}
auto near(const Eigen::Vector3d& middle) {
  return [=](const Eigen::Vector3d& m) { return (m - middle).norm() < 0.6; };
}

TEST(Fill, AVoidInsideBecomesTheCellThatWasThere) {
  EditModel model = grid_without(3, 3, 3, CellId{13u});
  EXPECT_EQ(boundary_surface(model.solid).component_count, 2u);
  const Edit edit = model.apply(filling(model.boundary_faces(near({1.5, 1.5, 1.5}))));
  EXPECT_EQ(boundary_surface(model.solid).component_count, 1u);
  EXPECT_EQ(model.solid.cell_count(), 27u);
  EXPECT_NEAR(model.volume(), 27, 1e-12);
  EXPECT_EQ(edit.next_cells.size(), 1u);
  EXPECT_EQ(edit.next_faces.size(), 0u);
}

TEST(Fill, APitGetsACapThatIsSelected) {
  EditModel model = grid_without(3, 3, 2, CellId{13u});
  const Edit edit = model.apply(filling(model.boundary_faces(near({1.5, 1.5, 1.5}))));
  ASSERT_EQ(edit.next_faces.size(), 1u);
  EXPECT_EQ(model.solid.face_vertices(edit.next_faces[0]).size(), 4u);
  EXPECT_NEAR(model.volume(), 18, 1e-12);
}

TEST(Fill, ATunnelIsPluggedWithTwoCaps) {
  EditModel model = grid_without(3, 3, 1, CellId{4u});
  EXPECT_EQ(boundary_surface(model.solid).genus, 1);
  const Edit edit = model.apply(filling(model.boundary_faces(near({1.5, 1.5, 0.5}))));
  EXPECT_EQ(edit.next_faces.size(), 2u);
  EXPECT_EQ(boundary_surface(model.solid).genus, 0);
  EXPECT_NEAR(model.volume(), 9, 1e-12);
}

TEST(Fill, ANotchIsFilledFlushWithItsSides) {
  EditModel model = grid_without(3, 1, 2, CellId{4u});
  const Edit edit = model.apply(filling(model.boundary_faces(near({1.5, 0.5, 1.5}))));
  EXPECT_EQ(edit.next_faces.size(), 3u);
  EXPECT_NEAR(model.volume(), 6, 1e-14);
  EXPECT_EQ(cell_kind(model.solid, edit.next_cells[0]), CellKind::hexahedron);
}

TEST(Fill, SeveralOpeningsGetACellEach) {
  Built built = box_grid(5, 3, 3, {5, 3, 3});
  {
    Transaction t(built.solid);
    t.remove_cell(CellId{21u});
    t.remove_cell(CellId{23u});
    (void)t.commit();
  }
  EditModel model(std::move(built));
  auto faces = model.boundary_faces(near({1.5, 1.5, 1.5}));
  for (const FaceId f : model.boundary_faces(near({3.5, 1.5, 1.5}))) faces.push_back(f);
  EXPECT_EQ(model.apply(filling(faces)).next_cells.size(), 2u);
  EXPECT_NEAR(model.volume(), 45, 1e-12);
}

TEST(Fill, TheGapOfTwoBoxesThatTouchInAnEdgeIsClosed) {
  EditModel model(build(cubes({{0, 0, 0}, {1, 1, 0}})));
  model.apply(filling({model.face_at({1, 0.5, 0.5}), model.face_at({1.5, 1, 0.5})}));
  EXPECT_NEAR(model.volume(), 2.5, 1e-14);
  EXPECT_EQ(radial_fans(model.solid, model.edge({1, 1, 0}, {1, 1, 1})).size(), 1u);
}

TEST(Fill, SharpnessOfWhatBecomesInteriorGoes) {
  EditModel model = grid_without(3, 3, 3, CellId{13u});
  std::vector<EdgeId> edges;
  for (const FaceId f : model.boundary_faces(near({1.5, 1.5, 1.5})))
    for (const EdgeId e : model.solid.face_edges(f)) edges.push_back(e);
  sharpen(model.solid, edges);
  model.apply(filling(model.boundary_faces(near({1.5, 1.5, 1.5}))));
  for (const EdgeId e : edges) EXPECT_EQ(model.solid.edge_sharpness(e), 0);
}

TEST(Fill, SaysWhyThereIsNothingToFill) {
  EditModel model = grid_without(3, 3, 2, CellId{13u});
  EXPECT_THAT(model.refusal(filling({model.face_at({0.5, 0.5, 2})})), HasSubstr("is no opening"));
  EXPECT_THAT(model.refusal(filling({model.face_at({0.5, 0.5, 2}), model.face_at({0.5, 0, 1.5})})),
              HasSubstr("volume"));
  EXPECT_THAT(model.refusal(filling({model.face_at({0.5, 0.5, 2}), model.face_at({1.5, 0.5, 2})})),
              HasSubstr("volume"));
  EXPECT_THAT(model.refusal(filling({})), HasSubstr("select some first"));
  // Floor and nothing else but two sides that meet it at a vertex each.
  EditModel cross = grid_without(3, 3, 2, CellId{13u});
  EXPECT_THAT(cross.refusal(filling({cross.face_at({1, 1.5, 1.5}), cross.face_at({2, 1.5, 1.5})})),
              HasSubstr("is no opening"));
}

}  // namespace
}  // namespace argil::subdiv
