#include "subdiv/primitives/round.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "subdiv/boundary.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "subdiv/solid_measures.h"
#include "subdiv/validate.h"

namespace argil::subdiv {
namespace {

using std::numbers::pi;

struct Case {
  std::string name;
  std::function<Built(const RoundGrid&)> make;
  double volume;
  int genus;
  std::size_t rim_edges;  // times `around`
  std::function<double(const RoundGrid&)> cells;
};

std::vector<Case> cases() {
  const auto swept = [](const RoundGrid& grid) { return disk_cell_count(grid) * grid.along; };
  return {
      {"cylinder", [](const RoundGrid& g) { return cylinder(0.7, 2, g); }, pi * 0.49 * 2, 0, 2, swept},
      {"tube", [](const RoundGrid& g) { return tube(0.7, 0.3, 2, g); }, pi * (0.49 - 0.09) * 2, 1, 4,
       [](const RoundGrid& g) { return double(g.around) * g.rings * g.along; }},
      {"cone", [](const RoundGrid& g) { return cone(0.7, 0, 2, g); }, pi * 0.49 * 2 / 3, 0, 1, swept},
      {"frustum", [](const RoundGrid& g) { return cone(0.7, 0.2, 2, g); }, pi * 2 / 3 * (0.49 + 0.14 + 0.04), 0, 2,
       swept},
      {"torus", [](const RoundGrid& g) { return torus(1, 0.4, g); }, 2 * pi * pi * 0.16, 1, 0, swept},
      {"sphere", [](const RoundGrid& g) { return sphere(0.7, g); }, 4 * pi / 3 * 0.343, 0, 0, sphere_cell_count},
  };
}

double volume_of(const Built& built) {
  return mass_properties(built.solid, built.positions).volume;
}

TEST(RoundPrimitives, HaveTheCountsGenusAndRimsOfTheirKind) {
  for (const Case& shape : cases())
    for (const RoundGrid grid : {RoundGrid{4, 3, 1}, RoundGrid{8, 4, 2}, RoundGrid{12, 5, 1}}) {
      SCOPED_TRACE(shape.name + " around " + std::to_string(grid.around));
      Built built = shape.make(grid);
      EXPECT_THAT(validate(built.solid), testing::IsEmpty());
      EXPECT_EQ(double(built.solid.cell_count()), shape.cells(grid));
      const BoundarySurface surface = boundary_surface(built.solid);
      EXPECT_EQ(surface.genus, shape.genus);
      EXPECT_EQ(surface.component_count, 1u);
      EXPECT_EQ(components(built.solid).count, 1);
      EXPECT_GT(built.positions.row(2).minCoeff(), -1e-12);
      EXPECT_NEAR(mass_properties(built.solid, built.positions).centre.head<2>().norm(), 0, 1e-12);
      EXPECT_EQ(sharpen_outline(built.solid), shape.rim_edges * static_cast<std::size_t>(grid.around));
    }
}

TEST(RoundPrimitives, CellsKeepTheirCornersOpen) {
  for (const Case& shape : cases())
    for (const int around : {4, 8, 16, 32})
      for (const int rings : {1, 2, 4}) {
        const Built built = shape.make({around, 16, rings});
        const auto worst = min_scaled_jacobian(built.solid, built.positions);
        ASSERT_TRUE(worst);
        EXPECT_GT(worst->value, 0.2) << shape.name << " around " << around << " rings " << rings;
        EXPECT_EQ(inverted_cells(built.solid, built.positions).count, 0u);
      }
}

// Points on the surface leave an error that falls with the square of the cells' size: by 4 as the counts double.
TEST(RoundPrimitives, VolumesConvergeWithTheSquareOfTheSize) {
  for (const Case& shape : cases()) {
    std::vector<double> errors;
    for (const int n : {1, 2, 4}) errors.push_back(shape.volume - volume_of(shape.make({8 * n, 8 * n, n})));
    for (const double error : errors) EXPECT_GT(error, 0) << shape.name;  // inscribed
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(errors[i] / errors[i + 1]), 2, 0.15) << shape.name;
    EXPECT_LT(errors[2], 0.02 * shape.volume) << shape.name;
  }
}

TEST(RoundPrimitives, PointsOfTheSurfaceLieOnIt) {
  const Built ball = sphere(2, {12, 1, 2});
  const Built ring = torus(1, 0.4, {8, 12, 1});
  for (const VertexId v : ball.solid.vertices()) {
    if (!ball.solid.is_boundary(v)) continue;
    EXPECT_NEAR((ball.positions.col(v.value) - Eigen::Vector3d(0, 0, 2)).norm(), 2, 1e-12);
  }
  for (const VertexId v : ring.solid.vertices()) {
    if (!ring.solid.is_boundary(v)) continue;
    const Eigen::Vector3d p = ring.positions.col(v.value);
    EXPECT_NEAR(std::hypot(p.head<2>().norm() - 1, p.z() - 0.4), 0.4, 1e-12);
  }
}

TEST(RoundPrimitives, ConesTipIsOfPyramidsThatMeetInTheLastVertex) {
  const RoundGrid grid{8, 3, 1};
  const Built built = cone(1, 0, 2, grid);
  const VertexId apex{built.solid.vertex_capacity() - 1};
  EXPECT_EQ(built.positions.col(apex.value), Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(double(vertex_cells(built.solid, apex).size()), disk_cell_count(grid));
  for (const CellId c : vertex_cells(built.solid, apex)) EXPECT_EQ(cell_kind(built.solid, c), CellKind::pyramid);
}

TEST(RoundPrimitives, RefuseWhatMakesNoShape) {
  const auto code = [](const std::function<Built()>& make) {
    try {
      (void)make();
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::refused;
  };
  EXPECT_EQ(code([] { return cylinder(1, 1, {6, 1, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return cylinder(1, 1, {0, 1, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return cylinder(1, 1, {8, 0, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return cylinder(-1, 1, {8, 1, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return cylinder(1, std::nan(""), {8, 1, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return tube(1, 1, 1, {8, 1, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return tube(1, 0.5, 1, {2, 1, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return torus(1, 1, {8, 8, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return torus(1, 0.5, {8, 2, 1}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return sphere(1, {8, 1, 0}); }), ErrorCode::bad_input);
  EXPECT_EQ(code([] { return sphere(1, {4000, 1, 1000}); }), ErrorCode::limit_exceeded);
  EXPECT_EQ(code([] { return cylinder(1, 1, {2'000'000'000, 1'000'000, 1'000'000}); }), ErrorCode::limit_exceeded);
}

}  // namespace
}  // namespace argil::subdiv
