#include "fem/models/spring_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "subdiv/error.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;

std::ptrdiff_t count_of(const std::vector<LatticeSpring>& springs, SpringKind kind) {
  return std::count_if(springs.begin(), springs.end(), [&](const LatticeSpring& s) { return s.kind == kind; });
}

TEST(SpringLattice, HasEachSpringOfAGridOfCubesOnce) {
  constexpr int nx = 3, ny = 2, nz = 4;
  const SimulatedSolid body(subdiv::box_grid(nx, ny, nz, {nx, ny, nz}), 0);
  const auto both = spring_lattice(body.discretization.blocks, DiagonalSprings::both);
  const int edges = nx * (ny + 1) * (nz + 1) + (nx + 1) * ny * (nz + 1) + (nx + 1) * (ny + 1) * nz;
  const int faces = nx * ny * (nz + 1) + nx * (ny + 1) * nz + (nx + 1) * ny * nz;
  EXPECT_EQ(count_of(both, SpringKind::edge), edges);
  EXPECT_EQ(count_of(both, SpringKind::face_diagonal), 2 * faces);
  EXPECT_EQ(count_of(both, SpringKind::inner_diagonal), 4 * nx * ny * nz);
  EXPECT_TRUE(std::is_sorted(both.begin(), both.end()));
  for (const LatticeSpring& spring : both) {
    EXPECT_LT(spring.from, spring.to);
    const auto& nodes = body.discretization.rest_nodes;
    const double squared = (nodes.col(spring.from) - nodes.col(spring.to)).squaredNorm();
    EXPECT_NEAR(squared, 1 + static_cast<int>(spring.kind), 1e-12);  // of unit cubes: 1, √2, √3
  }
  const auto m1 = spring_lattice(body.discretization.blocks, DiagonalSprings::faces);
  EXPECT_EQ(static_cast<int>(m1.size()), edges + 2 * faces);
  const auto m2 = spring_lattice(body.discretization.blocks, DiagonalSprings::inner);
  EXPECT_EQ(static_cast<int>(m2.size()), edges + 4 * nx * ny * nz);
}

TEST(SpringLattice, AreTheSpringsWhoseEnergyTheModelHas) {
  // At ν = 1/4 nothing but springs between two nodes is left (papers/001, Appendix A).
  const SimulatedSolid body(subdiv::box_grid(1, 1, 1, {0.1, 0.1, 0.1}), 0, {.poisson_ratio = 0.25});
  const Eigen::Matrix3Xd& rest = body.discretization.rest_nodes;
  Eigen::Matrix3d map;
  map << 1.1, 0.2, 0, -0.1, 0.9, 0.05, 0.3, 0, 1.2;
  const Eigen::Matrix3Xd now = map * rest;
  for (const DiagonalSprings diagonals : {DiagonalSprings::faces, DiagonalSprings::both}) {
    const MassSpringOptions options{.diagonals = diagonals};
    const double shear = 1000 / 2.5;
    const CubeSprings k = cube_springs(options, shear, shear, 0.1);
    double energy = 0;
    for (const LatticeSpring& spring : spring_lattice(body.discretization.blocks, diagonals)) {
      const double longer =
          (now.col(spring.from) - now.col(spring.to)).norm() - (rest.col(spring.from) - rest.col(spring.to)).norm();
      const double stiffness = spring.kind == SpringKind::edge            ? k.edge
                               : spring.kind == SpringKind::face_diagonal ? k.face
                                                                          : k.inner;
      energy += 0.5 * stiffness * longer * longer;
    }
    const auto model = make_mass_spring(body.discretization.blocks, rest, options);
    EXPECT_NEAR(model->energy(now), energy, 1e-12 * energy);
  }
}

TEST(SpringLattice, OfChosenCellsLeavesTheOthersOut) {
  const SimulatedSolid body(subdiv::box_grid(2, 1, 1, {2, 1, 1}), 0);
  const std::vector<std::uint8_t> first{1, 0};
  const auto springs = spring_lattice(body.discretization.blocks, DiagonalSprings::faces, first);
  EXPECT_EQ(springs.size(), 24U);
  for (const LatticeSpring& spring : springs)
    for (const std::uint32_t node : {spring.from, spring.to})
      EXPECT_LE(body.discretization.rest_nodes(0, node), 1 + 1e-12);
}

TEST(SpringLattice, RefusesElementsOtherThanHexahedra) {
  const SimulatedSolid cubic(subdiv::box_grid(3, 3, 3, {1, 1, 1}), 1, {}, {.space = Space::cubic});
  try {
    (void)spring_lattice(cubic.discretization.blocks, DiagonalSprings::faces);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
  }
}

}  // namespace
}  // namespace argil::fem
