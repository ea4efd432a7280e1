#include "subdiv/radial_edge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/build.h"
#include "subdiv/primitives.h"
#include "subdiv/transaction.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;

EdgeId axis_edge(const Solid& solid) {
  return *solid.find_edge(VertexId{0u}, VertexId{1u});
}

// faces[i] and faces[i+1] bound cells[i].
void expect_fan_is_consistent(const Solid& solid, const RadialFan& fan, EdgeId edge) {
  ASSERT_EQ(fan.cells.size() + (fan.closed ? 0 : 1), fan.faces.size());
  for (std::size_t i = 0; i < fan.cells.size(); ++i) {
    const FaceId a = fan.faces[i], b = fan.faces[(i + 1) % fan.faces.size()];
    const FaceUseId use = face_use(a, solid.owner(face_use(a, false)) != fan.cells[i]);
    EXPECT_EQ(solid.owner(use), fan.cells[i]);
    EXPECT_EQ(face_of(mate(solid, use, edge)), b);
    EXPECT_EQ(solid.owner(mate(solid, use, edge)), fan.cells[i]);
  }
}

TEST(RadialEdge, ClosedFanTurnsFromItsLowestFaceThroughTheOwnerOfTheFrontUse) {
  const Built built = build(wedges_about_edge(5, true));
  const auto fans = radial_fans(built.solid, axis_edge(built.solid));
  ASSERT_EQ(fans.size(), 1u);
  EXPECT_TRUE(fans[0].closed);
  EXPECT_EQ(fans[0].faces.size(), 5u);
  EXPECT_EQ(fans[0].faces[0], *std::min_element(fans[0].faces.begin(), fans[0].faces.end()));
  EXPECT_EQ(fans[0].cells[0], built.solid.owner(face_use(fans[0].faces[0], false)));
  expect_fan_is_consistent(built.solid, fans[0], axis_edge(built.solid));
}

TEST(RadialEdge, OpenFanRunsBetweenBoundaryFaces) {
  const Built built = build(wedges_about_edge(4, false));
  const auto fans = radial_fans(built.solid, axis_edge(built.solid));
  ASSERT_EQ(fans.size(), 1u);
  EXPECT_FALSE(fans[0].closed);
  EXPECT_EQ(fans[0].cells.size(), 4u);
  EXPECT_TRUE(built.solid.is_boundary(fans[0].faces.front()) && built.solid.is_boundary(fans[0].faces.back()));
  EXPECT_LT(fans[0].faces.front(), fans[0].faces.back());
  expect_fan_is_consistent(built.solid, fans[0], axis_edge(built.solid));
}

TEST(RadialEdge, SeveralFansWhereCellsMeetOnlyInTheEdge) {
  // Of six wedges two are taken out: fans of three and of one.
  Built built = build(wedges_about_edge(6, true));
  Transaction transaction(built.solid);
  transaction.remove_cell(CellId{1u});
  transaction.remove_cell(CellId{3u});
  (void)transaction.commit();
  const auto fans = radial_fans(built.solid, axis_edge(built.solid));
  ASSERT_EQ(fans.size(), 2u);
  EXPECT_LT(fans[0].faces[0], fans[1].faces[0]);
  EXPECT_EQ(fans[0].cells.size() + fans[1].cells.size(), 4u);
  EXPECT_EQ(std::max(fans[0].cells.size(), fans[1].cells.size()), 3u);
  for (const auto& fan : fans) expect_fan_is_consistent(built.solid, fan, axis_edge(built.solid));
}

TEST(RadialEdge, FaceWithoutCellsIsAFanOfItsOwn) {
  Built built = build(wedges_about_edge(2, false));
  Transaction transaction(built.solid);
  const VertexId v = transaction.add_vertex();
  const FaceId sail = face_of(transaction.add_face(std::array{VertexId{0u}, VertexId{1u}, v}));
  const auto fans = radial_fans(built.solid, axis_edge(built.solid));
  ASSERT_EQ(fans.size(), 2u);
  EXPECT_THAT(fans[1].faces, testing::ElementsAre(sail));
  EXPECT_THAT(fans[1].cells, testing::IsEmpty());
}

TEST(RadialEdge, NeighbourhoodsOfTheMiddleOfAGrid) {
  const Built built = box_grid(2, 2, 2, {1, 1, 1});
  const VertexId middle{13u};
  EXPECT_EQ(vertex_edges(built.solid, middle).size(), 6u);
  EXPECT_EQ(vertex_faces(built.solid, middle).size(), 12u);
  EXPECT_EQ(vertex_cells(built.solid, middle).size(), 8u);
  const EdgeId up = *built.solid.find_edge(middle, VertexId{22u});
  EXPECT_THAT(edge_cells(built.solid, up), testing::ElementsAre(CellId{4u}, CellId{5u}, CellId{6u}, CellId{7u}));
  EXPECT_EQ(cell_vertices(built.solid, CellId{7u}).front(), middle);
  EXPECT_EQ(cell_vertices(built.solid, CellId{7u}).size(), 8u);
  EXPECT_EQ(cell_edges(built.solid, CellId{7u}).size(), 12u);
}

TEST(RadialEdge, UseVerticesOfTheTwoSidesRunOppositeWays) {
  const Built built = box_grid(2, 1, 1, {2, 1, 1});
  for (const FaceId f : built.solid.faces()) {
    auto front = use_vertices(built.solid, face_use(f, false));
    std::reverse(front.begin(), front.end());
    EXPECT_EQ(front, use_vertices(built.solid, face_use(f, true)));
  }
}

TEST(RadialEdge, ComponentsAreConnectedThroughFacesOnly) {
  EXPECT_EQ(components(build(cubes({{0, 0, 0}, {1, 0, 0}})).solid).count, 1);
  EXPECT_EQ(components(build(cubes({{0, 0, 0}, {1, 1, 0}})).solid).count, 2);
  const auto parts = components(build(cubes({{0, 0, 0}, {1, 1, 1}, {2, 1, 1}})).solid);
  EXPECT_EQ(parts.count, 2);
  EXPECT_THAT(parts.component_from_cell.raw(), testing::ElementsAre(0, 1, 1));
}

}  // namespace
}  // namespace argil::subdiv
