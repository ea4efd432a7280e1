#include "subdiv/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "subdiv/error.h"
#include "subdiv/validate.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;
using testing::HasSubstr;

const std::vector<Loop> k_cube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

void expect_fault(const CellLists& lists, ErrorCode code, const std::string& where, const std::string& message) {
  try {
    (void)build(lists);
    ADD_FAILURE() << "built, but expected: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_EQ(error.where(), where);
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
}

void expect_counts(const Solid& solid, std::size_t v, std::size_t e, std::size_t f, std::size_t c) {
  EXPECT_EQ(solid.vertex_count(), v);
  EXPECT_EQ(solid.edge_count(), e);
  EXPECT_EQ(solid.face_count(), f);
  EXPECT_EQ(solid.cell_count(), c);
  EXPECT_THAT(validate(solid), testing::IsEmpty());
}

TEST(Build, CubesShareTheFaceEdgeOrVertexInWhichTheyMeet) {
  expect_counts(build(cubes({{0, 0, 0}, {1, 0, 0}})).solid, 12, 20, 11, 2);
  expect_counts(build(cubes({{0, 0, 0}, {1, 1, 0}})).solid, 14, 23, 12, 2);
  expect_counts(build(cubes({{0, 0, 0}, {1, 1, 1}})).solid, 15, 24, 12, 2);
}

TEST(Build, ThreeWedgesAboutAnEdgeAndARing) {
  expect_counts(build(wedges_about_edge(3, true)).solid, 8, 16, 12, 3);
  expect_counts(build(ring()).solid, 32, 64, 40, 8);
}

TEST(Build, DodecahedronIsOneCell) {
  expect_counts(build(dodecahedron()).solid, 20, 30, 12, 1);
}

TEST(Build, CellBesideHangingNodesCloses) {
  // A cube whose top is two rectangles and whose sides there have five vertices, under two boxes of half its size.
  CellLists lists = points(14);
  add_polyhedron(
      lists,
      {{0, 3, 2, 1}, {4, 8, 9, 7}, {8, 5, 6, 9}, {0, 1, 5, 8, 4}, {1, 2, 6, 5}, {2, 3, 7, 9, 6}, {3, 0, 4, 7}});
  add_cell(lists, CellKind::hexahedron, {4, 8, 9, 7, 10, 11, 12, 13});
  expect_counts(build(lists).solid, 14, 15 + 8, 7 + 5, 2);
}

TEST(Build, LeavesOutPointsThatNoCellUses) {
  CellLists lists = points(7);
  add_cell(lists, CellKind::tetrahedron, {1, 2, 4, 6});
  const Built built = build(lists);
  EXPECT_THAT(built.point_from_vertex, testing::ElementsAre(1, 2, 4, 6));
  EXPECT_EQ(built.positions.cols(), 4);
  EXPECT_EQ(built.positions(0, 3), 6);
}

TEST(Build, NothingIsASolidOfNothing) {
  expect_counts(build(CellLists{}).solid, 0, 0, 0, 0);
  expect_counts(build(points(3)).solid, 0, 0, 0, 0);
}

TEST(Build, InsideOutIsNotAFaultOfTheTopology) {
  CellLists lists = points(4);
  add_cell(lists, CellKind::tetrahedron, {0, 2, 1, 3});
  expect_counts(build(lists).solid, 4, 6, 4, 1);
}

TEST(Build, CostIsLinearWhereManyCellsShareAVertexAndAnEdge) {
  // All cells hold vertices 0 and 1 and the edge between them: any search there would take 10^10 steps.
  const int count = 100'000;
  const Built built = build(wedges_about_edge(count, true));
  expect_counts(built.solid, 2 + 2 * count, 1 + 5 * count, 4 * count, count);
  EXPECT_EQ(built.solid.edge_valence(*built.solid.find_edge(VertexId{0u}, VertexId{1u})), std::size_t{count});
}

TEST(BuildFaults, OpenCell) {
  CellLists lists = points(8);
  auto faces = k_cube;
  faces.pop_back();
  add_polyhedron(lists, faces);
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "the cell is open: edge 0-3");
}

TEST(BuildFaults, FaceUsedThreeTimes) {
  CellLists lists = points(6);
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 3});
  add_cell(lists, CellKind::tetrahedron, {0, 2, 1, 4});
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 5});
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "is used three times");
}

TEST(BuildFaults, IncoherentOrientationBetweenCells) {
  CellLists lists = points(5);
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 3});
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 4});
  expect_fault(lists, ErrorCode::bad_topology, "cell 1", "same side of the face of vertices 0 2 1 (incoherent");
}

TEST(BuildFaults, IncoherentOrientationWithinACell) {
  CellLists lists = points(8);
  auto faces = k_cube;
  std::swap(faces[1][1], faces[1][3]);
  add_polyhedron(lists, faces);
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "(incoherent orientation)");
}

TEST(BuildFaults, RepeatedVertex) {
  CellLists lists = points(8);
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 3});
  add_cell(lists, CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 2});
  expect_fault(lists, ErrorCode::bad_topology, "cell 1", "vertex 2 is repeated");
  lists = points(8);
  auto faces = k_cube;
  faces[4] = {2, 3, 7, 6, 3};
  add_polyhedron(lists, faces);
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "face 4 names vertex 3 twice (repeated vertex)");
}

TEST(BuildFaults, VertexOutOfRange) {
  CellLists lists = points(8);
  add_cell(lists, CellKind::pyramid, {0, 1, 2, 3, 8});
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "vertex 8 is out of range; there are 8 points");
  lists = points(8);
  auto faces = k_cube;
  faces[5][3] = 0xffffffffU;
  add_polyhedron(lists, faces);
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "vertex 4294967295 is out of range");
}

TEST(BuildFaults, NonFiniteCoordinate) {
  CellLists lists = points(4);
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 3});
  lists.positions(1, 2) = std::numeric_limits<double>::quiet_NaN();
  expect_fault(lists, ErrorCode::bad_geometry, "point 2", "non-finite y coordinate nan");
}

TEST(BuildFaults, CellThatIsPinchedAtAVertex) {
  CellLists lists = points(7);
  add_polyhedron(lists, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {3, 5, 4}, {3, 4, 6}, {4, 5, 6}, {5, 3, 6}});
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "pinched at vertex 3");
}

TEST(BuildFaults, CellOfTwoPieces) {
  CellLists lists = points(8);
  add_polyhedron(lists, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 6, 5}, {4, 5, 7}, {5, 6, 7}, {6, 4, 7}});
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "several closed surfaces");
}

TEST(BuildFaults, CellWithAHandle) {
  // A torus of 3 x 3 quadrilaterals, every one with vertices 3 i + j.
  CellLists lists = points(9);
  std::vector<Loop> faces;
  for (std::uint32_t i = 0; i < 3; ++i)
    for (std::uint32_t j = 0; j < 3; ++j) {
      const std::uint32_t k = (i + 1) % 3, l = (j + 1) % 3;
      faces.push_back({3 * i + j, 3 * k + j, 3 * k + l, 3 * i + l});
    }
  add_polyhedron(lists, faces);
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "has 1 handles");
}

TEST(BuildFaults, MoreThanTwoFacesAtAnEdgeOfACell) {
  CellLists lists = points(6);
  add_polyhedron(lists, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 4}, {1, 0, 5}, {0, 4, 5}, {1, 5, 4}});
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "4 faces of the cell meet at edge 0-1");
}

TEST(BuildFaults, FaceWithTwoVertices) {
  CellLists lists = points(8);
  auto faces = k_cube;
  faces.push_back({0, 1});
  add_polyhedron(lists, faces);
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "face 6 has 2 vertices");
}

TEST(BuildFaults, TwoSidesOfOneFaceAreNoCell) {
  CellLists lists = points(4);
  add_polyhedron(lists, {{0, 1, 2, 3}, {3, 2, 1, 0}});
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "has 2 faces");
}

TEST(BuildFaults, MalformedStreamOfAPolyhedron) {
  const Loop good = stream(k_cube);
  const auto fault = [](Loop numbers, const std::string& message) {
    CellLists lists = points(8);
    add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 3});
    add_cell(lists, CellKind::polyhedron, numbers);
    expect_fault(lists, ErrorCode::bad_topology, "cell 1", message);
  };
  Loop numbers = good;
  numbers[0] = 7;
  fault(numbers, "promises 7 faces and ends after 6");
  numbers[0] = 5;
  fault(numbers, "5 numbers are left after its 5 faces");
  numbers = good;
  numbers[26] = 0xffffffffU;
  fault(numbers, "face 5 promises 4294967295 vertices, 4 numbers are left");
  fault({}, "has 0 faces");
  fault({0xffffffffU}, "promises 4294967295 faces and ends after 0");
}

TEST(BuildFaults, WrongNumberOfVerticesOrOffsets) {
  CellLists lists = points(8);
  add_cell(lists, CellKind::wedge, {0, 1, 2, 3, 4});
  expect_fault(lists, ErrorCode::bad_topology, "cell 0", "a wedge has 6 vertices, found 5");
  lists = points(8);
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 3});
  lists.offsets.push_back(4);
  expect_fault(lists, ErrorCode::bad_topology, "", "expected 2 offsets");
}

TEST(BuildFaults, FirstFaultyCellIsNamed) {
  CellLists lists = points(8);
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 3});
  add_cell(lists, CellKind::tetrahedron, {0, 1, 2, 9});
  add_cell(lists, CellKind::polyhedron, {1, 3, 0, 1, 2});
  expect_fault(lists, ErrorCode::bad_topology, "cell 1", "vertex 9 is out of range");
}

}  // namespace
}  // namespace argil::subdiv
