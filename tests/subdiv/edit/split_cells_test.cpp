#include "subdiv/edit/split_cells.h"

#include "subdiv/build.h"
#include "subdiv/edit/cuts.h"
#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "subdiv/refinement_step.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edited.h"

namespace argil::subdiv {
namespace {

using namespace test;

Edit split(Solid& solid, Eigen::Matrix3Xd& positions, const std::vector<CellId>& cells) {
  return edited(solid, positions, [&](Transaction& t, const auto&) { return split_cells(t, cells); });
}
std::vector<CellId> all_cells(const Solid& solid) {
  return {solid.cells().begin(), solid.cells().end()};
}

TEST(SplitCells, AllOfThemMakeTheSameTopologyAsARefinement) {
  for (Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const RefinementStep step = refine(shape.solid);
    split(shape.solid, shape.positions, all_cells(shape.solid));
    EXPECT_EQ(shape.solid.vertex_count(), step.fine.vertex_count());
    EXPECT_EQ(shape.solid.edge_count(), step.fine.edge_count());
    EXPECT_EQ(shape.solid.face_count(), step.fine.face_count());
    EXPECT_EQ(shape.solid.cell_count(), step.fine.cell_count());
    EXPECT_EQ(cell_kind_counts(shape.solid), cell_kind_counts(step.fine));
    double sharp = 0, sharp_fine = 0;
    for (const EdgeId e : shape.solid.edges()) sharp += shape.solid.edge_sharpness(e);
    for (const EdgeId e : step.fine.edges()) sharp_fine += step.fine.edge_sharpness(e);
    EXPECT_EQ(sharp, sharp_fine);
  }
}

TEST(SplitCells, ABoxGivesEightEqualOnesAndItsNeighboursGetTheCuts) {
  Built built = box_grid(3, 3, 3, {3, 3, 3});
  const CellId middle{13u};
  const Edit edit = split(built.solid, built.positions, {middle});
  EXPECT_EQ(edit.next_cells.size(), 8u);
  for (const CellId c : edit.next_cells) {
    EXPECT_EQ(cell_kind(built.solid, c), CellKind::hexahedron);
    EXPECT_NEAR(cell_volume(built.solid, built.positions, c), 0.125, 1e-15);
  }
  EXPECT_EQ(built.solid.cell_count(), 34u);
  // Six neighbours have a face in four, twelve only a cut edge, eight corners stay.
  std::map<std::size_t, int> faces, corners;
  for (const CellId c : built.solid.cells()) {
    ++faces[built.solid.cell_face_uses(c).size()];
    ++corners[cell_vertices(built.solid, c).size()];
    if (cell_vertices(built.solid, c).size() > 8) {
      EXPECT_NEAR(cell_volume(built.solid, built.positions, c), 1, 1e-14);
    }
  }
  EXPECT_EQ(faces, (std::map<std::size_t, int>{{6, 28}, {9, 6}}));
  EXPECT_EQ(corners, (std::map<std::size_t, int>{{8, 16}, {9, 12}, {13, 6}}));
  // Everything that was made knows where it comes from.
  for (const auto& [made, source] : edit.cells)
    EXPECT_TRUE(built.solid.is_live(made) && !built.solid.is_live(source));
  EXPECT_EQ(edit.cells.size(), 8u + 18u);
  EXPECT_EQ(edit.faces.size(), 6u * 4 + 24u);
  EXPECT_EQ(edit.edges.size(), 24u);
}

TEST(SplitCells, FacesBetweenCellsSplitOnce) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  split(built.solid, built.positions, {CellId{1u}, CellId{0u}});
  const Built fine = box_grid(4, 2, 2, {2, 1, 1});
  EXPECT_EQ(built.solid.face_count(), fine.solid.face_count());
  EXPECT_EQ(built.solid.vertex_count(), fine.solid.vertex_count());
}

TEST(SplitCells, AgainOnTheChildrenIsToldByWhatWasThereBefore) {
  Built built = box_grid(2, 2, 2, {2, 2, 2});
  const Edit edit = edited(built.solid, built.positions, [](Transaction& t, const auto&) {
    Edit all = split_cells(t, std::array{CellId{0u}});
    const auto children = all.next_cells;
    append_edit(all, split_cells(t, children));
    return all;
  });
  EXPECT_EQ(edit.next_cells.size(), 64u);
  EXPECT_NEAR(volume(built.solid, built.positions), 8, 1e-14);
  for (const CellId c : edit.next_cells) {
    EXPECT_NEAR(cell_volume(built.solid, built.positions, c), 1.0 / 64, 1e-15);
    EXPECT_EQ(std::count_if(edit.cells.begin(), edit.cells.end(),
                            [&](const auto& d) { return d.made == c && d.source == CellId{0u}; }),
              1);
  }
}

TEST(SplitCells, CreasesAndSheetsKeepTheirSharpness) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  FaceId wall;
  for (const FaceId f : built.solid.faces())
    if (!built.solid.is_boundary(f)) wall = f;
  const EdgeId crease = *built.solid.find_edge(VertexId{0u}, VertexId{1u});
  {
    Transaction t(built.solid);
    t.set_sharpness(crease, k_infinitely_sharp);
    t.set_sharpness(wall, 3);
    (void)t.commit();
  }
  const Edit edit = split(built.solid, built.positions, {CellId{0u}});
  int halves = 0, quarters = 0;
  for (const auto& [made, source] : edit.edges)
    if (source == crease) halves += built.solid.edge_sharpness(made) == k_infinitely_sharp;
  for (const auto& [made, source] : edit.faces)
    if (source == wall) quarters += built.solid.face_sharpness(made) == 3;
  EXPECT_EQ(halves, 2);
  EXPECT_EQ(quarters, 4);
  double sum = 0;
  for (const EdgeId e : built.solid.edges()) sum += built.solid.edge_sharpness(e);
  EXPECT_EQ(sum, 2 * k_infinitely_sharp) << "new inner edges are smooth";
}

TEST(SplitCells, RefusesWhatIsNotThere) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  const auto code = [&](std::vector<CellId> cells) {
    return fault(built.solid, built.positions, [&](Transaction& t, const auto&) { return split_cells(t, cells); });
  };
  EXPECT_EQ(code({}), ErrorCode::bad_input);
  EXPECT_EQ(code({CellId{7u}}), ErrorCode::not_found);
  EXPECT_EQ(code({CellId{0u}, CellId{0u}}), ErrorCode::not_found);
}

}  // namespace
}  // namespace argil::subdiv
