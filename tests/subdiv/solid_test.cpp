#include "subdiv/solid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/build.h"
#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "subdiv/transaction.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;

TEST(Solid, FindsFacesInAnyRotationAndDirectionOnly) {
  const Solid solid = box_grid(2, 1, 1, {2, 1, 1}).solid;
  for (const FaceId f : solid.faces()) {
    std::vector<VertexId> loop = use_vertices(solid, face_use(f, true));
    std::rotate(loop.begin(), loop.begin() + 3, loop.end());
    EXPECT_EQ(solid.find_face(loop), f);
    std::swap(loop[0], loop[1]);  // the same vertices crossed
    EXPECT_EQ(solid.find_face(loop), std::nullopt);
  }
}

TEST(Solid, IncidencesAscendAfterEditsToo) {
  Built built = build(wedges_about_edge(6, true));
  const EdgeId axis = *built.solid.find_edge(VertexId{0u}, VertexId{1u});
  Transaction transaction(built.solid);
  transaction.remove_cell(CellId{2u});
  transaction.remove_cell(CellId{3u});  // and with it the wall between them
  EXPECT_EQ(built.solid.edge_valence(axis), 5u);
  transaction.roll_back();
  std::vector<FaceId> faces;
  built.solid.for_each_face(axis, [&](FaceId f) { faces.push_back(f); });
  EXPECT_EQ(faces.size(), 6u);
  EXPECT_TRUE(std::is_sorted(faces.begin(), faces.end()));
  std::vector<EdgeId> edges;
  built.solid.for_each_edge(VertexId{0u}, [&](EdgeId e) { edges.push_back(e); });
  EXPECT_EQ(edges.size(), 7u);
  EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
}

TEST(Solid, HashTellsTopologySharpnessAndAllocator) {
  Solid solid = box_grid(2, 1, 1, {2, 1, 1}).solid;
  const std::uint64_t hash = solid.topology_hash();
  EXPECT_EQ(box_grid(2, 1, 1, {5, 5, 5}).solid.topology_hash(), hash);
  EXPECT_NE(box_grid(1, 2, 1, {2, 1, 1}).solid.topology_hash(), hash);
  Transaction transaction(solid);
  transaction.set_sharpness(EdgeId{3u}, k_infinitely_sharp);
  const std::uint64_t sharp = solid.topology_hash();
  EXPECT_NE(sharp, hash);
  transaction.set_sharpness(EdgeId{3u}, 0);
  EXPECT_EQ(solid.topology_hash(), hash);
  transaction.set_sharpness(EdgeId{4u}, k_infinitely_sharp);
  EXPECT_NE(solid.topology_hash(), sharp);
  transaction.set_sharpness(EdgeId{4u}, 0);
  transaction.remove_vertex(transaction.add_vertex());
  EXPECT_NE(solid.topology_hash(), hash) << "an id has been used up";
}

TEST(Solid, BoundaryOfAGrid) {
  const Solid solid = box_grid(2, 2, 2, {1, 1, 1}).solid;
  EXPECT_FALSE(solid.is_boundary(VertexId{13u}));
  EXPECT_TRUE(solid.is_boundary(VertexId{22u}));
  EXPECT_FALSE(solid.is_boundary(*solid.find_edge(VertexId{13u}, VertexId{22u})));
  std::size_t boundary_faces = 0;
  for (const FaceId f : solid.faces())
    if (solid.is_boundary(f)) {
      ++boundary_faces;
      EXPECT_TRUE(solid.owner(solid.boundary_use(f)).valid());
      EXPECT_FALSE(solid.owner(other_side(solid.boundary_use(f))).valid());
    }
  EXPECT_EQ(boundary_faces, 24u);
}

}  // namespace
}  // namespace argil::subdiv
