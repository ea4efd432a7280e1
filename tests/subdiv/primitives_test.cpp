#include "subdiv/primitives.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "subdiv/error.h"
#include "subdiv/radial_edge.h"
#include "subdiv/validate.h"

namespace argil::subdiv {
namespace {

TEST(Primitives, BoxGridHasTheCountsAndIdsOfAGrid) {
  const Built built = box_grid(3, 4, 5, {6, 4, 10});
  EXPECT_EQ(built.solid.vertex_count(), 4u * 5 * 6);
  EXPECT_EQ(built.solid.edge_count(), 3u * 5 * 6 + 4 * 4 * 6 + 4 * 5 * 5);
  EXPECT_EQ(built.solid.face_count(), 4u * 4 * 5 + 3 * 5 * 5 + 3 * 4 * 6);
  EXPECT_EQ(built.solid.cell_count(), 60u);
  EXPECT_THAT(validate(built.solid), testing::IsEmpty());
  const std::size_t v = (2 * 5 + 3) * 4 + 1, c = (2 * 4 + 3) * 3 + 1;  // (1, 3, 2)
  EXPECT_EQ(built.positions.col(static_cast<Eigen::Index>(v)), Eigen::Vector3d(2, 3, 4));
  EXPECT_EQ(cell_vertices(built.solid, CellId{c}).front(), VertexId{v});
  EXPECT_EQ(vtk_vertices(built.solid, CellId{c})[1], VertexId{v + 1});
  EXPECT_EQ(built.positions.rightCols<1>(), Eigen::Vector3d(6, 4, 10));
}

TEST(Primitives, KindsAndExtents) {
  const Eigen::Vector3d size(1, 2, 3);
  for (const auto& [built, kind] : {std::pair{tetrahedron(size), CellKind::tetrahedron},
                                    {wedge(size), CellKind::wedge},
                                    {pyramid(size), CellKind::pyramid}}) {
    EXPECT_EQ(cell_kind(built.solid, CellId{0u}), kind);
    EXPECT_EQ(Eigen::Vector3d(built.positions.rowwise().minCoeff()), Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(Eigen::Vector3d(built.positions.rowwise().maxCoeff()), size);
  }
}

TEST(Primitives, RefusesWhatIsNoBox) {
  const auto code = [](int n, double length) {
    try {
      (void)box_grid(2, n, 2, {1, 1, length});
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::refused;
  };
  EXPECT_EQ(code(0, 1), ErrorCode::bad_input);
  EXPECT_EQ(code(1, 0), ErrorCode::bad_input);
  EXPECT_EQ(code(1, -1), ErrorCode::bad_input);
  EXPECT_EQ(code(1, std::numeric_limits<double>::infinity()), ErrorCode::bad_input);
  EXPECT_EQ(code(2'000'000'000, 1), ErrorCode::limit_exceeded);
}

}  // namespace
}  // namespace argil::subdiv
