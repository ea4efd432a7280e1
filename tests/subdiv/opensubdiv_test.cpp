// The boundary of a refined solid, and sharp sheets inside it, against OpenSubdiv on the surface alone.

#include <gtest/gtest.h>

#include "subdiv/boundary.h"
#include "subdiv/limit.h"
#include "subdiv/refinement.h"
#include "subdiv/refinement_step.h"
#include "tests/shapes/sharp_shapes.h"
#include "tests/subdiv/opensubdiv_oracle.h"

namespace argil::subdiv {
namespace {

using namespace test;

bool is_manifold(const BoundarySurface& surface) {
  const std::set<VertexId> distinct(surface.vertex_from_surface.begin(), surface.vertex_from_surface.end());
  return distinct.size() == surface.vertex_from_surface.size();
}

OpenSubdivResult oracle(const Shape& shape, const BoundarySurface& surface, int level_count) {
  std::vector<std::vector<int>> faces;
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f)
    faces.emplace_back(surface.corners.begin() + static_cast<std::ptrdiff_t>(surface.offsets[f]),
                       surface.corners.begin() + static_cast<std::ptrdiff_t>(surface.offsets[f + 1]));
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(surface.vertex_from_surface.size()));
  std::map<VertexId, int> surface_from_vertex;
  std::map<int, double> corners;
  for (std::size_t i = 0; i < surface.vertex_from_surface.size(); ++i) {
    const VertexId v = surface.vertex_from_surface[i];
    surface_from_vertex[v] = static_cast<int>(i);
    points.col(static_cast<Eigen::Index>(i)) = shape.positions.col(v.value);
    if (shape.solid.vertex_sharpness(v) > 0) corners[static_cast<int>(i)] = shape.solid.vertex_sharpness(v);
  }
  std::map<std::set<int>, double> sharp;
  for (const EdgeId e : shape.solid.edges())
    if (shape.solid.edge_sharpness(e) > 0)
      sharp[{surface_from_vertex.at(shape.solid.edge_vertices(e)[0]),
             surface_from_vertex.at(shape.solid.edge_vertices(e)[1])}] = shape.solid.edge_sharpness(e);
  return refine_with_opensubdiv(points, faces, sharp, corners, level_count);
}

// OpenSubdiv's number of each vertex of a surface in `step.fine`, where `name` has those of `solid`.
std::map<VertexId, int> fine_names(const Solid& solid, const RefinementStep& step,
                                   const std::map<VertexId, int>& name, const OpenSubdivLevel& level,
                                   const std::vector<FaceId>& faces) {
  std::map<VertexId, int> fine;
  const auto name_point = [&](std::size_t point, const auto& coarse_vertices) {
    std::set<int> key;
    for (const VertexId v : coarse_vertices) key.insert(name.at(v));
    fine[VertexId{point}] = level.fine_from_coarse.at(key);
  };
  for (const FaceId f : faces) {
    for (const VertexId v : solid.face_vertices(f)) name_point(v.index(), std::array{v});
    for (const EdgeId e : solid.face_edges(f))
      name_point(step.first_edge_point + e.index(), solid.edge_vertices(e));
    name_point(step.first_face_point + f.index(), solid.face_vertices(f));
  }
  return fine;
}

std::vector<FaceId> boundary_faces(const Solid& solid) {
  std::vector<FaceId> faces;
  for (const FaceId f : solid.faces())
    if (solid.is_boundary(f)) faces.push_back(f);
  return faces;
}

// Refines by both; returns how many vertices were compared, and leaves the last level.
std::size_t compare_boundary(const Shape& shape, const OpenSubdivResult& expected, const BoundarySurface& surface,
                             double tolerance, Solid& solid, Eigen::Matrix3Xd& positions,
                             std::map<VertexId, int>& name) {
  std::size_t compared = 0;
  for (std::size_t i = 0; i < surface.vertex_from_surface.size(); ++i)
    name[surface.vertex_from_surface[i]] = static_cast<int>(i);
  solid = shape.solid;
  positions = shape.positions;
  for (const OpenSubdivLevel& level : expected.levels) {
    const RefinementStep step = refine(solid);
    positions = apply(step.stencils, positions);
    name = fine_names(solid, step, name, level, boundary_faces(solid));
    EXPECT_EQ(name.size(), static_cast<std::size_t>(level.positions.cols()));
    for (const auto& [v, n] : name)
      EXPECT_LE((positions.col(v.value) - level.positions.col(n)).norm(), tolerance) << "vertex " << v.value;
    compared += name.size();
    solid = step.fine;
  }
  return compared;
}

TEST(OpenSubdiv, BoundaryRefinesAndEndsWhereItSays) {
  constexpr int k_level_count = 2;
  std::size_t compared = 0;
  for (const Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const BoundarySurface surface = boundary_surface(shape.solid);
    if (!is_manifold(surface)) continue;
    ++compared;
    const OpenSubdivResult expected = oracle(shape, surface, k_level_count);
    std::map<VertexId, int> name;
    Solid solid;
    Eigen::Matrix3Xd positions;
    compare_boundary(shape, expected, surface, 1e-13, solid, positions, name);
    const Eigen::Matrix3Xd limits = apply(limit_stencils(solid), positions);
    for (const auto& [v, n] : name) {
      std::size_t sharp = 0;
      solid.for_each_edge(v, [&](EdgeId e) { sharp += solid.edge_sharpness(e) > 0 ? 1 : 0; });
      // At a dart OpenSubdiv takes the smooth mask, which is not where its own refinement converges to; our limit
      // there is tested against refinement.
      if (sharp == 1 && solid.vertex_sharpness(v) == 0) continue;
      EXPECT_LE((limits.col(v.value) - expected.limits.col(n)).norm(), 1e-13) << "limit of vertex " << v.value;
    }
  }
  EXPECT_GE(compared, 20U);
}

TEST(OpenSubdiv, SemiSharpBoundaryRefinesAsItSays) {
  std::size_t compared = 0;
  for (const Shape& shape : semi_sharp_shapes()) {
    SCOPED_TRACE(shape.name);
    const BoundarySurface surface = boundary_surface(shape.solid);
    if (!is_manifold(surface)) continue;
    const int level_count = shape.solid.cell_count() <= 12 ? 4 : 2;
    const OpenSubdivResult expected = oracle(shape, surface, level_count);
    std::map<VertexId, int> name;
    Solid solid;
    Eigen::Matrix3Xd positions;
    // OpenSubdiv keeps sharpness in single precision.
    compared += compare_boundary(shape, expected, surface, 1e-6, solid, positions, name);
  }
  EXPECT_GE(compared, 20000U);
}

// Every shape of the catalogue to level 4, with its own infinite creases and corners and with semi-sharp ones. (In
// a program of its own under ctest, and spared under the sanitizers.)
TEST(OpenSubdivSlow, EveryShapeRefinesAsItSaysToLevelFour) {
  std::size_t compared = 0;
  for (const auto& shapes : {catalogue(), semi_sharp_shapes()})
    for (const Shape& shape : shapes) {
      SCOPED_TRACE(shape.name);
      const BoundarySurface surface = boundary_surface(shape.solid);
      if (!is_manifold(surface) || refined_cell_count(shape.solid, 4) > 300000) continue;
      const OpenSubdivResult expected = oracle(shape, surface, 4);
      std::map<VertexId, int> name;
      Solid solid;
      Eigen::Matrix3Xd positions;
      compared += compare_boundary(shape, expected, surface, 1e-6, solid, positions, name);
    }
  std::printf("%zu boundary vertices compared\n", compared);
  EXPECT_GE(compared, 100000U);
}

// Each sheet as an open surface of its own; where sheets cross it has creases.
TEST(OpenSubdiv, SharpSheetsRefineAsSurfacesOfTheirOwn) {
  std::size_t compared = 0;
  for (const SheetShape& shape : sheet_shapes()) {
    SCOPED_TRACE(shape.name);
    Solid sharp_solid = shape.built.solid;
    for (const Sheet& sheet : shape.sheets) sharpen(sharp_solid, sheet.faces, k_infinitely_sharp);
    const Eigen::Matrix3Xd start = jittered(shape.built.positions, 0.2, 4);
    for (const Sheet& sheet : shape.sheets) {
      std::map<VertexId, int> name;
      for (const auto& loop : sheet.loops)
        for (const VertexId v : loop) name.try_emplace(v, static_cast<int>(name.size()));
      Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(name.size()));
      for (const auto& [v, n] : name) points.col(n) = start.col(v.value);
      std::vector<std::vector<int>> loops;
      std::map<std::set<int>, double> creases;
      std::map<int, double> corners;
      for (const auto& loop : sheet.loops) {
        loops.emplace_back();
        for (const VertexId v : loop) loops.back().push_back(name.at(v));
      }
      for (const Sheet& other : shape.sheets) {
        if (other.faces == sheet.faces) continue;
        for (const EdgeId e : sharp_solid.edges()) {
          std::size_t ours = 0, others = 0;
          sharp_solid.for_each_face(e, [&](FaceId f) {
            ours += std::count(sheet.faces.begin(), sheet.faces.end(), f) > 0 ? 1 : 0;
            others += std::count(other.faces.begin(), other.faces.end(), f) > 0 ? 1 : 0;
          });
          const auto& ends = sharp_solid.edge_vertices(e);
          if (ours > 0 && others > 0) creases[{name.at(ends[0]), name.at(ends[1])}] = k_infinitely_sharp;
        }
      }
      // Where a free rim leaves the boundary, neither surface has a rule for the other: a corner.
      if (shape.name == "sheet that ends inside")
        for (const auto& [v, n] : name)
          if (sharp_solid.is_boundary(v) && shape.built.positions(1, v.value) == 2) corners[n] = k_infinitely_sharp;
      const OpenSubdivResult expected = refine_with_opensubdiv(points, loops, creases, corners, 3);
      Solid solid = sharp_solid;
      Eigen::Matrix3Xd positions = start;
      std::vector<FaceId> faces = sheet.faces;
      for (const OpenSubdivLevel& level : expected.levels) {
        const RefinementStep step = refine(solid);
        positions = apply(step.stencils, positions);
        name = fine_names(solid, step, name, level, faces);
        ASSERT_EQ(name.size(), static_cast<std::size_t>(level.positions.cols()));
        for (const auto& [v, n] : name)
          EXPECT_LE((positions.col(v.value) - level.positions.col(n)).norm(), 1e-13) << "vertex " << v.value;
        compared += name.size();
        solid = step.fine;
        faces.clear();  // those whose vertices are all on this sheet
        for (const FaceId f : solid.faces()) {
          const auto loop = solid.face_vertices(f);
          if (solid.face_sharpness(f) > 0 &&
              std::all_of(loop.begin(), loop.end(), [&](VertexId v) { return name.count(v) > 0; }))
            faces.push_back(f);
        }
      }
      // Limits too; at the free rim OpenSubdiv's masks are those of a crease, as ours.
      const Eigen::Matrix3Xd limits = apply(limit_stencils(solid), positions);
      for (const auto& [v, n] : name)
        EXPECT_LE((limits.col(v.value) - expected.limits.col(n)).norm(), 1e-13) << "limit of vertex " << v.value;
    }
  }
  EXPECT_GE(compared, 1000U);
}

TEST(OpenSubdiv, SmoothMaskAtADartIsNotTheLimitOfItsOwnRefinement) {
  std::size_t found = 0;
  for (const Shape& shape : catalogue()) {
    if (shape.name != "fan with a dart") continue;
    ++found;
    const BoundarySurface surface = boundary_surface(shape.solid);
    const VertexId dart{12};
    const auto at =
        static_cast<int>(std::find(surface.vertex_from_surface.begin(), surface.vertex_from_surface.end(), dart) -
                         surface.vertex_from_surface.begin());
    int name = at, name_after_eight = at;
    const OpenSubdivResult one = oracle(shape, surface, 1), eight = oracle(shape, surface, 8);
    name = one.levels[0].fine_from_coarse.at({name});
    for (const OpenSubdivLevel& level : eight.levels)
      name_after_eight = level.fine_from_coarse.at({name_after_eight});
    const Eigen::Vector3d ours = apply(limit_stencils(shape.solid), shape.positions).col(dart.value);
    const Eigen::Vector3d refined = eight.levels.back().positions.col(name_after_eight);
    EXPECT_LE((ours - refined).norm(), 1e-4);  // still converging
    EXPECT_GE((one.limits.col(name) - refined).norm(), 1e-3);
  }
  EXPECT_EQ(found, 1U);
}

}  // namespace
}  // namespace argil::subdiv
