#include "subdiv/edit/bridge.h"

#include <array>
#include <cmath>
#include <numbers>

#include "subdiv/boundary.h"
#include "subdiv/primitives.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edit_model.h"

namespace argil::subdiv {
namespace {

using namespace test;
using testing::HasSubstr;

EditModel::Tool bridging(std::vector<FaceId> first, std::vector<FaceId> second, BridgeOptions options = {}) {
  return [=](Transaction& t, const Eigen::Matrix3Xd& p) { return bridge(t, p, first, second, options); };
}
auto at_x(double x) {
  return [x](const Eigen::Vector3d& m) { return m.x() == x; };
}
EditModel two_cubes() {
  return EditModel(build(cubes({{0, 0, 0}, {3, 0, 0}})));
}

TEST(Bridge, StraightStepsDivideTheWay) {
  EditModel model = two_cubes();
  const Edit edit =
      model.apply(bridging(model.boundary_faces(at_x(1)), model.boundary_faces(at_x(3)), {.steps = 4}));
  EXPECT_EQ(edit.next_cells.size(), 4u);
  EXPECT_EQ(components(model.solid).count, 1);
  EXPECT_EQ(model.solid.vertex_count(), 28u);
  EXPECT_NEAR(model.volume(), 4, 1e-14);
  for (const double x : {1.5, 2.0, 2.5}) (void)model.vertex_at({x, 1, 1});
  for (const CellId c : edit.next_cells) EXPECT_NEAR(cell_volume(model.solid, model.positions, c), 0.5, 1e-14);
}

TEST(Bridge, RegionsShareTheirWalls) {
  Built built = box_grid(3, 2, 3, {3, 2, 3});
  {
    Transaction t(built.solid);
    for (std::size_t c = 1; c < 18; c += 3) t.remove_cell(CellId{c});
    (void)t.commit();
  }
  EditModel model(shuffled(built, 3));
  model.apply(bridging(model.boundary_faces(at_x(1)), model.boundary_faces(at_x(2))));
  const Built whole = box_grid(3, 2, 3, {3, 2, 3});
  EXPECT_EQ(model.solid.face_count(), whole.solid.face_count());
  EXPECT_EQ(model.solid.edge_count(), whole.solid.edge_count());
  EXPECT_EQ(model.solid.cell_count(), 18u);
  EXPECT_NEAR(model.volume(), 18, 1e-12);
}

TEST(Bridge, WithinOnePartItMakesAHandle) {
  EditModel model(build(cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {2, 2, 0}})));
  model.apply(bridging({model.face_at({1, 2.5, 0.5})}, {model.face_at({2, 2.5, 0.5})}));
  EXPECT_EQ(boundary_surface(model.solid).genus, 1);
  EXPECT_NEAR(model.volume(), 8, 1e-14);
}

TEST(Bridge, ANotchIsFilledFlushAndItsFloorGlued) {
  EditModel model(build(cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 0, 1}})));
  model.apply(bridging({model.face_at({1, 0.5, 1.5})}, {model.face_at({2, 0.5, 1.5})}));
  EXPECT_NEAR(model.volume(), 6, 1e-14);
  const Built whole = box_grid(3, 1, 2, {3, 1, 2});
  EXPECT_EQ(model.solid.face_count(), whole.solid.face_count());
}

TEST(Bridge, ArcBetweenEqualNormalsIsHalfARing) {
  EditModel model(build(cubes({{0, 0, 0}, {3, 0, 0}})));
  const int steps = 16;
  const Edit edit = model.apply(
      bridging({model.face_at({0.5, 0.5, 1})}, {model.face_at({3.5, 0.5, 1})}, {.steps = steps, .arc = true}));
  // About (2, y, 1): inner radius 1, outer radius 2. A Hermite curve leaves the circle by less than 0.02 of its
  // radius.
  for (const PlacedVertex& p : edit.placed) {
    const Eigen::Vector3d at = model.at(p.vertex);
    const double radius = std::hypot(at.x() - 2, at.z() - 1);
    EXPECT_LT(std::min(std::abs(radius - 1), std::abs(radius - 2) / 2), 0.02);
    EXPECT_GT(at.z(), 1);
    EXPECT_TRUE(at.y() == 0 || at.y() == 1);
  }
  double volume = 0;
  for (const CellId c : edit.next_cells) {
    EXPECT_GT(cell_volume(model.solid, model.positions, c), 0);
    volume += cell_volume(model.solid, model.positions, c);
  }
  EXPECT_NEAR(volume, std::numbers::pi * 1.5, 0.1);
}

TEST(Bridge, TwoTopsThatLeanAreNotTwistedAgainstEachOther) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    EditModel model(build(cubes({{0, 0, 0}, {3, 0, 0}})));
    const FaceId a = model.face_at({0.5, 0.5, 1}), b = model.face_at({3.5, 0.5, 1});
    model.positions = jittered(model.positions, 0.15, seed);
    const Edit edit = model.apply(bridging({a}, {b}, {.steps = 6, .arc = true}));
    for (const CellId c : edit.next_cells) EXPECT_GT(cell_volume(model.solid, model.positions, c), 0) << seed;
  }
}

TEST(Bridge, ATwistTurnsTheFarEnd) {
  for (const int twist : {1, -1, 5}) {
    EditModel model = two_cubes();
    const Edit edit = model.apply(
        bridging(model.boundary_faces(at_x(1)), model.boundary_faces(at_x(3)), {.steps = 2, .twist = twist}));
    // Half way through a quarter turn the straight lines have come to the middles of the sides.
    ASSERT_EQ(edit.placed.size(), 4u);
    for (const PlacedVertex& p : edit.placed)
      EXPECT_NEAR((model.at(p.vertex) - Eigen::Vector3d(2, 0.5, 0.5)).norm(), 0.5, 1e-14);
  }
}

TEST(Bridge, FacesThatShareAnEdgeGetLeavesAboutIt) {
  EditModel model(build(cubes({{0, 0, 0}, {1, 1, 0}})));
  const FaceId a = model.face_at({1, 0.5, 0.5}), b = model.face_at({1.5, 1, 0.5});
  const Edit edit = model.apply(bridging({a}, {b}, {.steps = 2}));
  for (const CellId c : edit.next_cells) {
    EXPECT_EQ(cell_kind(model.solid, c), CellKind::wedge);
    EXPECT_GT(cell_volume(model.solid, model.positions, c), 0);
  }
  EXPECT_EQ(radial_fans(model.solid, model.edge({1, 1, 0}, {1, 1, 1})).size(), 1u);
}

TEST(Bridge, SharpCornersLeaveSharpEdgesAndRingsAreSmooth) {
  EditModel model = two_cubes();
  sharpen(model.solid, box_edges(model.solid));
  model.apply(bridging(model.boundary_faces(at_x(1)), model.boundary_faces(at_x(3)), {.steps = 2}));
  EXPECT_EQ(model.solid.edge_sharpness(model.edge({1, 0, 0}, {2, 0, 0})), k_infinitely_sharp);
  EXPECT_EQ(model.solid.edge_sharpness(model.edge({2, 0, 0}, {3, 0, 0})), k_infinitely_sharp);
  EXPECT_EQ(model.solid.edge_sharpness(model.edge({2, 0, 0}, {2, 1, 0})), 0);
  EXPECT_EQ(model.solid.edge_sharpness(model.edge({1, 0, 0}, {1, 1, 0})), k_infinitely_sharp);

  EditModel smooth = two_cubes();
  smooth.apply(bridging(smooth.boundary_faces(at_x(1)), smooth.boundary_faces(at_x(3))));
  EXPECT_EQ(smooth.solid.edge_sharpness(smooth.edge({1, 0, 0}, {3, 0, 0})), 0);
}

TEST(Bridge, SaysWhatItNeeds) {
  EditModel model = two_cubes();
  const auto a = model.boundary_faces(at_x(1)), b = model.boundary_faces(at_x(3));
  EXPECT_THAT(model.refusal(bridging(a, b, {.steps = 0})), HasSubstr("at least 1 step, found 0"));
  EXPECT_THAT(model.refusal(bridging(a, {})), HasSubstr("expected"));
  EXPECT_THAT(model.refusal(bridging(a, a)), HasSubstr("lies in both"));
  Built grid = box_grid(3, 2, 1, {3, 2, 1});
  {
    Transaction t(grid.solid);
    t.remove_cell(CellId{1u});
    t.remove_cell(CellId{4u});
    (void)t.commit();
  }
  EditModel regions(std::move(grid));
  EXPECT_THAT(
      regions.refusal(bridging(regions.boundary_faces(at_x(1)), regions.boundary_faces(at_x(2)), {.twist = 1})),
      HasSubstr("single faces to twist"));
  // A second bridge between the same faces would lie in the first.
  EditModel once = two_cubes();
  once.apply(bridging(a, b));
  EXPECT_THAT(once.refusal(bridging(a, b)), HasSubstr("inside the solid"));
}

}  // namespace
}  // namespace argil::subdiv
