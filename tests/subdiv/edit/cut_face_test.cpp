#include "subdiv/edit/cut_face.h"

#include "subdiv/primitives.h"
#include "subdiv/radial_edge.h"
#include "tests/subdiv/edit/edited.h"

namespace argil::subdiv {
namespace {

using namespace test;

FaceId inner_face(const Solid& solid) {
  for (const FaceId f : solid.faces())
    if (!solid.is_boundary(f)) return f;
  return FaceId{};
}

TEST(CutFace, BothCellsGetTheHalves) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  const FaceId wall = inner_face(built.solid);
  const VertexId a = built.solid.face_vertices(wall)[0], c = built.solid.face_vertices(wall)[2];
  {
    Transaction t(built.solid);
    t.set_sharpness(wall, 4);
    (void)t.commit();
  }
  EXPECT_EQ(face_between(built.solid, a, c), wall);
  const Edit edit =
      edited(built.solid, built.positions, [&](Transaction& t, const auto&) { return cut_face(t, wall, a, c); });
  EXPECT_EQ(built.solid.cell_count(), 2u);
  EXPECT_EQ(built.solid.vertex_count(), 12u);
  for (const CellId cell : built.solid.cells()) EXPECT_EQ(built.solid.cell_face_uses(cell).size(), 7u);
  ASSERT_EQ(edit.next_edges.size(), 1u);
  EXPECT_EQ(edit.next_edges[0], *built.solid.find_edge(a, c));
  EXPECT_FALSE(built.solid.is_live(wall));
  for (const auto& [made, source] : edit.faces) {
    EXPECT_EQ(source, wall);
    EXPECT_EQ(built.solid.face_vertices(made).size(), 3u);
    EXPECT_EQ(built.solid.face_sharpness(made), 4);
  }
  EXPECT_EQ(edit.faces.size(), 2u);
}

TEST(CutFace, RefusesWhatIsNoCutOfTheFace) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  const FaceId wall = inner_face(built.solid);
  const auto loop = built.solid.face_vertices(wall);
  const VertexId a = loop[0], b = loop[1], c = loop[2];
  VertexId off;
  for (const VertexId v : built.solid.vertices())
    if (!std::count(loop.begin(), loop.end(), v)) off = v;
  const auto code = [&](FaceId f, VertexId from, VertexId to) {
    return fault(built.solid, built.positions,
                 [&](Transaction& t, const auto&) { return cut_face(t, f, from, to); });
  };
  EXPECT_EQ(code(wall, a, b), ErrorCode::bad_input) << "neighbours";
  EXPECT_EQ(code(wall, a, a), ErrorCode::bad_input);
  EXPECT_EQ(code(wall, a, off), ErrorCode::bad_input);
  EXPECT_EQ(code(wall, a, VertexId{99u}), ErrorCode::not_found);
  EXPECT_EQ(code(FaceId{99u}, a, c), ErrorCode::not_found);
  EXPECT_THROW((void)face_between(built.solid, a, b), Error) << "two boundary faces";
}

}  // namespace
}  // namespace argil::subdiv
