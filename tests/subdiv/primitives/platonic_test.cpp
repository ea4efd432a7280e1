#include "subdiv/primitives/platonic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solid_measures.h"
#include "subdiv/validate.h"

namespace argil::subdiv {
namespace {

struct Regular {
  Platonic body;
  std::size_t vertices, edges, faces, edges_at_vertex;
  double volume_of_unit_edge;
};

TEST(Platonic, EachIsOneRegularCell) {
  const double root5 = std::sqrt(5.0);
  for (const Regular& r :
       {Regular{Platonic::tetrahedron, 4, 6, 4, 3, std::sqrt(2.0) / 12}, Regular{Platonic::cube, 8, 12, 6, 3, 1},
        Regular{Platonic::octahedron, 6, 12, 8, 4, std::sqrt(2.0) / 3},
        Regular{Platonic::dodecahedron, 20, 30, 12, 3, (15 + 7 * root5) / 4},
        Regular{Platonic::icosahedron, 12, 30, 20, 5, 5 * (3 + root5) / 12}}) {
    Built built = platonic(r.body, 1.5);
    const Solid& solid = built.solid;
    SCOPED_TRACE(r.faces);
    EXPECT_EQ(solid.cell_count(), 1u);
    EXPECT_EQ(solid.vertex_count(), r.vertices);
    EXPECT_EQ(solid.edge_count(), r.edges);
    EXPECT_EQ(solid.face_count(), r.faces);
    EXPECT_THAT(validate(solid), testing::IsEmpty());
    const auto [a, b] = solid.edge_vertices(EdgeId{0u});
    const double edge = (built.positions.col(a.value) - built.positions.col(b.value)).norm();
    for (const EdgeId e : solid.edges()) {
      const auto [p, q] = solid.edge_vertices(e);
      EXPECT_NEAR((built.positions.col(p.value) - built.positions.col(q.value)).norm(), edge, 1e-12);
    }
    for (const VertexId v : solid.vertices()) EXPECT_EQ(vertex_edges(solid, v).size(), r.edges_at_vertex);
    const MassProperties mass = mass_properties(solid, built.positions);
    EXPECT_NEAR(mass.volume, r.volume_of_unit_edge * std::pow(edge, 3), 1e-12);
    EXPECT_NEAR(mass.centre.head<2>().norm(), 0, 1e-12);
    EXPECT_NEAR((built.positions.col(0) - mass.centre).norm(), 1.5, 1e-12);
    // It stands on a whole face.
    EXPECT_EQ((built.positions.row(2).array() < 1e-12).count(), Eigen::Index(r.faces == 12  ? 5
                                                                             : r.faces == 6 ? 4
                                                                                            : 3));
    EXPECT_EQ(sharpen_outline(built.solid), r.edges);
  }
  EXPECT_THROW((void)platonic(Platonic::cube, 0), Error);
  EXPECT_THROW((void)platonic(Platonic::cube, std::numeric_limits<double>::infinity()), Error);
}

}  // namespace
}  // namespace argil::subdiv
