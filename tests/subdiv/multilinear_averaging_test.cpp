#include "subdiv/multilinear_averaging.h"

#include <gtest/gtest.h>

#include "subdiv/limit.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"
#include "subdiv/refinement.h"
#include "tests/shapes/sharp_shapes.h"

namespace argil::subdiv {
namespace {

using namespace test;

constexpr RuleSet k_rules = RuleSet::multilinear_averaging;

// The definition, done: centroids of elements, then of the fine cells about each fine vertex.
Eigen::Matrix3Xd split_and_average(const Solid& solid, const RefinementStep& step, const Eigen::Matrix3Xd& x) {
  const auto mean = [](const Eigen::Matrix3Xd& of, const auto& vertices) {
    Eigen::Vector3d sum(0, 0, 0);
    for (const VertexId v : vertices) sum += of.col(v.value) / static_cast<double>(vertices.size());
    return sum;
  };
  Eigen::Matrix3Xd split(3, static_cast<Eigen::Index>(step.fine.vertex_count()));
  Eigen::Index next = 0;
  for (const VertexId v : solid.vertices()) split.col(next++) = x.col(v.value);
  for (const EdgeId e : solid.edges()) split.col(next++) = mean(x, solid.edge_vertices(e));
  for (const FaceId f : solid.faces()) split.col(next++) = mean(x, solid.face_vertices(f));
  for (const CellId c : solid.cells()) split.col(next++) = mean(x, cell_vertices(solid, c));
  Eigen::Matrix3Xd averaged = split;
  for (const VertexId v : step.fine.vertices()) {
    std::vector<Eigen::Vector3d> centroids;
    if (!step.fine.is_boundary(v))
      for (const CellId c : vertex_cells(step.fine, v))
        centroids.push_back(mean(split, cell_vertices(step.fine, c)));
    else
      for (const FaceId f : vertex_faces(step.fine, v))
        if (step.fine.is_boundary(f)) centroids.push_back(mean(split, step.fine.face_vertices(f)));
    averaged.col(v.value).setZero();
    for (const auto& c : centroids) averaged.col(v.value) += c / static_cast<double>(centroids.size());
  }
  return averaged;
}

TEST(MultilinearAveraging, IsASplitAndThenTheMeanOfTheCentroidsAboutEachPoint) {
  for (const Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const RefinementStep step = refine(shape.solid, k_rules);
    const Eigen::Matrix3Xd fine = apply(step.stencils, shape.positions);
    const Eigen::Matrix3Xd expected = split_and_average(shape.solid, step, shape.positions);
    const Skin skin(shape.solid), fine_skin(step.fine);
    std::size_t compared = 0;
    for (const VertexId v : step.fine.vertices()) {
      const VertexRule rule = fine_skin.rule(v, Phase::parent);
      if (rule != VertexRule::interior && rule != VertexRule::smooth) continue;
      if (v.index() < step.first_edge_point && skin.rule(v, Phase::parent) == VertexRule::corner) continue;
      EXPECT_LE((fine.col(v.value) - expected.col(v.value)).norm(), 1e-14) << "vertex " << v.value;
      ++compared;
    }
    EXPECT_GT(compared, 0U);
  }
}

TEST(MultilinearAveraging, EveryStencilSumsToOneAndIsPositive) {
  const auto check = [](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) {
      SCOPED_TRACE(shape.name);
      const Stencils rows = refine(shape.solid, k_rules).stencils;
      for (std::size_t i = 0; i < rows.row_count(); ++i) {
        double sum = 0;
        for (const double w : rows.row(i).weights) {
          EXPECT_GT(w, 0);
          sum += w;
        }
        EXPECT_NEAR(sum, 1, 2e-14);  // blends of rows of a hundred terms
      }
    }
  };
  check(catalogue());
  check(semi_sharp_shapes());
  check(sharp_sheets());
}

TEST(MultilinearAveraging, AgreesWithMacCrackenJoyOnGridsWhateverTheirSharpEdges) {
  const auto largest_difference = [](const Solid& solid) {
    const Eigen::Matrix3Xd x = random_positions(solid.vertex_capacity(), 2);
    return (apply(refine_to_level(solid, 2).stencils.back(), x) -
            apply(refine_to_level(solid, 2, k_rules).stencils.back(), x))
        .cwiseAbs()
        .maxCoeff();
  };
  // MacCracken–Joy on sharp grids is knot insertion (its tests), so these are tricubic B-splines.
  EXPECT_LE(largest_difference(sharp_box_grid(3, 4, 3, {3, 4, 3}).solid), 1e-14);
  EXPECT_LE(largest_difference(sharp_box_grid(1, 1, 1, {1, 1, 1}).solid), 1e-14);
  EXPECT_GE(largest_difference(build(fan(5, 2)).solid), 1e-2);
}

TEST(MultilinearAveraging, RegularNetsReproduceItsLimits) {
  for (Solid solid : {sharp_box_grid(3, 3, 3, {1, 1, 1}).solid, box_grid(4, 4, 4, {1, 1, 1}).solid,
                      refine_to_level(build(fan(5, 2)).solid, 2, k_rules).solid()}) {
    const Eigen::Matrix3Xd x = random_positions(solid.vertex_capacity(), 5);
    const Eigen::Matrix3Xd limits = apply(limit_stencils(solid, k_rules), x);
    const RegularNets nets = regular_nets(solid, classify_cells(solid));
    ASSERT_FALSE(nets.cells.empty());
    const Eigen::Matrix3Xd phantoms = apply(nets.phantoms, x);
    constexpr double k_weights[2][4] = {{1.0 / 6, 4.0 / 6, 1.0 / 6, 0}, {0, 1.0 / 6, 4.0 / 6, 1.0 / 6}};
    for (std::size_t i = 0; i < nets.cells.size(); ++i) {
      const auto box = box_vertices(solid, nets.cells[i]);
      for (std::size_t corner = 0; corner < 8; ++corner) {
        Eigen::Vector3d at(0, 0, 0);
        for (std::size_t n = 0; n < 64; ++n) {
          const auto node = static_cast<Eigen::Index>(nets.nodes[i][n]);
          at += k_weights[corner >> 2][n / 16] * k_weights[corner >> 1 & 1U][n / 4 % 4] *
                k_weights[corner & 1U][n % 4] * (node < x.cols() ? x.col(node) : phantoms.col(node - x.cols()));
        }
        EXPECT_LE((at - limits.col(box[corner].value)).norm(), 1e-13);
      }
    }
  }
}

TEST(MultilinearAveraging, SplitsAsMacCrackenJoyDoes) {
  for (const Shape& shape : catalogue())
    EXPECT_EQ(refine(shape.solid, k_rules).fine.topology_hash(), refine(shape.solid).fine.topology_hash());
}

}  // namespace
}  // namespace argil::subdiv
