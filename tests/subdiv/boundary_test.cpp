#include "subdiv/boundary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "subdiv/build.h"
#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "subdiv/transaction.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;

void expect_surface(const Solid& solid, std::size_t vertices, std::size_t faces, std::size_t component_count,
                    int genus) {
  const BoundarySurface surface = boundary_surface(solid);
  EXPECT_EQ(surface.vertex_from_surface.size(), vertices);
  EXPECT_EQ(surface.face_count(), faces);
  EXPECT_EQ(surface.component_count, component_count);
  EXPECT_EQ(surface.genus, genus);
  EXPECT_TRUE(std::is_sorted(surface.vertex_from_surface.begin(), surface.vertex_from_surface.end()));
  // Closed: with every directed edge its reverse.
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> directed;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto face = surface.face(f);
    std::vector<VertexId> loop;
    for (std::size_t i = 0; i < face.size(); ++i) {
      directed.emplace(face[i], face[(i + 1) % face.size()]);
      loop.push_back(surface.vertex_from_surface[face[i]]);
    }
    EXPECT_EQ(loop, use_vertices(solid, surface.faces[f]));
  }
  for (const auto& [a, b] : directed) EXPECT_EQ(directed.count({a, b}), directed.count({b, a}));
}

TEST(Boundary, GridIsASphere) {
  expect_surface(box_grid(3, 3, 3, {1, 1, 1}).solid, 56, 54, 1, 0);
  expect_surface(build(dodecahedron()).solid, 20, 12, 1, 0);
}

TEST(Boundary, RingHasGenusOne) {
  expect_surface(build(ring()).solid, 32, 32, 1, 1);
}

TEST(Boundary, HollowHasTwoComponents) {
  Built built = box_grid(3, 3, 3, {1, 1, 1});
  Transaction transaction(built.solid);
  transaction.remove_cell(CellId{13u});
  (void)transaction.commit();
  expect_surface(built.solid, 64, 60, 2, 0);
}

TEST(Boundary, CubesThatMeetInAnEdgeOrVertexAreParted) {
  expect_surface(build(cubes({{0, 0, 0}, {1, 1, 0}})).solid, 16, 12, 2, 0);
  expect_surface(build(cubes({{0, 0, 0}, {1, 1, 1}})).solid, 16, 12, 2, 0);
}

TEST(Boundary, FansAtANonManifoldEdgeKeepTheirCells) {
  // Two cubes over a plate of four meet in a vertical edge: the surface passes there twice, joined below, and
  // the upper end of the edge has two copies.
  const Built built = build(cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 1, 1}}));
  expect_surface(built.solid, 18 + 7 + 1, 24, 1, 0);
}

TEST(Boundary, TrianglesFanEachFaceAndKeepItsSense) {
  const BoundarySurface surface = boundary_surface(build(dodecahedron()).solid);
  const SurfaceTriangles triangles = triangulate(surface);
  ASSERT_EQ(triangles.face_from_triangle.size(), 36u);
  ASSERT_EQ(triangles.corners.size(), 108u);
  const auto first = surface.face(0);
  EXPECT_THAT(std::vector(triangles.corners.begin(), triangles.corners.begin() + 9),
              testing::ElementsAre(first[0], first[1], first[2], first[0], first[2], first[3], first[0], first[3],
                                   first[4]));
  EXPECT_EQ(triangles.face_from_triangle[3], 1u);
}

}  // namespace
}  // namespace argil::subdiv
