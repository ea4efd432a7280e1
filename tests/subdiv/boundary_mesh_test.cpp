#include "subdiv/boundary_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/build.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;

TEST(BoundaryMesh, IsClosedAndManifoldAndKeepsMapsAndPositions) {
  for (const Built& built : {box_grid(3, 2, 2, {3, 2, 2}), build(ring()), build(dodecahedron()),
                             build(cubes({{0, 0, 0}, {1, 1, 0}})), build(cubes({{0, 0, 0}, {1, 1, 1}})),
                             build(cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 1, 1}}))}) {
    const BoundarySurface surface = boundary_surface(built.solid);
    const BoundaryMesh result = boundary_mesh(surface, built.positions);
    ASSERT_EQ(result.mesh.n_vertices(), surface.vertex_from_surface.size());
    ASSERT_EQ(result.mesh.n_faces(), surface.face_count());
    for (const auto e : result.mesh.edges()) EXPECT_FALSE(result.mesh.is_boundary(e));
    for (const auto v : result.mesh.vertices()) {
      EXPECT_TRUE(result.mesh.is_manifold(v));
      const VertexId original = result.vertex_from_mesh[static_cast<std::size_t>(v.idx())];
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(result.mesh.point(v)[static_cast<std::size_t>(k)],
                  built.positions(k, static_cast<Eigen::Index>(original.index())));
    }
    EXPECT_EQ(result.face_from_mesh, surface.faces);
    const auto characteristic = static_cast<long>(result.mesh.n_vertices()) -
                                static_cast<long>(result.mesh.n_edges()) + static_cast<long>(result.mesh.n_faces());
    EXPECT_EQ(characteristic, 2 * static_cast<long>(surface.component_count) - 2 * surface.genus);
  }
}

TEST(BoundaryMesh, EdgeBetweenTheSameCopiesTwiceIsNamed) {
  // Between plates of four cubes stand two cubes that meet in an edge; both its ends are single copies.
  const Built built = build(cubes({{0, 0, 0},
                                   {1, 0, 0},
                                   {0, 1, 0},
                                   {1, 1, 0},
                                   {0, 0, 1},
                                   {1, 1, 1},
                                   {0, 0, 2},
                                   {1, 0, 2},
                                   {0, 1, 2},
                                   {1, 1, 2}}));
  const BoundarySurface surface = boundary_surface(built.solid);
  EXPECT_EQ(surface.component_count, 1u);
  try {
    (void)boundary_mesh(surface, built.positions);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_topology);
    EXPECT_THAT(error.what(), testing::HasSubstr("runs twice along edge"));
  }
}

}  // namespace
}  // namespace argil::subdiv
