#include "subdiv/edit/extrude.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "subdiv/boundary.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solid_measures.h"
#include "subdiv/validate.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;

// A solid in space that is extruded as a session does it.
struct Model {
  explicit Model(Built built) : solid(std::move(built.solid)), positions(std::move(built.positions)) {}

  std::vector<FaceId> boundary_faces_at(int axis, double value) const {
    std::vector<FaceId> result;
    for (const FaceId f : solid.faces()) {
      if (!solid.is_boundary(f)) continue;
      const auto loop = solid.face_vertices(f);
      if (std::all_of(loop.begin(), loop.end(), [&](VertexId v) { return at(v)[axis] == value; }))
        result.push_back(f);
    }
    return result;
  }
  Eigen::Vector3d at(VertexId v) const { return positions.col(static_cast<Eigen::Index>(v.index())); }
  VertexId vertex_at(const Eigen::Vector3d& p) const {
    for (const VertexId v : solid.vertices())
      if (at(v) == p) return v;
    return VertexId{};
  }
  double sharpness(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    return solid.edge_sharpness(solid.find_edge(vertex_at(a), vertex_at(b)).value());
  }

  Extrusion extrude_by(const std::vector<FaceId>& faces, const Eigen::Vector3d& by, int steps = 1) {
    Transaction transaction(solid);
    Extrusion result = extrude(transaction, faces, steps);
    (void)transaction.commit();
    positions.conservativeResize(3, static_cast<Eigen::Index>(solid.vertex_capacity()));
    for (std::size_t i = 0; i < result.new_vertices.size(); ++i)
      positions.col(static_cast<Eigen::Index>(result.new_vertices[i].index())) =
          at(result.source_of_new[i]) + by * result.step_of_new[i] / steps;
    return result;
  }

  Solid solid;
  Eigen::Matrix3Xd positions;
};

TEST(Extrude, RegionSharesWallsAndGrowsAGrid) {
  Model model(box_grid(2, 2, 1, {2, 2, 1}));
  const auto result = model.extrude_by(model.boundary_faces_at(2, 1), {0, 0, 3}, 3);
  const Built grid = box_grid(2, 2, 4, {2, 2, 4});
  EXPECT_EQ(model.solid.vertex_count(), grid.solid.vertex_count());
  EXPECT_EQ(model.solid.edge_count(), grid.solid.edge_count());
  EXPECT_EQ(model.solid.face_count(), grid.solid.face_count());
  EXPECT_EQ(result.new_cells.size(), 12u);
  EXPECT_THAT(validate(model.solid), testing::IsEmpty());
  for (const CellId c : model.solid.cells()) {
    EXPECT_EQ(cell_kind(model.solid, c), CellKind::hexahedron);
    EXPECT_NEAR(cell_volume(model.solid, model.positions, c), 1, 1e-14);
  }
  for (const FaceId cap : result.caps) {
    EXPECT_TRUE(model.solid.is_boundary(cap));
    for (const VertexId v : model.solid.face_vertices(cap)) EXPECT_EQ(model.at(v).z(), 4);
  }
}

TEST(Extrude, PolygonsGrowPrisms) {
  Model model(build(dodecahedron()));
  const auto result = model.extrude_by({FaceId{0u}}, {0, 0, 1});
  EXPECT_EQ(model.solid.cell_face_uses(result.new_cells[0]).size(), 7u);
  EXPECT_THAT(validate(model.solid), testing::IsEmpty());
  Model pyramid_model(pyramid({1, 1, 1}));
  for (const FaceId f : pyramid_model.solid.faces())
    if (pyramid_model.solid.face_vertices(f).size() == 3) {
      const auto prism = pyramid_model.extrude_by({f}, {1, 0, 0});
      EXPECT_EQ(cell_kind(pyramid_model.solid, prism.new_cells[0]), CellKind::wedge);
      break;
    }
}

TEST(Extrude, CapsFollowTheOrderOfTheFaces) {
  Model model(box_grid(3, 1, 1, {3, 1, 1}));
  auto faces = model.boundary_faces_at(2, 1);
  std::reverse(faces.begin(), faces.end());
  const auto loops = [&](const std::vector<FaceId>& of) {
    std::vector<double> xs;
    for (const FaceId f : of) {
      double x = 0;
      for (const VertexId v : model.solid.face_vertices(f)) x += model.at(v).x() / 4;
      xs.push_back(x);
    }
    return xs;
  };
  const auto before = loops(faces);
  EXPECT_EQ(loops(model.extrude_by(faces, {0, 0, 1}, 2).caps), before);
}

TEST(Extrude, FacesThatTouchInAVertexKeepTouching) {
  Model model(box_grid(2, 2, 1, {2, 2, 1}));
  std::vector<FaceId> diagonal;
  for (const FaceId f : model.boundary_faces_at(2, 1)) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const VertexId v : model.solid.face_vertices(f)) mean += model.at(v) / 4;
    if (mean.x() == mean.y()) diagonal.push_back(f);
  }
  ASSERT_EQ(diagonal.size(), 2u);
  model.extrude_by(diagonal, {0, 0, 1});
  EXPECT_THAT(validate(model.solid), testing::IsEmpty());
  const EdgeId hinge = *model.solid.find_edge(model.vertex_at({1, 1, 1}), model.vertex_at({1, 1, 2}));
  EXPECT_EQ(radial_fans(model.solid, hinge).size(), 2u);
  EXPECT_EQ(boundary_surface(model.solid).genus, 0);
}

TEST(Extrude, WallsThatWouldOverlapAreRefusedAndNothingChanges) {
  Model model(build(cubes({{0, 0, 0}, {1, 1, 0}})));
  const EdgeId hinge = *model.solid.find_edge(model.vertex_at({1, 1, 0}), model.vertex_at({1, 1, 1}));
  std::vector<FaceId> all;
  model.solid.for_each_face(hinge, [&](FaceId f) { all.push_back(f); });
  ASSERT_EQ(all.size(), 4u);
  const std::uint64_t before = model.solid.topology_hash();
  EXPECT_THROW(model.extrude_by(all, {0, 0, 1}), Error);
  EXPECT_EQ(model.solid.topology_hash(), before);
  // Two that bound one gap share their wall; and then the other two do.
  model.extrude_by({all[0], all[1]}, {1, -1, 0});
  EXPECT_THAT(validate(model.solid), testing::IsEmpty());
}

TEST(Extrude, NamesWhatCannotBeExtruded) {
  Model model(box_grid(2, 1, 1, {2, 1, 1}));
  FaceId inner;
  for (const FaceId f : model.solid.faces())
    if (!model.solid.is_boundary(f)) inner = f;
  const auto code = [&](std::vector<FaceId> faces, int steps) {
    try {
      model.extrude_by(faces, {0, 0, 1}, steps);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::refused;
  };
  const FaceId outer = model.boundary_faces_at(2, 1)[0];
  EXPECT_EQ(code({inner}, 1), ErrorCode::bad_topology);
  EXPECT_EQ(code({FaceId{99u}}, 1), ErrorCode::not_found);
  EXPECT_EQ(code({outer, outer}, 1), ErrorCode::bad_input);
  EXPECT_EQ(code({outer}, 0), ErrorCode::bad_input);
  EXPECT_EQ(code({}, 1), ErrorCode::bad_input);
}

// A box whose edges and corners are sharp, as `sharpen` leaves it.
Model sharp_box(int n) {
  Model model(box_grid(n, n, 1, {double(n), double(n), 1}));
  const auto sides = [&](VertexId v) {
    const Eigen::Vector3d p = model.at(v);
    return int(p.x() == 0 || p.x() == n) + int(p.y() == 0 || p.y() == n) + int(p.z() == 0 || p.z() == 1);
  };
  Transaction transaction(model.solid);
  for (const VertexId v : model.solid.vertices())
    if (sides(v) == 3) transaction.set_sharpness(v, k_infinitely_sharp);
  for (const EdgeId e : model.solid.edges()) {
    const auto [a, b] = model.solid.edge_vertices(e);
    const Eigen::Vector3d middle = (model.at(a) + model.at(b)) / 2;
    if (int(middle.x() == 0 || middle.x() == n) + int(middle.y() == 0 || middle.y() == n) +
            int(middle.z() == 0 || middle.z() == 1) ==
        2)
      transaction.set_sharpness(e, k_infinitely_sharp);
  }
  (void)transaction.commit();
  return model;
}

TEST(ExtrudeSharpness, LegFromTheCornerOfASharpBox) {
  Model model = sharp_box(3);
  std::vector<FaceId> corner;
  for (const FaceId f : model.boundary_faces_at(2, 0)) {
    const auto loop = model.solid.face_vertices(f);
    if (std::count(loop.begin(), loop.end(), model.vertex_at({0, 0, 0}))) corner.push_back(f);
  }
  ASSERT_EQ(corner.size(), 1u);
  model.extrude_by(corner, {0, 0, -2}, 2);
  EXPECT_THAT(validate(model.solid), testing::IsEmpty());
  // The corner's edge goes on through both steps; the cap has the rim's two edges and the corner.
  EXPECT_EQ(model.sharpness({0, 0, 0}, {0, 0, -1}), k_infinitely_sharp);
  EXPECT_EQ(model.sharpness({0, 0, -1}, {0, 0, -2}), k_infinitely_sharp);
  EXPECT_EQ(model.sharpness({0, 0, -2}, {1, 0, -2}), k_infinitely_sharp);
  EXPECT_EQ(model.solid.vertex_sharpness(model.vertex_at({0, 0, -2})), k_infinitely_sharp);
  // Between the steps nothing, where the face was smooth nothing, on the old rim what was there.
  EXPECT_EQ(model.sharpness({0, 0, -1}, {1, 0, -1}), 0);
  EXPECT_EQ(model.solid.vertex_sharpness(model.vertex_at({0, 0, -1})), 0);
  EXPECT_EQ(model.sharpness({1, 0, 0}, {1, 0, -1}), 0);
  EXPECT_EQ(model.sharpness({1, 1, -2}, {1, 0, -2}), 0);
  EXPECT_EQ(model.sharpness({0, 0, 0}, {1, 0, 0}), k_infinitely_sharp);
}

TEST(ExtrudeSharpness, WhatBecomesInteriorIsSmooth) {
  Model model(box_grid(2, 2, 1, {2, 2, 1}));
  const VertexId middle = model.vertex_at({1, 1, 1}), side = model.vertex_at({1, 0, 1});
  Transaction transaction(model.solid);
  transaction.set_sharpness(middle, k_infinitely_sharp);
  transaction.set_sharpness(*model.solid.find_edge(middle, side), k_infinitely_sharp);
  (void)transaction.commit();
  model.extrude_by(model.boundary_faces_at(2, 1), {0, 0, 1});
  EXPECT_EQ(model.solid.vertex_sharpness(middle), 0);
  EXPECT_EQ(model.sharpness({1, 1, 1}, {1, 0, 1}), 0);
  EXPECT_EQ(model.sharpness({1, 1, 1}, {1, 1, 2}), 0);
  EXPECT_EQ(model.sharpness({1, 1, 2}, {1, 0, 2}), k_infinitely_sharp);
  EXPECT_EQ(model.solid.vertex_sharpness(model.vertex_at({1, 1, 2})), k_infinitely_sharp);
}

TEST(ExtrudeSharpness, ThreeSharpEdgesMakeACornerToo) {
  Model model = sharp_box(1);
  Transaction transaction(model.solid);
  for (const VertexId v : model.solid.vertices()) transaction.set_sharpness(v, 0);
  (void)transaction.commit();
  model.extrude_by(model.boundary_faces_at(2, 1), {0, 0, 1});
  EXPECT_EQ(model.sharpness({0, 0, 1}, {0, 0, 2}), k_infinitely_sharp);
}

TEST(Extrude, SharpSheetGoesOnThroughTheWallsAboveIt) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  std::vector<FaceId> caps;
  Transaction transaction(built.solid);
  for (const FaceId f : built.solid.faces()) {
    if (!built.solid.is_boundary(f)) {
      transaction.set_sharpness(f, 4);
      continue;
    }
    bool top = true;
    for (const VertexId v : built.solid.face_vertices(f)) top = top && built.positions(2, v.value) == 1;
    if (top) caps.push_back(f);
  }
  (void)extrude(transaction, caps, 2);
  std::size_t sharp = 0;
  for (const FaceId f : built.solid.faces()) {
    if (built.solid.face_sharpness(f) == 0) continue;
    EXPECT_EQ(built.solid.face_sharpness(f), 4);
    EXPECT_FALSE(built.solid.is_boundary(f));
    ++sharp;
  }
  EXPECT_EQ(sharp, 3U) << "the old one and a wall a step";
}

}  // namespace
}  // namespace argil::subdiv
