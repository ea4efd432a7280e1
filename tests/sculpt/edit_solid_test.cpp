// What hangs on a solid follows an edit: positions, fields, pins, sets, the selection; in place on the control
// solid, and back by undo.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/commands/edit.h"
#include "sessions.h"
#include "subdiv/edit/rewrite.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {
namespace {

using namespace subdiv;
using testing::ElementsAre;
using testing::ElementsAreArray;

std::vector<std::uint32_t> set_of(const TestSession& test, const std::string& name) {
  return test.state().sets->at(name).ids;
}

// Raises a pyramid over the boundary face of a cell that a normal points out of, its apex `height` above the
// middle.
Edit raise(Transaction& transaction, FaceId face, double height) {
  const std::vector<VertexId> loop = use_vertices(transaction.solid(), transaction.solid().boundary_use(face));
  Edit edit;
  PlacedVertex apex{transaction.add_vertex()};
  for (const VertexId v : loop) apex.sources.emplace_back(v, 1.0 / static_cast<double>(loop.size()));
  apex.offset.z() = height;
  Rewrite change;
  change.added.push_back({{{loop.rbegin(), loop.rend()}}, CellId{}});
  for (std::size_t i = 0; i < loop.size(); ++i)
    change.added[0].loops.push_back({loop[i], loop[(i + 1) % loop.size()], apex.vertex});
  edit.placed.push_back(apex);
  rewrite(transaction, change, edit);
  return edit;
}

// Grows a hexahedron on a quadrilateral.
Edit grow(Transaction& transaction, FaceId face, double height) {
  const std::vector<VertexId> loop = use_vertices(transaction.solid(), transaction.solid().boundary_use(face));
  Edit edit;
  std::vector<VertexId> top;
  for (const VertexId v : loop) {
    top.push_back(transaction.add_vertex());
    edit.placed.push_back({top.back(), {{v, 1.0}}, {0, 0, height}});
  }
  Rewrite change;
  change.added.push_back({{{loop.rbegin(), loop.rend()}, top}, CellId{}});
  for (std::size_t i = 0; i < 4; ++i)
    change.added[0].loops.push_back({loop[i], loop[(i + 1) % 4], top[(i + 1) % 4], top[i]});
  rewrite(transaction, change, edit);
  return edit;
}

FaceId top_face(const TestSession& test) {
  for (const FaceId f : test.state().solid->faces())
    if (test.state().solid->is_boundary(f)) {
      const auto loop = test.state().solid->face_vertices(f);
      if (std::all_of(loop.begin(), loop.end(),
                      [&](VertexId v) { return (*test.state().rest)(2, v.value) > 0.99; }))
        return f;
    }
  return {};
}

TEST(EditSolid, PlacesNewVerticesAtRestAndAtPresentAndBlendsFields) {
  TestSession test({"new box 1 1 1", "set density 100 + 900*z"});
  edit_solid(test.session(),
             [&](Transaction& t, const Eigen::Matrix3Xd&) { return raise(t, top_face(test), 0.5); });
  ASSERT_EQ(test.state().rest->cols(), 9);
  EXPECT_EQ(test.state().rest->col(8), Eigen::Vector3d(0.5, 0.5, 1.5));
  EXPECT_EQ(test.document().positions().col(8), Eigen::Vector3d(0.5, 0.5, 1.5));
  EXPECT_EQ((*test.state().fields)[FieldName::density][8], 1000);
  EXPECT_EQ(test.state().motion->velocities.cols(), 9);
}

TEST(EditSolid, SharesArraysInPlaceAndUndoTakesTheColumnsBack) {
  TestSession test({"new box 1 1 1"});
  const std::uint64_t before = test.hash();
  const auto* array = test.state().rest.get();
  edit_solid(test.session(),
             [&](Transaction& t, const Eigen::Matrix3Xd&) { return raise(t, top_face(test), 0.5); });
  const std::uint64_t after = test.hash();
  EXPECT_EQ(test.state().rest.get(), array);
  test.run({"undo"});
  EXPECT_EQ(test.hash(), before);
  EXPECT_EQ(test.state().rest->cols(), 8);
  test.run({"redo"});
  EXPECT_EQ(test.hash(), after);
}

TEST(EditSolid, WhatIsDerivedFollowsAnEditThatWasUndoneAndMadeAnew) {
  // Both edits give the same topology in the same arrays: only the columns tell them apart.
  TestSession test({"new box 1 1 1"});
  const auto raised = [&](double height) {
    edit_solid(test.session(),
               [&](Transaction& t, const Eigen::Matrix3Xd&) { return grow(t, top_face(test), height); });
    return test.document().discretization().rest_volume;
  };
  const double low = raised(0.3);
  test.run({"undo"});
  const double high = raised(0.6);
  EXPECT_NEAR(low - 1, 0.3, 1e-12);
  EXPECT_NEAR(high - 1, 0.6, 1e-12);
}

TEST(EditSolid, SetsAndPinsFollowWhatContinuesAMember) {
  TestSession test(
      {"new box 2 1 1 size 2 1 1", "select cells as all", "select vertices as end where x > 1.99", "pin"});
  // The edge at x = 2, y = 0 is cut in its middle: the cell there is made anew with five-sided faces.
  edit_solid(test.session(), [&](Transaction& t, const Eigen::Matrix3Xd&) {
    const Solid& solid = t.solid();
    const VertexId a{2}, b{8};
    const EdgeId edge = *solid.find_edge(a, b);
    const CellId cell = edge_cells(solid, edge).at(0);
    const VertexId middle = t.add_vertex();
    Rewrite change{.removed = {cell}, .cut_edges = {{edge, {middle}}}};
    NewCell made{.loops = {}, .source = cell};
    for (auto loop : cell_loops(solid, cell)) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const VertexId p = loop[i], q = loop[(i + 1) % loop.size()];
        if ((p == a && q == b) || (p == b && q == a)) {
          loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
          break;
        }
      }
      made.loops.push_back(loop);
    }
    change.added.push_back(made);
    Edit edit;
    edit.placed.push_back({middle, {{a, 0.5}, {b, 0.5}}});
    rewrite(t, change, edit);
    return edit;
  });
  EXPECT_THAT(set_of(test, "all"), ElementsAre(0U, 2U));
  EXPECT_THAT(set_of(test, "end"), ElementsAre(2U, 5U, 8U, 11U, 12U));
  EXPECT_THAT(test.state().pins->control_points, ElementsAreArray(set_of(test, "end")));
  EXPECT_EQ(test.state().solid->cell_count(), 2U);
}

TEST(EditSolid, AFailureLeavesEverythingAsItWas) {
  TestSession test({"new box 2 1 1 size 2 1 1", "select cells as all"});
  const std::uint64_t before = test.hash();
  EXPECT_THROW(edit_solid(test.session(),
                          [&](Transaction& t, const Eigen::Matrix3Xd&) {
                            Edit edit = raise(t, top_face(test), 0.5);
                            edit.placed[0].offset.x() = std::nan("");
                            return edit;
                          }),
               Error);
  EXPECT_EQ(test.hash(), before);
  EXPECT_EQ(test.state().rest->cols(), 12);
}

}  // namespace
}  // namespace argil::sculpt
