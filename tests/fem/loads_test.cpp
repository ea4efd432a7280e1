#include "fem/loads.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <numeric>

#include "subdiv/error.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;

SurfacePatch side(const SimulatedSolid& solid, int axis, double value) {
  std::vector<subdiv::FaceId> faces;
  const subdiv::Solid& finest = solid.refinement.solid();
  for (const subdiv::FaceId f : finest.faces()) {
    if (!finest.is_boundary(f)) continue;
    bool inside = true;
    for (const subdiv::VertexId v : finest.face_vertices(f)) {
      const auto node = static_cast<Eigen::Index>(solid.discretization.surface_node_from_vertex[v.index()]);
      inside = inside && std::abs(solid.discretization.rest_nodes(axis, node) - value) < 1e-9;
    }
    if (inside) faces.push_back(f);
  }
  return surface_patch(solid.discretization, finest, faces);
}

/// Moment about the origin of generalised forces: exact, since rotations are linear in the control points.
Eigen::Vector3d moment(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& forces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < points.cols(); ++i) sum += Eigen::Vector3d(points.col(i)).cross(forces.col(i));
  return sum;
}

class LoadsInBothSpaces : public testing::TestWithParam<Space> {
 protected:
  LoadsInBothSpaces() : solid(test::box(3, 2, 2, {0.3, 0.2, 0.2}), 1, {1000, 0.3, 1000, 0}, {GetParam(), 1}) {}
  SimulatedSolid solid;
};

TEST_P(LoadsInBothSpaces, GravityIsTheWeightAtTheCentreOfMass) {
  const Eigen::Vector3d g(1, 2, -9.81);
  const Eigen::Matrix3Xd forces = gravity_forces(solid.discretization, g);
  const double mass = 12;  // 0.012 m³ of 1000 kg/m³
  EXPECT_LE((forces.rowwise().sum() - mass * g).norm(), 1e-12 * mass);
  EXPECT_LE((moment(solid.rest, forces) - mass * Eigen::Vector3d(0.15, 0.1, 0.1).cross(g)).norm(), 1e-12 * mass);
}

TEST_P(LoadsInBothSpaces, TractionActsAtTheCentreOfItsSide) {
  const SurfacePatch end = side(solid, 0, 0.3);
  const Eigen::Matrix3Xd& nodes = solid.discretization.rest_nodes;
  EXPECT_NEAR(area(end, nodes), 0.04, 1e-15);
  const Eigen::Vector3d traction(3, 4, 5), force = 0.04 * traction;
  for (const Eigen::Matrix3Xd& forces : {traction_forces(solid.discretization, end, nodes, traction),
                                         spread_force(solid.discretization, end, nodes, force)}) {
    EXPECT_LE((forces.rowwise().sum() - force).norm(), 1e-13);
    EXPECT_LE((moment(solid.rest, forces) - Eigen::Vector3d(0.3, 0.1, 0.1).cross(force)).norm(), 1e-13);
  }
  const Eigen::Matrix3Xd pushed = pressure_forces(solid.discretization, end, nodes, 7);
  EXPECT_LE((pushed.rowwise().sum() - Eigen::Vector3d(-0.28, 0, 0)).norm(), 1e-13);
}

TEST_P(LoadsInBothSpaces, PressureOnAClosedSurfaceBalances) {
  const SurfacePatch all = whole_surface(solid.discretization, solid.refinement.solid());
  Eigen::Matrix3Xd bent = solid.rest;
  for (Eigen::Index i = 0; i < bent.cols(); ++i) bent(2, i) += 0.5 * bent(0, i) * bent(0, i) + 0.1 * bent(1, i);
  const Eigen::Matrix3Xd forces = pressure_forces(solid.discretization, all, nodes(solid.system, bent), 1000);
  // ∮ n dA and ∮ x × n dA vanish; 2×2 points integrate both exactly over bilinear quadrilaterals.
  EXPECT_LE(forces.rowwise().sum().norm(), 1e-12 * 1000);
  EXPECT_LE(moment(bent, forces).norm(), 1e-12 * 1000);
}

TEST_P(LoadsInBothSpaces, LocateFindsTheRestPoint) {
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0.07, 0.13, 0.11), Eigen::Vector3d(0.15, 0.1, 0.1),
                                   Eigen::Vector3d(0.3, 0.2, 0.2), Eigen::Vector3d(0.299, 0.001, 0.1)}) {
    const MaterialPoint point = locate(solid.discretization, x);
    EXPECT_LE((position(point.stencil, solid.rest) - x).norm(), 1e-12);
    EXPECT_NEAR(std::accumulate(point.stencil.weights.begin(), point.stencil.weights.end(), 0.0), 1, 1e-13);
    const Eigen::Vector3d force(1, 2, 3);
    const Eigen::Matrix3Xd forces = point_forces(point.stencil, solid.system.rows->column_count, force);
    EXPECT_LE((moment(solid.rest, forces) - x.cross(force)).norm(), 1e-12);
  }
  EXPECT_THROW(static_cast<void>(locate(solid.discretization, {0.31, 0.1, 0.1})), Error);
}

TEST_P(LoadsInBothSpaces, BrushTakesHoldOfMoreThanOneVertex) {
  const SurfacePatch all = whole_surface(solid.discretization, solid.refinement.solid());
  const Eigen::Matrix3Xd& nodes = solid.discretization.rest_nodes;
  for (const Falloff falloff : {Falloff::constant, Falloff::linear, Falloff::smooth})
    for (const double radius : {0.15, 1e-4}) {  // the second meets no quadrature point and is widened
      const PointStencil grip =
          brush_stencil(solid.discretization, all, nodes, {{0.15, 0.1, 0.2}, radius, falloff});
      EXPECT_NEAR(std::accumulate(grip.weights.begin(), grip.weights.end(), 0.0), 1, 1e-13);
      EXPECT_GE(grip.control_points.size(), 9U);
      // By symmetry the mean of what it touches lies above the centre, not beneath the middle of the body.
      const Eigen::Vector3d held = position(grip, solid.rest);
      EXPECT_LE((held - Eigen::Vector3d(0.15, 0.1, held.z())).norm(), 1e-12);
      EXPECT_GT(held.z(), 0.17);
    }
  EXPECT_THROW(static_cast<void>(brush_stencil(solid.discretization, {}, nodes, {{0, 0, 0}, 0.1})), Error);
  EXPECT_THROW(static_cast<void>(brush_stencil(solid.discretization, all, nodes, {{0, 0, 0}, 0})), Error);
}

INSTANTIATE_TEST_SUITE_P(Spaces, LoadsInBothSpaces, testing::Values(Space::standard, Space::cubic),
                         [](const auto& chosen) {
                           return std::string(chosen.param == Space::standard ? "Default" : "Cubic");
                         });

TEST(Loads, RefusesAnInnerFace) {
  const SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 1);
  const subdiv::Solid& finest = solid.refinement.solid();
  for (const subdiv::FaceId f : finest.faces()) {
    if (finest.is_boundary(f)) continue;
    const std::array<subdiv::FaceId, 1> faces{f};
    EXPECT_THROW(static_cast<void>(surface_patch(solid.discretization, finest, faces)), Error);
    return;
  }
}

}  // namespace
}  // namespace argil::fem
