#include "subdiv/solidify/solidify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "subdiv/boundary.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/primitives/round.h"
#include "subdiv/solid_measures.h"
#include "subdiv/solidify/voxels.h"
#include "subdiv/validate.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

struct Polygons {
  Eigen::Matrix3Xd positions;
  std::vector<std::size_t> offsets{0};
  std::vector<std::uint32_t> corners;

  ClosedSurface closed() const { return closed_surface(positions, offsets, corners); }
  void turn() {
    for (std::size_t f = 0; f + 1 < offsets.size(); ++f)
      std::reverse(corners.begin() + static_cast<std::ptrdiff_t>(offsets[f]),
                   corners.begin() + static_cast<std::ptrdiff_t>(offsets[f + 1]));
  }
  void add(const Polygons& other) {
    const auto first = static_cast<std::uint32_t>(positions.cols());
    Eigen::Matrix3Xd both(3, positions.cols() + other.positions.cols());
    both << positions, other.positions;
    positions = both;
    for (const std::uint32_t v : other.corners) corners.push_back(first + v);
    const std::size_t before = offsets.back();
    for (std::size_t f = 1; f < other.offsets.size(); ++f) offsets.push_back(before + other.offsets[f]);
  }
};

Polygons boundary_of(const Built& built) {
  const BoundarySurface surface = boundary_surface(built.solid);
  Polygons result;
  result.positions.resize(3, static_cast<Eigen::Index>(surface.vertex_from_surface.size()));
  for (std::size_t v = 0; v < surface.vertex_from_surface.size(); ++v)
    result.positions.col(static_cast<Eigen::Index>(v)) =
        built.positions.col(static_cast<Eigen::Index>(surface.vertex_from_surface[v].index()));
  result.offsets = surface.offsets;
  result.corners = surface.corners;
  return result;
}

// A tube's or a leg's worth of boundary bent over a quarter circle.
Polygons bent_tube() {
  Built built = cylinder(0.2, 3, {16, 24, 1});
  for (Eigen::Index v = 0; v < built.positions.cols(); ++v) {
    const Eigen::Vector3d p = built.positions.col(v);
    const double angle = p.z() / 3 * std::numbers::pi / 2 * 1.5;
    built.positions.col(v) << (1 + p.x()) * std::cos(angle), p.y(), (1 + p.x()) * std::sin(angle);
  }
  return boundary_of(built);
}

Polygons table() {
  using test::cubes;
  CellLists lists = cubes({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {6, 6, 0}, {0, 0, 1}, {6, 0, 1}, {0, 6, 1}, {6, 6, 1}});
  Built legs = build(lists);
  Polygons result = boundary_of(legs);
  Built top = box_grid(1, 1, 1, {7, 7, 1});
  top.positions.row(2).array() += 1.5;  // legs reach into it
  result.add(boundary_of(top));
  return result;
}

double volume_of(const Built& built) {
  return mass_properties(built.solid, built.positions).volume;
}

void expect_sound(const Solidified& made) {
  EXPECT_THAT(validate(made.built.solid), testing::IsEmpty());
  const auto worst = min_scaled_jacobian(made.built.solid, made.built.positions);
  ASSERT_TRUE(worst);
  EXPECT_GT(worst->value, 0.1);
}

struct Target {
  std::string name;
  Polygons surface;
  int cells;
  double tolerance;  // of the volume, relative
  int genus;
};

TEST(Solidify, FillsSurfacesWithOpenCells) {
  for (const Target& target : {Target{"sphere", boundary_of(sphere(1, {48, 1, 1})), 10, 0.04, 0},
                               Target{"torus", boundary_of(torus(1, 0.4, {24, 48, 1})), 14, 0.08, 1},
                               Target{"bent tube", bent_tube(), 24, 0.12, 0},
                               Target{"box", boundary_of(box_grid(1, 1, 1, {1, 2, 1})), 8, 0.1, 0}}) {
    SCOPED_TRACE(target.name);
    const ClosedSurface surface = target.surface.closed();
    const double longest =
        (surface.positions.rowwise().maxCoeff() - surface.positions.rowwise().minCoeff()).maxCoeff();
    const Solidified made = solidify(surface, {.cell_size = longest / target.cells});
    expect_sound(made);
    EXPECT_NEAR(volume_of(made.built), surface.volume, target.tolerance * surface.volume);
    EXPECT_EQ(boundary_surface(made.built.solid).genus, target.genus);
    EXPECT_EQ(made.component_count, 1u);
    EXPECT_LT(made.largest_gap, longest / target.cells);
  }
}

TEST(Solidify, FinerCellsComeNearer) {
  const ClosedSurface ball = boundary_of(sphere(1, {96, 1, 1})).closed();
  std::vector<double> errors;
  for (const int cells : {6, 12}) errors.push_back(ball.volume - volume_of(solidify(ball, {2.0 / cells}).built));
  EXPECT_LT(std::abs(errors[1]), 0.45 * std::abs(errors[0]));
}

TEST(Solidify, OverlappingPartsAreOneAndSaidSo) {
  const ClosedSurface surface = table().closed();
  EXPECT_EQ(surface.component_count, 5u);
  const Solidified made = solidify(surface, {.cell_size = 0.5});
  EXPECT_GT(made.overlapping_samples, 0u);
  EXPECT_EQ(made.inside_out_samples, 0u);
  EXPECT_EQ(made.component_count, 1u);
  EXPECT_THAT(validate(made.built.solid), testing::IsEmpty());
  EXPECT_EQ(inverted_cells(made.built.solid, made.built.positions).count, 0u);
  EXPECT_NEAR(volume_of(made.built), 49 + 4 * 1.5, 0.12 * 55);
}

TEST(Solidify, ThinPartsAreMissedAndTheGapTells) {
  const ClosedSurface surface = table().closed();
  const Solidified made = solidify(surface, {.cell_size = 2.5});
  EXPECT_GT(made.largest_gap, 0.5);
  const ClosedSurface needle = boundary_of(box_grid(1, 1, 1, {10, 0.1, 0.1})).closed();
  EXPECT_GT(solidify(needle, {.cell_size = 0.1}).built.solid.cell_count(), 100u);
}

TEST(Solidify, MoreLayersAndNone) {
  const ClosedSurface ball = boundary_of(sphere(1, {32, 1, 1})).closed();
  const std::size_t none = solidify(ball, {.cell_size = 0.25, .layers = 0}).built.solid.cell_count();
  const Solidified one = solidify(ball, {.cell_size = 0.25, .layers = 1}),
                   two = solidify(ball, {.cell_size = 0.25, .layers = 2});
  expect_sound(one);
  expect_sound(two);
  EXPECT_EQ(two.built.solid.cell_count() - one.built.solid.cell_count(), one.built.solid.cell_count() - none);
}

TEST(ClosedSurface, InwardOnesAreTurned) {
  Polygons ball = boundary_of(sphere(1, {16, 1, 1}));
  const double volume = ball.closed().volume;
  EXPECT_FALSE(ball.closed().was_inward);
  ball.turn();
  EXPECT_TRUE(ball.closed().was_inward);
  EXPECT_NEAR(ball.closed().volume, volume, 1e-12);
  EXPECT_NEAR(volume_of(solidify(ball.closed(), {.cell_size = 0.25}).built), volume, 0.1 * volume);
}

TEST(ClosedSurface, PolygonsThatOnlyShareThePlacesOfTheirPointsAreClosed) {
  const Polygons box = boundary_of(box_grid(1, 1, 1, {1, 1, 1}));
  Polygons soup;
  soup.positions.resize(3, static_cast<Eigen::Index>(box.corners.size()));
  for (std::uint32_t i = 0; i < box.corners.size(); ++i) {
    soup.positions.col(i) = box.positions.col(box.corners[i]);
    soup.corners.push_back(i);
  }
  soup.offsets = box.offsets;
  const ClosedSurface surface = soup.closed();
  EXPECT_EQ(surface.positions.cols(), 8);
  EXPECT_DOUBLE_EQ(surface.volume, 1);
}

TEST(ClosedSurface, OpenOnesAreRefusedWithThePlace) {
  Polygons open = boundary_of(box_grid(1, 1, 1, {1, 1, 1}));
  open.offsets.pop_back();
  open.corners.resize(open.offsets.back());
  try {
    (void)open.closed();
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_topology);
    EXPECT_THAT(error.what(), testing::HasSubstr("open along 4 edges"));
  }
  Polygons turned = boundary_of(box_grid(1, 1, 1, {1, 1, 1}));
  std::reverse(turned.corners.begin(), turned.corners.begin() + 4);
  try {
    (void)turned.closed();
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_topology);
    EXPECT_THAT(error.what(), testing::HasSubstr("disagree"));
  }
  Polygons flat;
  flat.positions.resize(3, 3);
  flat.positions << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  flat.corners = {0, 1, 2, 0, 2, 1};
  flat.offsets = {0, 3, 6};
  EXPECT_THROW((void)flat.closed(), Error);
  flat.positions(0, 0) = std::nan("");
  EXPECT_THROW((void)flat.closed(), Error);
}

TEST(Voxels, LinesThroughEdgesAndCornersCountOnce) {
  // Samples lie on the diagonals of the sides, and the shape is symmetric about the middle plane.
  const ClosedSurface surface = boundary_of(box_grid(2, 2, 2, {1, 1, 1})).closed();
  for (const int n : {1, 2, 3, 8}) {
    Voxels voxels = voxel_grid(surface, 1.0 / n);
    fill(voxels, surface, {});
    EXPECT_EQ(voxels.overlapping + voxels.inside_out, 0u);
    for (const std::uint8_t inside : voxels.samples_inside) EXPECT_EQ(inside, 27);
  }
}

TEST(Voxels, CubesThatTouchInEdgesOrCornersAreJoined) {
  for (const unsigned pattern : {0b00001001U, 0b10000001U, 0b01101001U, 0b01111110U, 0b11110110U}) {
    Voxels voxels;
    voxels.size = 1;
    voxels.counts = {4, 4, 4};
    voxels.samples_inside.assign(64, 0);
    voxels.filled.assign(64, 0);
    for (unsigned bit = 0; bit < 8; ++bit)
      if (pattern >> bit & 1U)
        voxels.filled[voxels.number(1 + int(bit & 1U), 1 + int(bit >> 1 & 1U), 1 + int(bit >> 2 & 1U))] = 1;
    EXPECT_GT(make_manifold(voxels), 0u) << pattern;
    EXPECT_EQ(make_manifold(voxels), 0u) << pattern;
    std::size_t filled = 0;
    for (const std::uint8_t f : voxels.filled) filled += f;
    EXPECT_LE(filled, 8u);
  }
}

}  // namespace
}  // namespace argil::subdiv
