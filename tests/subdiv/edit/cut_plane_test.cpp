#include "subdiv/edit/cut_plane.h"

#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edited.h"

namespace argil::subdiv {
namespace {

using namespace test;

std::vector<CellId> all_cells(const Solid& solid) {
  return {solid.cells().begin(), solid.cells().end()};
}
Edit cut(Built& built, const std::vector<CellId>& cells, const Plane& plane, double tolerance = 1e-9) {
  return edited(built.solid, built.positions, [&](Transaction& t, const Eigen::Matrix3Xd& rest) {
    return cut_plane(t, rest, cells, plane, tolerance);
  });
}

TEST(CutPlane, ObliqueHalvesHaveTheVolumeOfTheIntegral) {
  Built built = box_grid(4, 2, 2, {4, 1, 1});
  const Edit edit = cut(built, all_cells(built.solid), {{1, 0.3, 0.6}, {2, 0.5, 0.5}});
  double front = 0;
  for (const CellId c : edit.next_cells) {
    front += cell_volume(built.solid, built.positions, c);
    for (const VertexId v : cell_vertices(built.solid, c))
      EXPECT_GE(Eigen::Vector3d(1, 0.3, 0.6).dot(point(built.positions, v) - Eigen::Vector3d(2, 0.5, 0.5)), -1e-12);
  }
  EXPECT_NEAR(front, 2, 1e-13) << "the plane goes through the middle";
  EXPECT_NEAR(volume(built.solid, built.positions), 4, 1e-13);
}

TEST(CutPlane, ACellGivesTwoThatShareTheSection) {
  Built built = box_grid(1, 1, 1, {1, 1, 1});
  const Edit edit = cut(built, {CellId{0u}}, {{1, 1, 1}, {0.5, 0.5, 0.5}});
  EXPECT_EQ(built.solid.cell_count(), 2u);
  int inner = 0;
  for (const FaceId f : built.solid.faces())
    if (!built.solid.is_boundary(f)) {
      ++inner;
      EXPECT_EQ(built.solid.face_vertices(f).size(), 6u);
    }
  EXPECT_EQ(inner, 1);
  EXPECT_EQ(edit.faces.size(), 12u);
  EXPECT_EQ(edit.edges.size(), 12u) << "six edges in two";
}

TEST(CutPlane, GoesThroughVerticesWithinTheTolerance) {
  Built built = box_grid(1, 1, 1, {1, 1, 1});
  (void)cut(built, {CellId{0u}}, {{1, -1, 0}, {1e-7, 0, 0}}, 1e-6);
  EXPECT_EQ(built.solid.vertex_count(), 8u);
  for (const CellId c : built.solid.cells()) EXPECT_EQ(cell_kind(built.solid, c), CellKind::wedge);
}

TEST(CutPlane, WhatItOnlyTouchesStays) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  EXPECT_EQ(fault(built.solid, built.positions,
                  [&](Transaction& t, const auto& rest) {
                    return cut_plane(t, rest, all_cells(built.solid), {{1, 0, 0}, {1, 0, 0}}, 1e-9);
                  }),
            ErrorCode::bad_input);
  const Edit edit = cut(built, all_cells(built.solid), {{-1, 0, 0}, {1.5, 0, 0}});
  EXPECT_EQ(built.solid.cell_count(), 3u);
  EXPECT_TRUE(built.solid.is_live(CellId{0u})) << "it is not at the plane";
  EXPECT_EQ(edit.next_cells.size(), 2u) << "the whole one and a half";
}

TEST(CutPlane, CellsBesideTheSelectionGetTheCutEdges) {
  Built built = box_grid(2, 2, 1, {2, 2, 1});
  cut(built, {CellId{0u}}, {{0, 0, 1}, {0, 0, 0.5}});
  EXPECT_EQ(built.solid.cell_count(), 5u);
  std::map<std::size_t, int> corners;
  for (const CellId c : built.solid.cells()) ++corners[cell_vertices(built.solid, c).size()];
  EXPECT_EQ(corners, (std::map<std::size_t, int>{{8, 2}, {9, 1}, {10, 2}}));
}

TEST(CutPlane, EveryShapeOfTheCatalogue) {
  for (const Eigen::Vector3d& normal : {Eigen::Vector3d(1, 0.2, 0.1), Eigen::Vector3d(0.1, -0.3, 1)})
    for (Shape& shape : catalogue()) {
      SCOPED_TRACE(shape.name);
      const double before = volume(shape.solid, shape.positions);
      Eigen::Vector3d middle = shape.positions.rowwise().mean();
      try {
        (void)edited(shape.solid, shape.positions, [&](Transaction& t, const auto& rest) {
          return cut_plane(t, rest, all_cells(shape.solid), {normal, middle}, 1e-9);
        });
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::AnyOf(testing::HasSubstr("not convex"), testing::HasSubstr("none of"),
                                                 testing::HasSubstr("cannot be cut")));
      }
      // Faces are bent, and fans about other middles bend otherwise.
      EXPECT_NEAR(volume(shape.solid, shape.positions), before, 0.02 * std::abs(before));
    }
}

TEST(CutPlane, NamesAConcaveCellWhoseSectionIsNoLoop) {
  // A prism over a U, cut across both prongs.
  Built built = build(
      stacked({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, {{0, 1, 2, 3, 4, 5, 6, 7}}, 1));
  try {
    (void)cut(built, {CellId{0u}}, {{0, 1, 0}, {0, 2, 0}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "cell 0");
    EXPECT_THAT(error.what(), testing::HasSubstr("not convex"));
  }
  // Along the bottom of the notch the prongs come off one after the other; below it nothing is concave.
  (void)cut(built, {CellId{0u}}, {{0, 1, 0}, {0, 0.5, 0}});
  EXPECT_NEAR(volume(built.solid, built.positions), 7, 1e-13);
  EXPECT_EQ(fault(built.solid, built.positions,
                  [&](Transaction& t, const auto& rest) {
                    return cut_plane(t, rest, all_cells(built.solid), {{0, 0, 0}, {0, 0, 0}}, 0);
                  }),
            ErrorCode::bad_input);
}

TEST(CutPlane, CreasesKeepTheirSharpnessOnBothHalves) {
  Built built = sharp_box_grid(2, 1, 1, {2, 1, 1});
  cut(built, all_cells(built.solid), {{0, 0.1, 1}, {0, 0.5, 0.5}});
  for (const EdgeId e : built.solid.edges()) {
    const auto [a, b] = built.solid.edge_vertices(e);
    const Eigen::Vector3d m = (point(built.positions, a) + point(built.positions, b)) / 2;
    const int on = int(m.x() == 0 || m.x() == 2) + int(m.y() == 0 || m.y() == 1) + int(m.z() == 0 || m.z() == 1);
    EXPECT_EQ(built.solid.edge_sharpness(e), on == 2 ? k_infinitely_sharp : 0) << m.transpose();
  }
}

}  // namespace
}  // namespace argil::subdiv
