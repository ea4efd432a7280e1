#include "subdiv/limit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "subdiv/radial_edge.h"
#include "subdiv/refinement.h"
#include "tests/shapes/sharp_shapes.h"
#include "tests/subdiv/grid_coordinates.h"

namespace argil::subdiv {
namespace {

using namespace test;

/// The cells at a vertex alone: the point of that vertex, at every level to come, depends on nothing else.
Shape star_of(const Solid& solid, const Eigen::Matrix3Xd& positions, VertexId v) {
  CellLists all = cell_lists(solid, positions), star;
  star.positions = all.positions;
  const std::vector<CellId> cells = vertex_cells(solid, v);
  for (const CellId c : cells) {  // the solids here have no dead ids
    star.kinds.push_back(all.kinds[c.index()]);
    for (std::size_t i = all.offsets[c.index()]; i < all.offsets[c.index() + 1]; ++i)
      star.connectivity.push_back(all.connectivity[i]);
    star.offsets.push_back(star.connectivity.size());
  }
  Built built = build(star);
  std::vector<VertexId> new_from_old(solid.vertex_capacity());
  for (std::size_t i = 0; i < built.point_from_vertex.size(); ++i)
    new_from_old[built.point_from_vertex[i]] = VertexId{i};
  std::vector<EdgeId> sharp;
  solid.for_each_edge(v, [&](EdgeId e) {
    if (solid.edge_sharpness(e) > 0)
      sharp.push_back(
          *built.solid.find_edge(new_from_old[v.index()], new_from_old[solid.other_vertex(e, v).index()]));
  });
  std::vector<VertexId> corner;
  if (solid.vertex_sharpness(v) > 0) corner.push_back(new_from_old[v.index()]);
  sharpen(built.solid, sharp, corner);
  return {std::to_string(new_from_old[v.index()].value), std::move(built.solid), built.positions, false};
}

/// Where a vertex goes under `count` refinements of its star; stars of the vertex alone are kept between them.
/// A boundary vertex of valence 2 may arise where the star is cut off; corners there leave the star's rules alone.
Eigen::Vector3d refined_position(const Solid& solid, const Eigen::Matrix3Xd& positions, VertexId v, int count,
                                 RuleSet rules) {
  Shape star = star_of(solid, positions, v);
  for (int i = 0; i < count; ++i) {
    const VertexId at{static_cast<std::size_t>(std::stoul(star.name))};
    std::vector<VertexId> outer;
    for (const VertexId w : star.solid.vertices())
      if (w != at && star.solid.is_boundary(w)) outer.push_back(w);
    sharpen(star.solid, {}, outer);
    const RefinementStep step = refine(star.solid, rules);
    star = star_of(step.fine, apply(step.stencils, star.positions), at);
  }
  return star.positions.col(static_cast<Eigen::Index>(std::stoul(star.name)));
}

TEST(Limit, IsWhatManyRefinementsConvergeToAtEveryVertexOfTheCatalogue) {
  for (const RuleSet rules : {RuleSet::maccracken_joy, RuleSet::multilinear_averaging})
    for (const Shape& shape : catalogue()) {
      SCOPED_TRACE(shape.name);
      const Eigen::Matrix3Xd limits = apply(limit_stencils(shape.solid, rules), shape.positions);
      for (const VertexId v : shape.solid.vertices()) {
        // The second eigenvalue is below 0.64 for the valences here: 0.64^60 = 2e-12 of the size of the star.
        const Eigen::Vector3d refined = refined_position(shape.solid, shape.positions, v, 60, rules);
        EXPECT_LE((limits.col(static_cast<Eigen::Index>(v.index())) - refined).norm(), 1e-11)
            << "vertex " << v.value;
      }
    }
}

void expect_limits_to_stay(const std::vector<Shape>& shapes, int level_count, RuleSet rules) {
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    const Stencils coarse = limit_stencils(shape.solid, rules);
    const Eigen::Matrix3Xd before = apply(coarse, shape.positions);
    const Refinement refinement = refine_to_level(shape.solid, level_count, rules);
    const Eigen::Matrix3Xd after =
        apply(limit_stencils(refinement.solid(), rules), apply(refinement.stencils.back(), shape.positions));
    EXPECT_LE((after.leftCols(before.cols()) - before).cwiseAbs().maxCoeff(), 1e-13);
    for (std::size_t i = 0; i < coarse.row_count(); ++i) {
      double sum = 0;
      for (const double w : coarse.row(i).weights) sum += w;
      EXPECT_NEAR(sum, 1, 5e-14);  // an eigenvector of up to 75 numbers
    }
  }
}

TEST(Limit, DoesNotMoveUnderRefinementAndItsRowsSumToOne) {
  for (const RuleSet rules : {RuleSet::maccracken_joy, RuleSet::multilinear_averaging})
    expect_limits_to_stay(catalogue(), 1, rules);
}

TEST(Limit, DoesNotMoveUnderRefinementWhereItIsSemiSharpOrOnASheet) {
  for (const RuleSet rules : {RuleSet::maccracken_joy, RuleSet::multilinear_averaging}) {
    expect_limits_to_stay(semi_sharp_shapes(), 1, rules);
    expect_limits_to_stay(sharp_sheets(), 1, rules);
  }
}

TEST(Limit, IsThatOfTheLevelWhereSharpnessHasGone) {
  Built cube = box_grid(1, 1, 1, {1, 1, 1});
  Transaction edit(cube.solid);
  for (const EdgeId e : cube.solid.edges()) edit.set_sharpness(e, 0.3 + 0.3 * static_cast<double>(e.index()));
  edit.set_sharpness(VertexId{3}, 1.4);
  (void)edit.commit();
  expect_limits_to_stay({{"semi-sharp cube", cube.solid, jittered(cube.positions, 0.1, 1), true}}, 4,
                        RuleSet::maccracken_joy);
}

TEST(Limit, InteriorOfAGridHasOneFourOneWeights) {
  const Built grid = box_grid(4, 4, 4, {4, 4, 4});
  const Stencils limits = limit_stencils(grid.solid);
  const auto weight = [](int offset) { return offset == 0 ? 4.0 / 6 : (std::abs(offset) == 1 ? 1.0 / 6 : 0); };
  for (const int centre : {31, 62}) {  // (1,1,1) and (2,2,2) of 5 × 5 × 5
    const StencilRow row = limits.row(static_cast<std::size_t>(centre));
    ASSERT_EQ(row.columns.size(), 27U);
    for (std::size_t j = 0; j < 27; ++j) {
      const auto column = static_cast<int>(row.columns[j]);
      EXPECT_NEAR(row.weights[j],
                  weight(column % 5 - centre % 5) * weight(column / 5 % 5 - centre / 5 % 5) *
                      weight(column / 25 - centre / 25),
                  2e-15)  // the row is summed from 118 terms
          << column;
    }
  }
}

TEST(Limit, CubeMatchesTheClosedForm) {  // REFERENCES §8, for the cube ±1
  const Built cube = box_grid(1, 1, 1, {2, 2, 2});
  const Eigen::Matrix3Xd corners = apply(limit_stencils(cube.solid), cube.positions);
  for (Eigen::Index i = 0; i < 8; ++i)
    for (const double x : corners.col(i)) EXPECT_NEAR(std::abs(x - 1), 0.5, 1e-15);
  const RefinementStep step = refine(cube.solid);
  const Eigen::Matrix3Xd fine = apply(limit_stencils(step.fine), apply(step.stencils, cube.positions));
  for (std::size_t i = step.first_edge_point; i < step.first_cell_point; ++i) {
    const Eigen::Vector3d at = (fine.col(static_cast<Eigen::Index>(i)).array() - 1).abs();
    const bool edge = i < step.first_face_point;
    EXPECT_NEAR(at.maxCoeff(), edge ? 0.6095679012 : 68.0 / 81, edge ? 5e-11 : 1e-15);  // the edge's to ten digits
    EXPECT_NEAR(at.sum(), edge ? 2 * 0.6095679012 : 68.0 / 81, edge ? 1e-10 : 2e-15);
  }
}

TEST(Limit, RowsOfDeadIdsAreEmpty) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  Transaction edit(built.solid);
  edit.remove_cell(CellId{0});
  (void)edit.commit();
  const Stencils limits = limit_stencils(built.solid);
  ASSERT_EQ(limits.row_count(), 12U);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(limits.row(i).columns.empty(), !built.solid.is_live(VertexId{i}));
}

}  // namespace
}  // namespace argil::subdiv
