#include "subdiv/refinement_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "subdiv/error.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"
#include "subdiv/refinement.h"
#include "subdiv/skin.h"
#include "subdiv/validate.h"
#include "tests/shapes/sharp_shapes.h"
#include "tests/subdiv/grid_coordinates.h"
#include "tests/subdiv/reference_subdivider.h"

namespace argil::subdiv {
namespace {

using namespace test;

// Coordinates are of order one, weights of one sign nearly everywhere: a few hundred roundings.
constexpr double k_tolerance = 1e-13;

ReferenceSolid reference_solid(const Shape& shape) {
  ReferenceSolid result;
  for (Eigen::Index i = 0; i < shape.positions.cols(); ++i) result.points.push_back(shape.positions.col(i));
  for (const CellId c : shape.solid.cells()) {
    result.cells.emplace_back();
    for (const FaceUseId use : shape.solid.cell_face_uses(c)) {
      result.cells.back().emplace_back();
      for (const VertexId v : use_vertices(shape.solid, use))
        result.cells.back().back().push_back(static_cast<int>(v.index()));
    }
  }
  const auto set_sharpness = [&](const auto& vertices, double sharpness) {
    PointSet name;
    for (const VertexId v : vertices) name.insert(static_cast<int>(v.index()));
    if (sharpness > 0) result.sharpness[name] = sharpness;
  };
  for (const EdgeId e : shape.solid.edges())
    set_sharpness(shape.solid.edge_vertices(e), shape.solid.edge_sharpness(e));
  for (const VertexId v : shape.solid.vertices()) set_sharpness(std::array{v}, shape.solid.vertex_sharpness(v));
  for (const FaceId f : shape.solid.faces())
    if (!shape.solid.is_boundary(f)) set_sharpness(shape.solid.face_vertices(f), shape.solid.face_sharpness(f));
  return result;
}

// Cells as the loops that bound them, each turned to begin with its lowest vertex.
using Loops = std::multiset<std::vector<int>>;
Loops canonical(std::vector<std::vector<int>> cell) {
  Loops loops;
  for (auto& loop : cell) {
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    loops.insert(loop);
  }
  return loops;
}

void expect_agreement(const std::vector<Shape>& shapes, std::size_t most_cells) {
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    ReferenceSolid reference = reference_solid(shape);
    std::vector<int> name(shape.solid.vertex_capacity());  // the reference's number of each vertex
    for (std::size_t i = 0; i < name.size(); ++i) name[i] = static_cast<int>(i);
    Solid solid = shape.solid;
    Eigen::Matrix3Xd positions = shape.positions;
    for (int level = 1; level <= 2 && solid.cell_count() < most_cells; ++level) {
      const RefinementStep step = refine(solid);
      const ReferenceStep expected = refine(reference);
      positions = apply(step.stencils, positions);

      std::vector<int> fine_name(step.fine.vertex_capacity(), -1);
      const auto name_point = [&](std::size_t fine, const auto& coarse_vertices) {
        PointSet key;
        for (const VertexId v : coarse_vertices) key.insert(name[v.index()]);
        fine_name[fine] = expected.fine_from_coarse.at(key);
      };
      for (const VertexId v : solid.vertices()) name_point(v.index(), std::array{v});
      for (const EdgeId e : solid.edges()) name_point(step.first_edge_point + e.index(), solid.edge_vertices(e));
      for (const FaceId f : solid.faces()) name_point(step.first_face_point + f.index(), solid.face_vertices(f));
      for (const CellId c : solid.cells()) name_point(step.first_cell_point + c.index(), cell_vertices(solid, c));

      ASSERT_EQ(step.fine.vertex_count(), expected.fine.points.size());
      for (const VertexId v : step.fine.vertices())
        EXPECT_LE((positions.col(static_cast<Eigen::Index>(v.index())) -
                   expected.fine.points[static_cast<std::size_t>(fine_name[v.index()])])
                      .norm(),
                  k_tolerance)
            << "vertex " << v.value << " of level " << level;

      std::multiset<Loops> cells, expected_cells;
      for (const auto& cell : expected.fine.cells) expected_cells.insert(canonical(cell));
      for (const CellId c : step.fine.cells()) {
        std::vector<std::vector<int>> loops;
        for (const FaceUseId use : step.fine.cell_face_uses(c)) {
          loops.emplace_back();
          for (const VertexId v : use_vertices(step.fine, use)) loops.back().push_back(fine_name[v.index()]);
        }
        cells.insert(canonical(loops));
      }
      EXPECT_EQ(cells, expected_cells);

      solid = step.fine;
      reference = expected.fine;
      name = fine_name;
    }
  }
}

TEST(MacCrackenJoy, AgreesWithTheReferenceSubdividerOnTheCatalogue) {
  expect_agreement(catalogue(), 60);
}

TEST(MacCrackenJoy, AgreesWithTheReferenceSubdividerWhereItIsSemiSharp) {
  expect_agreement(semi_sharp_shapes(), 60);
}

TEST(MacCrackenJoy, AgreesWithTheReferenceSubdividerOnSharpSheets) {
  expect_agreement(sharp_sheets(), 60);
}

TEST(MacCrackenJoy, KeepsEveryInvariantOfTheSolidAndItsEulerNumber) {
  const auto euler = [](const Solid& s) {
    return static_cast<long>(s.vertex_count()) - static_cast<long>(s.edge_count()) +
           static_cast<long>(s.face_count()) - static_cast<long>(s.cell_count());
  };
  for (const Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const Refinement refinement = refine_to_level(shape.solid, 2);
    for (const Solid& level : refinement.levels) {
      EXPECT_EQ(euler(level), euler(shape.solid));
      EXPECT_THAT(validate(level), testing::IsEmpty());
    }
  }
}

TEST(MacCrackenJoy, EveryStencilSumsToOneAndAffineMapsCommute) {
  Eigen::Matrix3d map;
  map << 0.3, -1.2, 0.5, 2.0, 0.1, -0.7, 0.4, 0.9, 1.1;
  const Eigen::Vector3d shift(3, -2, 0.5);
  for (const Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const RefinementStep step = refine(shape.solid);
    for (std::size_t i = 0; i < step.stencils.row_count(); ++i) {
      const StencilRow row = step.stencils.row(i);
      double sum = 0;
      for (const double w : row.weights) sum += w;
      EXPECT_NEAR(sum, 1, 1e-15 * 16) << i;
      EXPECT_TRUE(std::is_sorted(row.columns.begin(), row.columns.end(), std::less_equal<>()));
    }
    const Eigen::Matrix3Xd mapped = (map * shape.positions).colwise() + shift;
    const Eigen::Matrix3Xd after = (map * apply(step.stencils, shape.positions)).colwise() + shift;
    EXPECT_LE((apply(step.stencils, mapped) - after).cwiseAbs().maxCoeff(), 1e-13 * 10);
  }
}

TEST(MacCrackenJoy, CornerWithKEdgesBecomesACellOfTwoKQuadrilaterals) {
  for (const Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const RefinementStep step = refine(shape.solid);
    for (const CellId fine : step.fine.cells()) {
      std::size_t k = 0;
      for (const EdgeId e : cell_edges(shape.solid, step.coarse_from_fine[fine])) {
        const auto& ends = shape.solid.edge_vertices(e);
        k += ends[0] == step.corner_from_fine[fine] || ends[1] == step.corner_from_fine[fine] ? 1 : 0;
      }
      EXPECT_EQ(step.fine.cell_face_uses(fine).size(), 2 * k);
      for (const FaceUseId use : step.fine.cell_face_uses(fine))
        EXPECT_EQ(step.fine.face_vertices(face_of(use)).size(), 4U);
      const auto vertices = cell_vertices(step.fine, fine);
      // The cell holds its corner's vertex point and its parent's cell point, unless the solid has dead ids.
      EXPECT_THAT(vertices, testing::Contains(VertexId{step.corner_from_fine[fine].index()}));
      EXPECT_THAT(vertices,
                  testing::Contains(VertexId{step.first_cell_point + step.coarse_from_fine[fine].index()}));
    }
  }
}

TEST(MacCrackenJoy, TetrahedronPrismAndPyramidSplitAsTheLiteratureSays) {
  const auto faces_of_children = [](const Solid& solid) {
    std::multiset<std::size_t> faces;
    const Solid fine = refine(solid).fine;
    for (const CellId c : fine.cells()) faces.insert(fine.cell_face_uses(c).size());
    return faces;
  };
  EXPECT_THAT(faces_of_children(tetrahedron({1, 1, 1}).solid), testing::ElementsAre(6, 6, 6, 6));
  EXPECT_THAT(faces_of_children(wedge({1, 1, 1}).solid), testing::ElementsAre(6, 6, 6, 6, 6, 6));
  EXPECT_THAT(faces_of_children(pyramid({1, 1, 1}).solid), testing::ElementsAre(6, 6, 6, 6, 8));
}

// One direction of a grid that ends naturally: p₋₁ = 2p₀ − p₁ leaves the end points where they are.
Eigen::MatrixXd knot_insertion(Eigen::Index count) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(2 * count - 1, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    if (i == 0 || i == count - 1) {
      m(2 * i, i) = 1;
    } else {
      m(2 * i, i - 1) = m(2 * i, i + 1) = 1.0 / 8;
      m(2 * i, i) = 6.0 / 8;
    }
    if (i + 1 < count) m(2 * i + 1, i) = m(2 * i + 1, i + 1) = 0.5;
  }
  return m;
}

// Largest distance of a refined grid from knot insertion, over the vertices at least `margin` from its sides.
double knot_insertion_error(const Built& grid, int cells, int level, int margin) {
  const Eigen::Matrix3Xd control = random_positions(grid.solid.vertex_capacity(), 11);
  const Refinement refinement = refine_to_level(grid.solid, level);
  const Eigen::Matrix3Xd fine = apply(refinement.stencils.back(), control);
  const auto coordinates = grid_coordinates(refinement, grid.positions);
  Eigen::MatrixXd line = Eigen::MatrixXd::Identity(cells + 1, cells + 1);
  for (int l = 0; l < level; ++l) line = knot_insertion(line.rows()) * line;
  const Eigen::Index n = cells + 1, end = line.rows() - 1 - margin;
  double error = 0;
  for (std::size_t v = 0; v < coordinates.size(); ++v) {
    const Eigen::Vector3i at = coordinates[v];
    if (at.minCoeff() < margin || at.maxCoeff() > end) continue;
    Eigen::Vector3d expected(0, 0, 0);
    for (Eigen::Index i = 0; i < control.cols(); ++i) {
      const Eigen::Index x = i % n, y = i / n % n, z = i / (n * n);
      expected += line(at[0], x) * line(at[1], y) * line(at[2], z) * control.col(i);
    }
    error = std::max(error, (fine.col(static_cast<Eigen::Index>(v)) - expected).norm());
  }
  return error;
}

TEST(MacCrackenJoy, InteriorOfARegularGridReproducesTricubicKnotInsertion) {
  for (int level = 1; level <= 2; ++level)
    EXPECT_LE(knot_insertion_error(box_grid(5, 5, 5, {5, 5, 5}), 5, level, 1 << level), k_tolerance);
}

TEST(MacCrackenJoy, SharpBoxIsATensorProductUpToItsCorners) {
  for (int level = 1; level <= 2; ++level)
    EXPECT_LE(knot_insertion_error(sharp_box_grid(4, 4, 4, {4, 4, 4}), 4, level, 0), k_tolerance);
  EXPECT_LE(knot_insertion_error(sharp_box_grid(1, 1, 1, {1, 1, 1}), 1, 3, 0), k_tolerance);
}

TEST(MacCrackenJoy, CubeMatchesTheClosedForm) {  // REFERENCES §8, for the cube ±1
  const Built cube = box_grid(1, 1, 1, {2, 2, 2});
  const RefinementStep step = refine(cube.solid);
  const Eigen::Matrix3Xd fine = apply(step.stencils, cube.positions);
  for (Eigen::Index i = 0; i < fine.cols(); ++i) {
    const Eigen::Vector3d sorted = (fine.col(i).array() - 1).abs();
    const auto at = static_cast<std::size_t>(i);
    const double sum = sorted.sum(), largest = sorted.maxCoeff();
    if (at < step.first_edge_point) {
      EXPECT_NEAR(largest, 5.0 / 9, 1e-15);
      EXPECT_NEAR(sum, 15.0 / 9, 4e-15);
    } else if (at < step.first_face_point) {
      EXPECT_NEAR(largest, 0.75, 1e-15);
      EXPECT_NEAR(sum, 1.5, 1e-15);
    } else if (at < step.first_cell_point) {
      EXPECT_NEAR(largest, 1, 1e-15);
      EXPECT_NEAR(sum, 1, 1e-15);
    } else {
      EXPECT_NEAR(sum, 0, 1e-15);
    }
  }
}

TEST(MacCrackenJoy, BoundaryThatIsNoManifoldIsSharpThere) {
  {  // two cubes that share an edge: its ends are where sheets end
    const Built built = build(cubes({{0, 0, 0}, {1, 1, 0}}));
    const EdgeId shared = *built.solid.find_edge(VertexId{2}, VertexId{6});
    EXPECT_EQ(Skin(built.solid).rule(shared, Phase::parent), EdgeRule::crease);
    EXPECT_EQ(Skin(built.solid).rule(VertexId{2}, Phase::parent), VertexRule::corner);
    EXPECT_EQ(Skin(built.solid).rule(VertexId{0}, Phase::parent), VertexRule::smooth);
    const RefinementStep step = refine(built.solid);
    const Eigen::Matrix3Xd fine = apply(step.stencils, built.positions);
    const auto middle = static_cast<Eigen::Index>(step.first_edge_point + shared.index());
    EXPECT_EQ(fine.col(2), built.positions.col(2));
    EXPECT_EQ(fine.col(middle), (built.positions.col(2) + built.positions.col(6)) / 2);
    // Where two branching edges hold all sheets together the vertex is a crease.
    EXPECT_EQ(Skin(step.fine).rule(VertexId{step.first_edge_point + shared.index()}, Phase::parent),
              VertexRule::crease);
  }
  {  // two cubes that share a vertex
    const Built built = build(cubes({{0, 0, 0}, {1, 1, 1}}));
    EXPECT_EQ(Skin(built.solid).rule(VertexId{6}, Phase::parent), VertexRule::corner);
    EXPECT_EQ(apply(refine(built.solid).stencils, built.positions).col(6), built.positions.col(6));
  }
}

template <class Call>
std::string refusal(const Call& call, ErrorCode code) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_FALSE(error.where().empty());
    return error.what();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

TEST(MacCrackenJoy, RefusesAnInteriorEdgeOfTwoFacesByName) {
  // A bent wall between two prisms: the bend is an edge of two faces inside the solid.
  const Built built = build(
      stacked({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {1.3, 1}}, {{0, 1, 6, 4, 5}, {1, 2, 3, 4, 6}}, 1));
  EXPECT_THAT(refusal([&] { (void)refine(built.solid); }, ErrorCode::bad_topology),
              testing::HasSubstr("(vertices 6 and 13) lies inside the solid with 2 faces"));
}

TEST(MacCrackenJoy, RefusesASmoothBoundaryVertexOfTwoEdgesButNotASharpOne) {
  CellLists lists = points(9);  // a cube with a vertex in the middle of one edge
  add_polyhedron(lists, {{3, 2, 1, 8, 0}, {4, 5, 6, 7}, {0, 8, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
  Solid solid = build(lists).solid;
  EXPECT_THAT(refusal([&] { (void)refine(solid); }, ErrorCode::bad_topology),
              testing::HasSubstr("vertex 8 is smooth and has 2 edges"));
  sharpen(solid, {}, {VertexId{8}});
  EXPECT_NO_THROW((void)refine(solid));
}

TEST(MacCrackenJoy, RefusesWhatIsSharpInsideTheSolidAndOnNoSheet) {
  const Solid grid = box_grid(2, 2, 2, {1, 1, 1}).solid;
  const EdgeId inside = *grid.find_edge(VertexId{13}, VertexId{4});
  Solid sharp_edge = grid, sharp_vertex = grid;
  sharpen(sharp_edge, {inside});
  sharpen(sharp_vertex, {}, {VertexId{13}});
  EXPECT_THAT(refusal([&] { (void)refine(sharp_edge); }, ErrorCode::unsupported),
              testing::HasSubstr("sharp inside the solid"));
  EXPECT_THAT(refusal([&] { (void)refine(sharp_vertex); }, ErrorCode::unsupported),
              testing::HasSubstr("vertex 13 is sharp inside"));
  // On a sheet both are taken.
  std::vector<FaceId> sheet;
  sharp_edge.for_each_face(inside, [&](FaceId f) { sheet.push_back(f); });
  for (Solid* solid : {&sharp_edge, &sharp_vertex}) {
    sharpen(*solid, sheet, 2);
    EXPECT_NO_THROW((void)refine(*solid));
  }
}

TEST(MacCrackenJoy, SharpnessFallsByOneALevelAndInfiniteSharpnessStays) {
  Solid solid = box_grid(2, 2, 2, {1, 1, 1}).solid;
  const EdgeId edge = *solid.find_edge(VertexId{0}, VertexId{1});
  const FaceId face = *solid.find_face(std::array{VertexId{4}, VertexId{13}, VertexId{14}, VertexId{5}});
  sharpen(solid, std::vector{face}, 2.5);
  {
    Transaction edit(solid);
    edit.set_sharpness(edge, 1.7);
    edit.set_sharpness(VertexId{0}, 10);
    edit.set_sharpness(VertexId{13}, 7);  // but its sheet is no sharper than 2.5
    (void)edit.commit();
  }
  const Refinement refinement = refine_to_level(solid, 3);
  const auto sharpest = [&](std::size_t level, auto ids, auto sharpness) {
    std::multiset<double> found;
    for (const auto id : ids)
      if (sharpness(id) > 0) found.insert(std::round(1e6 * sharpness(id)) / 1e6);
    return std::pair(level, found);
  };
  for (std::size_t level = 1; level <= 3; ++level) {
    const Solid& s = refinement.levels[level];
    const auto edges = sharpest(level, s.edges(), [&](EdgeId e) { return s.edge_sharpness(e); }).second;
    const auto faces = sharpest(level, s.faces(), [&](FaceId f) { return s.face_sharpness(f); }).second;
    const auto vertices = sharpest(level, s.vertices(), [&](VertexId v) { return s.vertex_sharpness(v); }).second;
    EXPECT_EQ(edges, level == 1 ? (std::multiset<double>{0.7, 0.7}) : std::multiset<double>{});
    EXPECT_EQ(faces.size(), level == 3 ? 0U : (level == 1 ? 4U : 16U));
    EXPECT_EQ(vertices, level == 1   ? (std::multiset<double>{1.5, 10})
                        : level == 2 ? (std::multiset<double>{0.5, 10})
                                     : std::multiset<double>{10});
  }
}

TEST(MacCrackenJoy, SharpnessPassesToTheHalvesOfAnEdge) {
  const Solid fine = refine(sharp_box_grid(2, 2, 2, {1, 1, 1}).solid).fine;
  std::size_t sharp = 0;
  for (const EdgeId e : fine.edges()) {
    EXPECT_EQ(fine.edge_sharpness(e) == k_infinitely_sharp, fine.edge_valence(e) == 2);
    sharp += fine.edge_sharpness(e) > 0 ? 1 : 0;
  }
  EXPECT_EQ(sharp, 12U * 4);
}

TEST(MacCrackenJoy, DeadIdsAreSqueezedOutAndTheirColumnsStayEmpty) {
  Built built = box_grid(3, 1, 1, {3, 1, 1});
  Transaction edit(built.solid);
  edit.remove_cell(CellId{0});
  (void)edit.commit();
  const RefinementStep step = refine(built.solid);
  EXPECT_EQ(step.fine.cell_count(), 16U);
  EXPECT_EQ(step.fine.vertex_capacity(), step.fine.vertex_count());
  EXPECT_THAT(validate(step.fine), testing::IsEmpty());
  // The two cells that are left, shifted: the same positions as a box of two.
  const Built two = box_grid(2, 1, 1, {2, 1, 1});
  const Eigen::Matrix3Xd shifted = apply(step.stencils, built.positions).colwise() - Eigen::Vector3d(1, 0, 0);
  Eigen::Matrix3Xd expected = apply(refine(two.solid).stencils, two.positions);
  EXPECT_NEAR(shifted.rowwise().sum().norm(), expected.rowwise().sum().norm(), 1e-13);
  EXPECT_NEAR(shifted.squaredNorm(), expected.squaredNorm(), 1e-13);
}

}  // namespace
}  // namespace argil::subdiv
