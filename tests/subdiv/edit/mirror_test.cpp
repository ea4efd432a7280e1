#include "subdiv/edit/mirror.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "subdiv/boundary.h"
#include "subdiv/edit/duplicate.h"
#include "subdiv/edit/join.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/primitives/round.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solid_measures.h"
#include "subdiv/validate.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/slow_check.h"

namespace argil::subdiv {
namespace {

struct Figure {
  Solid solid;
  Eigen::Matrix3Xd rest;
  Edit edit;

  explicit Figure(Built built) : solid(std::move(built.solid)), rest(std::move(built.positions)) {}
  std::vector<CellId> all_cells() const {
    std::vector<CellId> cells;
    for (const CellId c : solid.cells()) cells.push_back(c);
    return cells;
  }
  void change(const std::function<Edit(Transaction&)>& how) {
    Transaction transaction(solid);
    edit = how(transaction);
    (void)transaction.commit();
    const Eigen::Matrix3Xd old = rest;
    rest.conservativeResize(3, static_cast<Eigen::Index>(solid.vertex_capacity()));
    for (const PlacedVertex& placed : edit.placed) {
      Eigen::Vector3d at = Eigen::Vector3d::Zero();
      for (const auto& [source, weight] : placed.sources) at += weight * old.col(source.value);
      rest.col(placed.vertex.value) = placed.linear * at + placed.offset;
    }
  }
  void mirror_all(const Plane& plane, double weld = 1e-6) {
    change([&](Transaction& t) { return mirror(t, rest, all_cells(), plane, {weld}); });
  }
  double volume() const { return mass_properties(solid, rest).volume; }
  void expect_sound() const {
    EXPECT_THAT(validate(solid), testing::IsEmpty());
    EXPECT_THAT(test::slow_check(solid), testing::IsEmpty());
    EXPECT_EQ(inverted_cells(solid, rest).count, 0u);
  }
};

ErrorCode code_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::refused;
}

TEST(Mirror, HalfABoxBecomesTheWholeGrid) {
  Figure figure(box_grid(2, 3, 4, {2, 3, 4}));
  figure.mirror_all({{0, 0, 0}, {-5, 0, 0}});
  figure.expect_sound();
  const Built whole = box_grid(4, 3, 4, {4, 3, 4});
  EXPECT_EQ(figure.solid.vertex_count(), whole.solid.vertex_count());
  EXPECT_EQ(figure.solid.edge_count(), whole.solid.edge_count());
  EXPECT_EQ(figure.solid.face_count(), whole.solid.face_count());
  EXPECT_DOUBLE_EQ(figure.volume(), 48);
  EXPECT_EQ(figure.rest.row(0).minCoeff(), -2);
  EXPECT_EQ(figure.edit.cells.size(), 24u);
  for (const auto& [copy, source] : figure.edit.cells) {
    EXPECT_FALSE(std::find(figure.edit.next_cells.begin(), figure.edit.next_cells.end(), copy) ==
                 figure.edit.next_cells.end());
    EXPECT_EQ(cell_kind(figure.solid, copy), cell_kind(figure.solid, source));
  }
}

// A half torus mirrored closes to a ring: genus 1.
TEST(Mirror, HalfARingClosesToARing) {
  Built ring = torus(1, 0.3, {8, 16, 1});
  Figure figure(std::move(ring));
  std::vector<CellId> behind;
  for (const CellId c : figure.solid.cells()) {
    double y = 0;
    for (const VertexId v : cell_vertices(figure.solid, c)) y += figure.rest(1, v.value);
    if (y < 0) behind.push_back(c);
  }
  {
    Transaction transaction(figure.solid);
    for (const CellId c : behind) transaction.remove_cell(c);
    (void)transaction.commit();
  }
  const double half = figure.volume();
  figure.mirror_all({{0, 0, 0}, {0, 1, 0}});
  figure.expect_sound();
  EXPECT_EQ(boundary_surface(figure.solid).genus, 1);
  EXPECT_NEAR(figure.volume(), 2 * half, 1e-12);
}

TEST(Mirror, VerticesNearThePlaneArePutOnIt) {
  Figure figure(box_grid(1, 1, 1, {1, 1, 1}));
  figure.rest(0, 0) = 1e-3;
  figure.mirror_all({}, 1e-2);
  EXPECT_EQ(figure.rest(0, 0), 0);
  EXPECT_EQ(figure.solid.vertex_count(), 12u);
  figure.expect_sound();
}

TEST(Mirror, OnlyWhatFoldsAcrossTheSeamStaysSharp) {
  Built box = box_grid(1, 1, 1, {1, 1, 1});
  sharpen_outline(box.solid);
  Figure figure(std::move(box));
  figure.rest(2, 7) = figure.rest(2, 5) = 0.3;  // the upper side slopes away from the plane: a ridge
  figure.mirror_all({});
  const auto sharpness = [&](std::size_t a, std::size_t b) {
    return figure.solid.edge_sharpness(figure.solid.find_edge(VertexId{a}, VertexId{b}).value());
  };
  EXPECT_EQ(sharpness(0, 2), 0);                   // flat below
  EXPECT_EQ(sharpness(0, 4), 0);                   // and at the sides
  EXPECT_EQ(sharpness(4, 6), k_infinitely_sharp);  // the ridge
  std::size_t sharp = 0;
  for (const EdgeId e : figure.solid.edges()) sharp += figure.solid.edge_sharpness(e) > 0;
  EXPECT_EQ(sharp, 8u + 8u + 1u);
}

TEST(Mirror, KeptApartSharesNothing) {
  Figure figure(box_grid(2, 1, 1, {2, 1, 1}));
  figure.mirror_all({}, -1);
  figure.expect_sound();
  EXPECT_EQ(components(figure.solid).count, 2);
  EXPECT_EQ(figure.solid.vertex_count(), 24u);
}

TEST(Mirror, RefusesWhatWouldLieWithinItselfAndChangesNothing) {
  Figure figure(box_grid(3, 1, 1, {3, 1, 1}));
  const std::uint64_t before = figure.solid.topology_hash();
  const auto refused = [&](const Plane& plane, double weld) {
    return code_of([&] { figure.mirror_all(plane, weld); });
  };
  EXPECT_EQ(refused({{0.5, 0, 0}, {1, 0, 0}}, 1e-6), ErrorCode::bad_geometry);  // through a cell
  EXPECT_EQ(refused({{1, 0, 0}, {1, 0, 0}}, 1e-6), ErrorCode::bad_geometry);    // on both sides
  EXPECT_EQ(refused({{0, 0, 0}, {1, 0, 0}}, 2), ErrorCode::bad_geometry);       // flat
  EXPECT_EQ(refused({{0, 0, 0}, {0, 0, 0}}, 1e-6), ErrorCode::bad_input);
  EXPECT_EQ(code_of([&] {
              figure.change([&](Transaction& t) {
                return mirror(t, figure.rest, std::vector{CellId{0u}}, {{1, 0, 0}, {1, 0, 0}});
              });
            }),
            ErrorCode::bad_topology);
  EXPECT_EQ(figure.solid.topology_hash(), before);
}

TEST(Mirror, EveryShapeOfTheCatalogueBesideAPlane) {
  for (test::Shape& shape : test::catalogue()) {
    SCOPED_TRACE(shape.name);
    Figure figure(Built{std::move(shape.solid), std::move(shape.positions), {}});
    const double before = figure.volume();
    figure.mirror_all({{figure.rest.row(0).minCoeff() - 1, 0, 0}, {1, 0, 0}});
    EXPECT_THAT(validate(figure.solid), testing::IsEmpty());
    EXPECT_NEAR(figure.volume(), 2 * before, 1e-9);
    for (const auto& [copy, source] : figure.edit.edges)
      EXPECT_EQ(figure.solid.edge_sharpness(copy), figure.solid.edge_sharpness(source));
    figure.change([&](Transaction& t) { return reflect(t, {{1, 2, 3}, {1, 1, 1}}); });
    EXPECT_THAT(validate(figure.solid), testing::IsEmpty());
    EXPECT_NEAR(figure.volume(), 2 * before, 1e-9);
  }
}

TEST(Reflect, KeepsIdsAndSharpnessOfAllButCells) {
  Built box = box_grid(2, 1, 1, {2, 1, 1});
  sharpen_outline(box.solid);
  Figure figure(std::move(box));
  const std::size_t faces = figure.solid.face_capacity(), edges = figure.solid.edge_capacity();
  figure.change([&](Transaction& t) { return reflect(t, {}); });
  figure.expect_sound();
  EXPECT_EQ(figure.solid.face_capacity(), faces);
  EXPECT_EQ(figure.solid.edge_capacity(), edges);
  EXPECT_EQ(figure.edit.cells.size(), 2u);
  EXPECT_EQ(figure.rest.row(0).minCoeff(), -2);
  std::size_t sharp = 0;
  for (const EdgeId e : figure.solid.edges()) sharp += figure.solid.edge_sharpness(e) > 0;
  EXPECT_EQ(sharp, 16u);
}

TEST(Duplicate, CopiesStandWhereTheStepTakesThem) {
  Figure figure(box_grid(2, 1, 1, {2, 1, 1}));
  const Eigen::Affine3d step =
      Eigen::Translation3d(0, 0, 3) * Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ());
  figure.change([&](Transaction& t) { return duplicate(t, std::vector{CellId{1u}}, 3, step); });
  figure.expect_sound();
  EXPECT_EQ(components(figure.solid).count, 4);
  ASSERT_EQ(figure.edit.next_cells.size(), 3u);
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  for (const CellId copy : figure.edit.next_cells) {
    place = step * place;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const VertexId v : cell_vertices(figure.solid, copy)) middle += figure.rest.col(v.value) / 8;
    EXPECT_LT((middle - place * Eigen::Vector3d(1.5, 0.5, 0.5)).norm(), 1e-12);
  }
  EXPECT_TRUE(figure.edit.cells.empty());  // no set gets them
}

TEST(Duplicate, RefusesCopiesThatWouldStandInOneAnother) {
  Figure figure(box_grid(1, 1, 1, {1, 1, 1}));
  const auto refused = [&](const std::vector<CellId>& cells, int count, const Eigen::Affine3d& step) {
    return code_of([&] { figure.change([&](Transaction& t) { return duplicate(t, cells, count, step); }); });
  };
  const Eigen::Affine3d away(Eigen::Translation3d(2, 0, 0));
  EXPECT_EQ(refused({CellId{0u}}, 1, Eigen::Affine3d::Identity()), ErrorCode::bad_input);
  EXPECT_EQ(refused({CellId{0u}}, 0, away), ErrorCode::bad_input);
  EXPECT_EQ(refused({}, 1, away), ErrorCode::bad_input);
  EXPECT_EQ(refused({CellId{7u}}, 1, away), ErrorCode::not_found);
  EXPECT_EQ(refused({CellId{0u}}, 1, Eigen::Affine3d(Eigen::Scaling(-1.0))), ErrorCode::bad_input);
}

TEST(Join, AddsASolidWithItsSharpness) {
  for (const test::Shape& shape : test::catalogue()) {
    SCOPED_TRACE(shape.name);
    Figure figure(box_grid(1, 1, 1, {1, 1, 1}));
    const Built other{shape.solid, shape.positions, {}};
    figure.change([&](Transaction& t) { return join(t, other); });
    EXPECT_THAT(validate(figure.solid), testing::IsEmpty());
    EXPECT_EQ(figure.solid.cell_count(), shape.solid.cell_count() + 1);
    EXPECT_EQ(figure.solid.face_count(), shape.solid.face_count() + 6);
    EXPECT_NEAR(figure.volume(), 1 + mass_properties(shape.solid, shape.positions).volume, 1e-12);
    double here = 0, there = 0;
    for (const EdgeId e : figure.solid.edges()) here += figure.solid.edge_sharpness(e);
    for (const VertexId v : figure.solid.vertices()) here += figure.solid.vertex_sharpness(v);
    for (const EdgeId e : shape.solid.edges()) there += shape.solid.edge_sharpness(e);
    for (const VertexId v : shape.solid.vertices()) there += shape.solid.vertex_sharpness(v);
    EXPECT_EQ(here, there);
  }
}

}  // namespace
}  // namespace argil::subdiv
