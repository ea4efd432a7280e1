#include "subdiv/edit/sweep.h"

#include <Eigen/Geometry>
#include <numbers>

#include "subdiv/edit/peak.h"
#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "tests/shapes/shapes.h"
#include "tests/subdiv/edit/edited.h"

namespace argil::subdiv {
namespace {

using namespace test;

std::vector<FaceId> faces_at(const Built& built, int axis, double value) {
  std::vector<FaceId> result;
  for (const FaceId f : built.solid.faces()) {
    const auto loop = built.solid.face_vertices(f);
    if (built.solid.is_boundary(f) && std::all_of(loop.begin(), loop.end(), [&](VertexId v) {
          return std::abs(point(built.positions, v)[axis] - value) < 1e-12;
        }))
      result.push_back(f);
  }
  return result;
}
std::vector<FaceId> boundary(const Solid& solid) {
  std::vector<FaceId> result;
  for (const FaceId f : solid.faces())
    if (solid.is_boundary(f)) result.push_back(f);
  return result;
}
Edit grow(Built& built, const std::vector<FaceId>& faces, const Sweep& how) {
  return edited(built.solid, built.positions,
                [&](Transaction& t, const Eigen::Matrix3Xd& rest) { return sweep(t, rest, faces, how); });
}
Eigen::Vector3d middle(const Built& built, const std::vector<FaceId>& faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const FaceId f : faces)
    for (const VertexId v : built.solid.face_vertices(f)) {
      sum += point(built.positions, v);
      ++count;
    }
  return sum / count;
}
Eigen::Vector3d normal(const Built& built, FaceId f) {
  const auto loop = use_vertices(built.solid, built.solid.boundary_use(f));
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    area += point(built.positions, loop[i]).cross(point(built.positions, loop[(i + 1) % loop.size()]));
  return area.normalized();
}

TEST(Sweep, CapsDescendFromTheFacesAndAreGoneOnWith) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  const auto top = faces_at(built, 2, 1);
  const Edit edit = grow(built, top, {.vector = {0, 0, 2}, .steps = 2});
  ASSERT_EQ(edit.faces.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(edit.faces[i].source, top[i]);
    EXPECT_EQ(edit.faces[i].made, edit.next_faces[i]);
  }
  EXPECT_EQ(edit.edges.size(), 7u);
  EXPECT_NEAR(volume(built.solid, built.positions), 6, 1e-14);
}

TEST(Sweep, NormalsKeepTheDistanceToEveryPlane) {
  Built built = box_grid(2, 3, 2, {2, 3, 2});
  grow(built, boundary(built.solid), {.way = Sweep::Way::normals, .distance = 0.25});
  EXPECT_NEAR(volume(built.solid, built.positions), 2.5 * 3.5 * 2.5, 1e-12) << "a box about the box";
  // Not only right angles: every plane of a dodecahedron goes out by the distance.
  Built twelve = build(dodecahedron());
  std::vector<double> heights;
  const auto faces = boundary(twelve.solid);
  for (const FaceId f : faces) heights.push_back(normal(twelve, f).dot(middle(twelve, {f})));
  const Edit edit = grow(twelve, faces, {.way = Sweep::Way::normals, .distance = 0.5, .steps = 2});
  for (std::size_t i = 0; i < faces.size(); ++i)
    EXPECT_NEAR(normal(twelve, edit.next_faces[i]).dot(middle(twelve, {edit.next_faces[i]})), heights[i] + 0.5,
                1e-12);
}

TEST(Sweep, ScaleAndTwistBuildUpOverTheSteps) {
  Built built = box_grid(1, 1, 1, {1, 1, 1});
  const Edit edit = grow(built, faces_at(built, 2, 1),
                         {.vector = {0, 0, 2}, .steps = 2, .scale = 0.5, .twist = std::numbers::pi / 2});
  const Eigen::Vector3d axis(0.5, 0.5, 0);
  for (const PlacedVertex& p : edit.placed) {
    const Eigen::Vector3d from = point(built.positions, p.sources[0].first) - axis;
    const Eigen::Vector3d to = point(built.positions, p.vertex) - axis;
    const bool far = to.z() > 2.5;
    EXPECT_NEAR(to.head<2>().norm(), (far ? 0.5 : 0.75) * from.head<2>().norm(), 1e-14);
    // Right-handed about the way: an eighth of a turn a step.
    const double turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.head<2>().dot(to.head<2>()));
    EXPECT_NEAR(turn, (far ? 2 : 1) * std::numbers::pi / 4, 1e-12);
  }
}

TEST(Sweep, AStraightPathIsAnExtrusion) {
  Built path = box_grid(2, 2, 1, {2, 2, 1}), straight = path;
  grow(path, faces_at(path, 2, 1),
       {.way = Sweep::Way::path, .path = {{1, 1, 2}, {1, 1, 4}}, .steps = 3, .scale = 0.5, .twist = 1});
  grow(straight, faces_at(straight, 2, 1), {.vector = {0, 0, 3}, .steps = 3, .scale = 0.5, .twist = 1});
  EXPECT_LT((path.positions - straight.positions).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Sweep, MitredCornersKeepTheWidthOfTheLegs) {
  Built built = box_grid(1, 1, 1, {1, 1, 1});
  const Edit edit = grow(built, faces_at(built, 2, 1),
                         {.way = Sweep::Way::path, .path = {{0.5, 0.5, 3}, {3.5, 0.5, 3}}, .steps = 2});
  // An L of square section: along its middle line 2 + 3.
  EXPECT_NEAR(volume(built.solid, built.positions), 1 + 5, 1e-12);
  EXPECT_LT((middle(built, edit.next_faces) - Eigen::Vector3d(3.5, 0.5, 3)).norm(), 1e-12);
  EXPECT_LT((normal(built, edit.next_faces[0]) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

TEST(Sweep, ACurveEndsAtItsLastPointAcrossItsDirection) {
  Built built = box_grid(2, 2, 1, {1, 1, 1});
  const Edit edit = grow(
      built, faces_at(built, 2, 1),
      {.way = Sweep::Way::path, .path = {{0.5, 0.5, 3}, {2.5, 0.5, 5}, {5, 0.5, 5}}, .curve = true, .steps = 16});
  EXPECT_LT((middle(built, edit.next_faces) - Eigen::Vector3d(5, 0.5, 5)).norm(), 1e-12);
  for (const FaceId f : edit.next_faces) EXPECT_GT(normal(built, f).x(), 0.95);
  EXPECT_EQ(inverted_cells(built.solid, built.positions).count, 0u);
  // A tube of section 1 has the volume of its length as long as its middle line is the middle of area.
  double length = 0;
  Eigen::Vector3d before(0.5, 0.5, 1);
  for (int step = 1; step <= 16; ++step) {
    Eigen::Vector3d ring = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 9; ++i)
      ring += point(built.positions, edit.placed[static_cast<std::size_t>(step - 1) * 9 + i].vertex) / 9;
    length += (ring - before).norm();
    before = ring;
  }
  EXPECT_NEAR(volume(built.solid, built.positions), 1 + length, 0.01 * length);
}

TEST(Sweep, RefusesPathsThatCannotBeSwept) {
  Built built = box_grid(1, 1, 1, {1, 1, 1});
  const auto top = faces_at(built, 2, 1);
  const auto code = [&](std::vector<Eigen::Vector3d> path, int steps) {
    return fault(built.solid, built.positions, [&](Transaction& t, const auto& rest) {
      return sweep(t, rest, top, {.way = Sweep::Way::path, .path = path, .steps = steps});
    });
  };
  EXPECT_EQ(code({}, 1), ErrorCode::bad_input);
  EXPECT_EQ(code({{0.5, 0.5, 1}, {0.5, 0.5, 2}}, 2), ErrorCode::bad_input) << "begins where it is";
  EXPECT_EQ(code({{0.5, 0.5, 2}, {0.5, 0.5, 2}}, 2), ErrorCode::bad_input);
  EXPECT_EQ(code({{0.5, 0.5, 2}, {0.5, 0.5, 1.5}}, 2), ErrorCode::bad_input) << "straight back";
  EXPECT_EQ(code({{0.5, 0.5, 0.5}}, 1), ErrorCode::bad_input) << "into the solid";
  EXPECT_EQ(code({{0.5, 0.5, 2}, {0.5, 1.5, 2}}, 1), ErrorCode::bad_input) << "more legs than steps";
  EXPECT_EQ(fault(built.solid, built.positions,
                  [&](Transaction& t, const auto& rest) {
                    return sweep(t, rest, boundary(built.solid), {.way = Sweep::Way::path, .path = {{1, 1, 9}}});
                  }),
            ErrorCode::bad_geometry)
      << "all round there is no direction";
}

TEST(Peak, StandsOverTheMiddleOfEachFace) {
  for (Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const auto faces = boundary(shape.solid);
    const std::size_t cells = shape.solid.cell_count();
    const Edit edit = edited(shape.solid, shape.positions,
                             [&](Transaction& t, const auto& rest) { return raise_peaks(t, rest, faces, 0.1); });
    EXPECT_EQ(shape.solid.cell_count(), cells + faces.size());
    EXPECT_EQ(edit.next_vertices.size(), faces.size());
    for (const PlacedVertex& p : edit.placed) EXPECT_NEAR(p.offset.norm(), 0.1, 1e-14);
  }
}

TEST(Peak, RefusesFacesInside) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  for (const FaceId f : built.solid.faces()) {
    if (built.solid.is_boundary(f)) continue;
    EXPECT_EQ(fault(built.solid, built.positions,
                    [&](Transaction& t, const auto& rest) { return raise_peaks(t, rest, std::array{f}, 1); }),
              ErrorCode::bad_topology);
  }
}

}  // namespace
}  // namespace argil::subdiv
