#include "fem/discretization.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>

#include "subdiv/build.h"
#include "subdiv/error.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::Material;
using test::SimulatedSolid;

constexpr DiscretizationOptions k_cubic{Space::cubic, 1};

/// Three blocks of n³ cells about one edge of valence 3, as a cube seen along its diagonal, extruded by n cells of
/// size h: n − 1 interior extraordinary edges… each block is a sheared grid.
subdiv::Built three_blocks(int n, double h) {
  subdiv::CellLists lists;
  std::vector<Eigen::Vector3d> points;
  const auto point = [&](const Eigen::Vector3d& x) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((points[i] - x).norm() < 1e-6 * h) return static_cast<std::uint32_t>(i);
    points.push_back(x);
    return static_cast<std::uint32_t>(points.size() - 1);
  };
  for (int b = 0; b < 3; ++b) {
    const double pi = std::acos(-1.0), s = 2 * pi * b / 3, t = 2 * pi * (b + 1) / 3;
    const Eigen::Vector3d u = h * Eigen::Vector3d(std::cos(s), std::sin(s), 0),
                          v = h * Eigen::Vector3d(std::cos(t), std::sin(t), 0), w(0, 0, h);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
          const auto at = [&](int di, int dj, int dk) { return point((i + di) * u + (j + dj) * v + (k + dk) * w); };
          for (const auto& d : {std::array{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
                                {0, 1, 1}})
            lists.connectivity.push_back(at(d[0], d[1], d[2]));
          lists.kinds.push_back(subdiv::CellKind::hexahedron);
          lists.offsets.push_back(lists.connectivity.size());
        }
  }
  lists.positions.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) lists.positions.col(static_cast<Eigen::Index>(i)) = points[i];
  return subdiv::build(lists);
}

Eigen::Matrix3Xd affine(const Eigen::Matrix3Xd& points) {
  Eigen::Matrix3d gradient;
  gradient << 1.01, 0.004, -0.003, 0.002, 0.995, 0.006, 0.001, -0.002, 1.007;
  return (gradient * points).colwise() + Eigen::Vector3d(0.1, 0.2, 0.3);
}

/// A stress that the affine displacement above brings about, to compare forces with.
double stress(const Material& material) { return 0.01 * material.young_modulus; }

/// Largest force on an inner control point under an affine displacement.
double inner_control_residual(const SimulatedSolid& solid) {
  Eigen::Matrix3Xd forces;
  solid.model->forces(nodes(solid.system, affine(solid.rest)), forces);
  const Eigen::Matrix3Xd reduced = generalised_forces(solid.system, forces);
  double largest = 0;
  for (const subdiv::VertexId v : solid.refinement.levels[0].vertices())
    if (!solid.refinement.levels[0].is_boundary(v))
      largest = std::max(largest, reduced.col(static_cast<Eigen::Index>(v.index())).norm());
  return largest;
}

/// In the default space: largest force on an inner vertex of the finest level; the forces on virtual centres go to the
/// vertices that they are means of.
double inner_vertex_residual(const SimulatedSolid& solid) {
  Eigen::Matrix3Xd forces;
  solid.model->forces(nodes(solid.system, affine(solid.rest)), forces);
  const Eigen::Matrix3Xd onto_vertices =
      subdiv::apply(subdiv::transpose(solid.discretization.field_samples.rows), forces);
  double largest = 0;
  for (const subdiv::VertexId v : solid.refinement.solid().vertices())
    if (!solid.refinement.solid().is_boundary(v))
      largest = std::max(largest, onto_vertices.col(static_cast<Eigen::Index>(v.index())).norm());
  return largest;
}

TEST(Discretization, DefaultSpacePassesThePatchTestWithPyramids) {
  for (const auto& built : {subdiv::pyramid({1, 1, 1}), subdiv::tetrahedron({1, 1, 1}), subdiv::wedge({1, 1, 1})})
    for (const int level : {1, 2}) {
      const SimulatedSolid solid(built, level);
      // Rounding of forces of size E h in a sum of some tens of terms.
      EXPECT_LE(inner_vertex_residual(solid), 1e-12 * stress({}));
    }
  const SimulatedSolid with_pyramids(subdiv::pyramid({1, 1, 1}), 2);
  EXPECT_GT(with_pyramids.discretization.elements.pyramid, 0U);
  EXPECT_GT(with_pyramids.discretization.elements.linear, 0U);
}

TEST(Discretization, AllTricubicRegionsPassThePatchTest) {
  for (const int level : {0, 1}) {
    const SimulatedSolid solid(test::box(5, 5, 5, {1, 1, 1}), level, {}, k_cubic);
    EXPECT_EQ(solid.discretization.elements.cubic, 125U);
    EXPECT_EQ(solid.discretization.elements.linear, 0U);
    EXPECT_LE(inner_control_residual(solid), 1e-13 * stress({}));
  }
}

TEST(Discretization, CubicSpaceHasThePatchResidualOfItsSplit) {
  const int n = 4;
  const double h = 1.0 / n;
  for (int level = 0; level < 2; ++level)
  for (int split = 0; split < 3; ++split) {
    const SimulatedSolid solid(three_blocks(n, h), level, {}, {Space::cubic, split});
    const auto& d = solid.discretization;
    std::printf("level %d split %d: cubic %zu linear %zu pyramid %zu residual %.5f sigma h2\n", level, split, d.elements.cubic,
                d.elements.linear, d.elements.pyramid, inner_control_residual(solid) / (stress({}) * h * h));
  }
}

TEST(Discretization, SharpBoxIsTricubicAtLevelZero) {
  const SimulatedSolid solid(test::box(12, 12, 12, {1, 1, 1}), 0, {}, k_cubic);
  EXPECT_EQ(solid.discretization.elements.cubic, 1728U);
  EXPECT_EQ(solid.discretization.elements.linear, 0U);
  EXPECT_EQ(solid.discretization.cells.regular, 1728U);
  EXPECT_EQ(solid.discretization.cells.regular_published, 1000U);
}

}  // namespace
}  // namespace argil::fem
