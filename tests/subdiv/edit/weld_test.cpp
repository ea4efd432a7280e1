#include "subdiv/edit/weld.h"

#include "subdiv/boundary.h"
#include "subdiv/primitives.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edit_model.h"

namespace argil::subdiv {
namespace {

using namespace test;
using testing::HasSubstr;

std::vector<VertexId> all_vertices(const Solid& solid) {
  std::vector<VertexId> result;
  for (const VertexId v : solid.vertices()) result.push_back(v);
  return result;
}

Weld welded(EditModel& model, double tolerance) {
  Weld done;
  model.apply([&](Transaction& t, const Eigen::Matrix3Xd& p) {
    done = weld(t, p, all_vertices(t.solid()), tolerance);
    return done.edit;
  });
  return done;
}

// The cells of a grid, each with vertices of its own, shrunk about its middle.
EditModel exploded(int n, double shrink) {
  const Built grid = box_grid(n, n, n, Eigen::Vector3d::Constant(n));
  CellLists lists = cell_lists(grid.solid, grid.positions);
  const auto corners = lists.connectivity;
  lists.positions.resize(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t k = i / 8 * 8; k < i / 8 * 8 + 8; ++k)
      middle += grid.positions.col(static_cast<Eigen::Index>(corners[k])) / 8;
    const Eigen::Vector3d from = grid.positions.col(static_cast<Eigen::Index>(corners[i])) - middle;
    lists.positions.col(static_cast<Eigen::Index>(i)) = middle + (1 - shrink) * from;
    lists.connectivity[i] = static_cast<std::uint32_t>(i);
  }
  return EditModel(build(lists));
}

TEST(Weld, ScatteredCellsBecomeAGrid) {
  for (const double shrink : {0.0, 0.01}) {
    EditModel model = exploded(3, shrink);
    ASSERT_EQ(model.solid.vertex_count(), 27u * 8);
    const Weld done = welded(model, shrink == 0 ? 0 : 0.02);
    const Built grid = box_grid(3, 3, 3, {3, 3, 3});
    EXPECT_EQ(model.solid.vertex_count(), grid.solid.vertex_count());
    EXPECT_EQ(model.solid.edge_count(), grid.solid.edge_count());
    EXPECT_EQ(model.solid.face_count(), grid.solid.face_count());
    EXPECT_EQ(done.vertices_gone, 27u * 8 - 64);
    EXPECT_EQ(done.faces_glued, 54u);
    EXPECT_EQ(done.edit.merged.size(), done.vertices_gone);
    // Inner vertices are the mean of eight that stood around them.
    if (shrink > 0) (void)model.vertex_at({1, 1, 1});
  }
}

TEST(Weld, WhatIsFurtherApartStaysApart) {
  EditModel model = exploded(2, 0.01);
  const Weld done = welded(model, 0.005);
  EXPECT_EQ(done.vertices_gone, 0u);
  EXPECT_EQ(model.solid.vertex_count(), 64u);
}

TEST(Weld, AChainOfNeighboursBecomesOne) {
  EditModel model(build(cubes({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}})));
  const VertexId a = model.vertex_at({1, 0, 0}), b = model.vertex_at({2, 0, 0}), c = model.vertex_at({4, 0, 0});
  model.positions.col(static_cast<Eigen::Index>(b.index())).x() = 1.1;
  model.positions.col(static_cast<Eigen::Index>(c.index())).x() = 1.2;
  const Weld done = welded(model, 0.11);
  EXPECT_EQ(done.vertices_gone, 2u);
  EXPECT_EQ(done.faces_glued, 0u);
  EXPECT_NEAR(model.at(a).x(), 1.1, 1e-15);
  EXPECT_EQ(vertex_cells(model.solid, a).size(), 3u);
}

TEST(Weld, InteriorVerticesAreLeftAlone) {
  EditModel model(box_grid(2, 2, 2, {2, 2, 2}));
  const VertexId inside = model.vertex_at({1, 1, 1}), other = model.vertex_at({1, 1, 2});
  model.positions.col(static_cast<Eigen::Index>(inside.index())) = model.at(other);
  EXPECT_EQ(welded(model, 0.5).vertices_gone, 0u);
}

TEST(Weld, ACellWithTwoEqualCornersIsNamed) {
  EditModel model(build(cubes({{0, 0, 0}})));
  const auto tool = [&](double tolerance) {
    return [=](Transaction& t, const Eigen::Matrix3Xd& p) {
      return weld(t, p, all_vertices(t.solid()), tolerance).edit;
    };
  };
  EXPECT_THAT(model.refusal(tool(1)), HasSubstr("of cell 0 would become one"));
  EXPECT_THAT(model.refusal(tool(-1)), HasSubstr("tolerance of 0 or more, found -1"));
}

TEST(Weld, HugeCoordinatesAndTinyTolerancesDoNotOverflow) {
  EditModel model(build(cubes({{0, 0, 0}, {2, 0, 0}})));
  model.positions *= 1e9;
  EXPECT_EQ(welded(model, 1e-300).vertices_gone, 0u);
}

TEST(Weld, EveryShapeOfTheCatalogueIsItselfAfterwards) {
  for (const Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    EditModel model(shape.solid, shape.positions);
    const std::uint64_t before = model.solid.topology_hash();
    EXPECT_EQ(welded(model, 1e-9).vertices_gone, 0u);
    EXPECT_EQ(model.solid.topology_hash(), before);
  }
}

}  // namespace
}  // namespace argil::subdiv
