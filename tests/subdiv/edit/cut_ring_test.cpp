#include "subdiv/edit/cut_ring.h"

#include <numbers>

#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edited.h"

namespace argil::subdiv {
namespace {

using namespace test;

EdgeId edge_at(const Built& built, const Eigen::Vector3d& middle) {
  for (const EdgeId e : built.solid.edges()) {
    const auto [a, b] = built.solid.edge_vertices(e);
    if (((point(built.positions, a) + point(built.positions, b)) / 2 - middle).norm() < 1e-9) return e;
  }
  return EdgeId{};
}
Edit cut(Built& built, const std::vector<EdgeId>& edges, double fraction = 0.5) {
  return edited(built.solid, built.positions,
                [&](Transaction& t, const auto&) { return cut_rings(t, edges, fraction); });
}
void expect_same_counts(const Solid& a, const Solid& b) {
  EXPECT_EQ(a.vertex_count(), b.vertex_count());
  EXPECT_EQ(a.edge_count(), b.edge_count());
  EXPECT_EQ(a.face_count(), b.face_count());
  EXPECT_EQ(cell_kind_counts(a), cell_kind_counts(b));
}

TEST(CutRing, ALayerOfAGridBecomesTwo) {
  Built built = box_grid(3, 3, 3, {3, 3, 3});
  const Edit edit = cut(built, {edge_at(built, {1.5, 0, 0})}, 0.25);
  expect_same_counts(built.solid, box_grid(4, 3, 3, {3, 3, 3}).solid);
  for (const PlacedVertex& p : edit.placed) EXPECT_DOUBLE_EQ(point(built.positions, p.vertex).x(), 1.25);
  EXPECT_EQ(edit.placed.size(), 16u);
  EXPECT_EQ(edit.next_edges.size(), 2u);
  EXPECT_EQ(edit.cells.size(), 18u);
}

TEST(CutRing, CrossingSheetsCutIntoFourAndEight) {
  Built built = box_grid(2, 2, 2, {2, 2, 2});
  cut(built, {edge_at(built, {0.5, 0, 0}), edge_at(built, {0, 0.5, 0}), edge_at(built, {0, 0, 0.5})}, 0.25);
  expect_same_counts(built.solid, box_grid(3, 3, 3, {2, 2, 2}).solid);
  for (const VertexId v : built.solid.vertices())
    for (const double x : point(built.positions, v)) EXPECT_TRUE(x == 0 || x == 0.25 || x == 1 || x == 2) << x;
  EXPECT_NEAR(volume(built.solid, built.positions), 8, 1e-13);
}

TEST(CutRing, OtherCellsKeepWholeAndGetTheCuts) {
  Built built = build(mixed_cells());
  const EdgeId up = edge_at(built, {0, 0, 0.5});
  ASSERT_TRUE(up.valid());
  cut(built, {up});
  const auto kinds = cell_kind_counts(built.solid);
  EXPECT_EQ(kinds[static_cast<std::size_t>(CellKind::pyramid)], 1u) << "its edges are not cut";
  // The wedge beside has eight corners now, and the faces of a box.
  EXPECT_EQ(kinds[static_cast<std::size_t>(CellKind::hexahedron)], 3u);
  EXPECT_EQ(built.solid.cell_count(), 5u);
}

TEST(CutRing, ARingAboutAHoleComesRound) {
  Built built = build(ring());
  const std::size_t before = built.solid.cell_count();
  cut(built, {edge_at(built, {0, 0, 0.5})});
  EXPECT_EQ(built.solid.cell_count(), 2 * before);
}

TEST(CutRing, ASheetThatCrossesItselfCutsIntoFour) {
  // About an edge of three boxes every sheet of the fan's rim turns into the next one.
  Built built = build(fan(3, 1));
  EdgeId spoke;
  for (const EdgeId e : built.solid.edges())
    if (built.solid.edge_vertices(e)[0] == VertexId{0u} && built.solid.edge_vertices(e)[1] == VertexId{1u})
      spoke = e;
  ASSERT_TRUE(spoke.valid());
  cut(built, {spoke});
  EXPECT_EQ(cell_kind_counts(built.solid)[static_cast<std::size_t>(CellKind::hexahedron)],
            built.solid.cell_count());
}

// Six boxes in a ring, the last joined to the first with a half turn.
CellLists moebius_ring() {
  CellLists lists;
  lists.positions.resize(3, 24);
  for (std::uint32_t i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi / 3 * i, half = angle / 2;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    const Eigen::Vector3d u = std::cos(half) * out + std::sin(half) * up,
                          v = std::cos(half) * up - std::sin(half) * out;
    const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (std::uint32_t k = 0; k < 4; ++k)
      lists.positions.col(4 * i + k) = 4 * out + signs[k][0] * u + signs[k][1] * v;
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t n = 4 * ((i + 1) % 6), turn = i == 5 ? 2 : 0;
    add_cell(lists, CellKind::hexahedron,
             {4 * i + 3, 4 * i + 2, 4 * i + 1, 4 * i, n + (3 + turn) % 4, n + (2 + turn) % 4, n + (1 + turn) % 4,
              n + turn % 4});
  }
  return lists;
}

TEST(CutRing, AMoebiusBandHasNoTwoSidesAndIsCutInTheMiddleOnly) {
  Built built = build(moebius_ring());
  const EdgeId across = *built.solid.find_edge(VertexId{0u}, VertexId{1u});
  EXPECT_EQ(fault(built.solid, built.positions,
                  [&](Transaction& t, const auto&) { return cut_rings(t, std::array{across}, 0.3); }),
            ErrorCode::bad_topology);
  cut(built, {across});
  EXPECT_EQ(built.solid.cell_count(), 12u);
}

TEST(CutRing, RefusesBadFractionsAndEdges) {
  Built built = box_grid(1, 1, 1, {1, 1, 1});
  const auto code = [&](std::vector<EdgeId> edges, double fraction) {
    return fault(built.solid, built.positions,
                 [&](Transaction& t, const auto&) { return cut_rings(t, edges, fraction); });
  };
  EXPECT_EQ(code({EdgeId{0u}}, 0), ErrorCode::bad_input);
  EXPECT_EQ(code({EdgeId{0u}}, 1), ErrorCode::bad_input);
  EXPECT_EQ(code({EdgeId{0u}}, std::nan("")), ErrorCode::bad_input);
  EXPECT_EQ(code({}, 0.5), ErrorCode::bad_input);
  EXPECT_EQ(code({EdgeId{77u}}, 0.5), ErrorCode::not_found);
}

}  // namespace
}  // namespace argil::subdiv
