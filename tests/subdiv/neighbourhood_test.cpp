#include "subdiv/neighbourhood.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <set>

#include "subdiv/limit.h"
#include "subdiv/radial_edge.h"
#include "subdiv/refinement.h"
#include "tests/shapes/shapes.h"

namespace argil::subdiv {
namespace {

using namespace test;

std::map<CellClass, std::size_t> counts(const Solid& solid) {
  std::map<CellClass, std::size_t> result;
  const CellData<CellClass> classes = classify_cells(solid);
  for (const CellId c : solid.cells()) ++result[classes[c]];
  return result;
}

TEST(Neighbourhood, CountsOfTheThreeBlockAreThoseOfTable1) {  // papers/004
  auto found = counts(refine_to_level(box_grid(3, 3, 3, {1, 1, 1}).solid, 2).solid());
  EXPECT_EQ(found[CellClass::regular_published], 1000U);
  EXPECT_EQ(found[CellClass::regular_boundary], 600U);
  EXPECT_EQ(found[CellClass::extraordinary], 128U);
  EXPECT_EQ(found[CellClass::irregular], 0U);
}

TEST(Neighbourhood, BoundaryCellsOfAGridAreRegularAsFarAsItsEdgesAllow) {
  auto smooth = counts(box_grid(12, 12, 12, {1, 1, 1}).solid);
  EXPECT_EQ(smooth[CellClass::regular_published], 1000U);
  EXPECT_EQ(smooth[CellClass::regular_published] + smooth[CellClass::regular_boundary], 1600U);
  auto sharp = counts(sharp_box_grid(12, 12, 12, {1, 1, 1}).solid);
  EXPECT_EQ(sharp[CellClass::regular_published], 1000U);
  EXPECT_EQ(sharp[CellClass::regular_published] + sharp[CellClass::regular_boundary], 1728U);
}

TEST(Neighbourhood, IrregularCellsLeaveOneTwoFourALevel) {  // METHODS §1, a pyramid
  const Refinement refinement = refine_to_level(pyramid({1, 1, 1}).solid, 3);
  for (std::size_t level = 0; level <= 3; ++level)
    EXPECT_EQ(counts(refinement.levels[level])[CellClass::irregular],
              std::size_t{1} << (level > 0 ? level - 1 : 0));
}

TEST(Neighbourhood, WhatIsSharpInTheWrongPlaceIsNotRegular) {
  Built grid = box_grid(4, 4, 4, {4, 4, 4});
  EXPECT_EQ(counts(grid.solid)[CellClass::regular_boundary], 24U);
  // Vertex (2, 2, 0) in the middle of a side is made a corner: the four cells at it lose their nets.
  sharpen(grid.solid, {}, {VertexId{2 + 5 * 2}});
  EXPECT_EQ(counts(grid.solid)[CellClass::regular_boundary], 20U);
}

TEST(Neighbourhood, BoxIsRightHandedAndBeginsAtTheLowestVertex) {
  for (const Built& grid : {box_grid(3, 3, 3, {1, 1, 1}), shuffled(box_grid(3, 3, 3, {1, 1, 1}), 1),
                            shuffled(sharp_box_grid(2, 3, 4, {1, 1, 1}), 2)})
    for (const CellId c : grid.solid.cells()) {
      const auto box = box_vertices(grid.solid, c);
      EXPECT_EQ(box[0], *std::min_element(box.begin(), box.end()));
      EXPECT_LT(box[4], box[2]);
      EXPECT_LT(box[4], box[1]);
      const auto at = [&](std::size_t i) -> Eigen::Vector3d { return grid.positions.col(box[i].value); };
      const Eigen::Vector3d u = at(4) - at(0), v = at(2) - at(0), w = at(1) - at(0);
      EXPECT_GT(u.cross(v).dot(w), 0);
      // The other corners of a parallelepiped: bits add up.
      for (std::size_t i = 0; i < 8; ++i)
        EXPECT_LE((at(i) - at(0) - (i & 4U ? 1 : 0) * u - (i & 2U ? 1 : 0) * v - (i & 1U ? 1 : 0) * w).norm(),
                  1e-15);
    }
}

Eigen::Matrix3Xd net_positions(const RegularNets& nets, std::size_t i, const Eigen::Matrix3Xd& positions,
                               const Eigen::Matrix3Xd& phantoms) {
  Eigen::Matrix3Xd net(3, 64);
  for (std::size_t n = 0; n < 64; ++n) {
    const auto node = static_cast<Eigen::Index>(nets.nodes[i][n]);
    net.col(static_cast<Eigen::Index>(n)) =
        node < positions.cols() ? positions.col(node) : phantoms.col(node - positions.cols());
  }
  return net;
}

// Solids with regular cells of every kind: inside, at one side, at box edges and corners, between two sides.
std::vector<Shape> shapes_with_nets() {
  std::vector<Shape> shapes;
  const auto add = [&](const std::string& name, Built built) {
    const Eigen::Matrix3Xd positions = random_positions(built.solid.vertex_capacity(), 7);
    shapes.push_back({name, std::move(built.solid), positions, false});
  };
  add("grid", shuffled(box_grid(5, 4, 4, {1, 1, 1}), 3));
  add("sharp box", sharp_box_grid(4, 3, 3, {1, 1, 1}));
  add("slab", shuffled(box_grid(5, 4, 1, {1, 1, 1}), 4));
  add("sharp slab", sharp_box_grid(4, 3, 1, {1, 1, 1}));
  add("sharp bar", sharp_box_grid(4, 1, 1, {1, 1, 1}));
  add("sharp cube", sharp_box_grid(1, 1, 1, {1, 1, 1}));
  Built shuffled_box = shuffled(box_grid(3, 3, 2, {1, 1, 1}), 9);
  sharpen(shuffled_box.solid, box_edges(shuffled_box.solid));
  add("sharp box, shuffled", shuffled_box);
  const auto add_refined = [&](const std::string& name, const Solid& solid, int level) {
    Solid fine = refine_to_level(solid, level).solid();
    const Eigen::Matrix3Xd positions = random_positions(fine.vertex_capacity(), 8);
    shapes.push_back({name, std::move(fine), positions, false});
  };
  add_refined("refined fan", build(fan(5, 2)).solid, 2);
  add_refined("refined pyramid", pyramid({1, 1, 1}).solid, 3);
  return shapes;
}

TEST(Neighbourhood, NetReproducesTheLimitAtTheCornersOfItsCell) {
  for (const Shape& shape : shapes_with_nets()) {
    SCOPED_TRACE(shape.name);
    const RegularNets nets = regular_nets(shape.solid, classify_cells(shape.solid));
    ASSERT_FALSE(nets.cells.empty());
    const Eigen::Matrix3Xd limits = apply(limit_stencils(shape.solid), shape.positions);
    const Eigen::Matrix3Xd phantoms = apply(nets.phantoms, shape.positions);
    constexpr double k_weights[2][4] = {{1.0 / 6, 4.0 / 6, 1.0 / 6, 0}, {0, 1.0 / 6, 4.0 / 6, 1.0 / 6}};
    for (std::size_t i = 0; i < nets.cells.size(); ++i) {
      const Eigen::Matrix3Xd net = net_positions(nets, i, shape.positions, phantoms);
      const auto box = box_vertices(shape.solid, nets.cells[i]);
      for (std::size_t corner = 0; corner < 8; ++corner) {
        Eigen::Vector3d at(0, 0, 0);
        for (std::size_t n = 0; n < 64; ++n)
          at += k_weights[corner >> 2][n / 16] * k_weights[corner >> 1 & 1U][n / 4 % 4] *
                k_weights[corner & 1U][n % 4] * net.col(static_cast<Eigen::Index>(n));
        // Phantoms have weights up to 8 in sum 27, so a few more roundings than the rules.
        EXPECT_LE((at - limits.col(box[corner].value)).norm(), 1e-14) << "cell " << nets.cells[i].value;
      }
    }
  }
}

// The five control points a direction that knot insertion makes of four.
Eigen::MatrixXd insert_knots() {
  Eigen::MatrixXd m(5, 4);
  m << 4, 4, 0, 0, 1, 6, 1, 0, 0, 4, 4, 0, 0, 1, 6, 1, 0, 0, 4, 4;
  return m / 8;
}

TEST(Neighbourhood, NetOfAChildIsKnotInsertionOfItsParents) {
  const Eigen::MatrixXd insertion = insert_knots();
  for (const Shape& shape : shapes_with_nets()) {
    SCOPED_TRACE(shape.name);
    const RegularNets coarse = regular_nets(shape.solid, classify_cells(shape.solid));
    const RefinementStep step = refine(shape.solid);
    const RegularNets fine = regular_nets(step.fine, classify_cells(step.fine));
    const Eigen::Matrix3Xd positions = apply(step.stencils, shape.positions);
    const Eigen::Matrix3Xd coarse_phantoms = apply(coarse.phantoms, shape.positions);
    const Eigen::Matrix3Xd fine_phantoms = apply(fine.phantoms, positions);
    std::size_t compared = 0;
    for (std::size_t child = 0; child < fine.cells.size(); ++child) {
      const CellId parent = step.coarse_from_fine[fine.cells[child]];
      const auto at = std::lower_bound(coarse.cells.begin(), coarse.cells.end(), parent);
      if (at == coarse.cells.end() || *at != parent) continue;
      ++compared;
      const Eigen::Matrix3Xd net = net_positions(coarse, static_cast<std::size_t>(at - coarse.cells.begin()),
                                                 shape.positions, coarse_phantoms);
      const auto inserted = [&](const Eigen::Vector3i& place) {
        Eigen::Vector3d sum(0, 0, 0);
        for (int n = 0; n < 64; ++n)
          sum += insertion(place[0], n / 16) * insertion(place[1], n / 4 % 4) * insertion(place[2], n % 4) *
                 net.col(n);
        return sum;
      };
      // Where the child's frame lies in the parent's 5³ points: its own corners say.
      const auto box = box_vertices(step.fine, fine.cells[child]);
      const auto place_of = [&](VertexId v) {
        for (int n = 0; n < 27; ++n) {
          const Eigen::Vector3i place(1 + n / 9, 1 + n / 3 % 3, 1 + n % 3);
          if ((inserted(place) - positions.col(v.value)).norm() < 1e-12) return place;
        }
        ADD_FAILURE() << "vertex " << v.value << " is not among the points of its parent";
        return Eigen::Vector3i(1, 1, 1);
      };
      const Eigen::Vector3i origin = place_of(box[0]);
      Eigen::Matrix3i frame;
      frame << place_of(box[4]) - origin, place_of(box[2]) - origin, place_of(box[1]) - origin;
      EXPECT_EQ(frame.cast<double>().determinant(), 1) << "frames of parent and child have one handedness";
      const Eigen::Matrix3Xd child_net = net_positions(fine, child, positions, fine_phantoms);
      for (int n = 0; n < 64; ++n) {
        const Eigen::Vector3i place = origin + frame * Eigen::Vector3i(n / 16 - 1, n / 4 % 4 - 1, n % 4 - 1);
        ASSERT_TRUE((place.array() >= 0).all() && (place.array() < 5).all());
        EXPECT_LE((inserted(place) - child_net.col(n)).norm(), 1e-13) << n;
      }
    }
    EXPECT_EQ(compared, 8 * coarse.cells.size()) << "every child of a regular cell is regular";
  }
}

TEST(Neighbourhood, PublishedNetHasSixtyFourVerticesAndNoPhantoms) {
  const Solid solid = box_grid(5, 5, 5, {1, 1, 1}).solid;
  const CellData<CellClass> classes = classify_cells(solid);
  const RegularNets nets = regular_nets(solid, classes);
  for (std::size_t i = 0; i < nets.cells.size(); ++i) {
    std::size_t phantom_count = 0;
    for (const std::uint32_t node : nets.nodes[i]) phantom_count += node >= solid.vertex_capacity() ? 1 : 0;
    EXPECT_EQ(phantom_count, classes[nets.cells[i]] == CellClass::regular_published ? 0U : 16U);
    EXPECT_EQ(std::set(nets.nodes[i].begin(), nets.nodes[i].end()).size(), 64U);
  }
  // Phantoms are shared: one outside each vertex of the six sides.
  EXPECT_EQ(nets.phantoms.row_count(), 6U * 36);
}

}  // namespace
}  // namespace argil::subdiv
