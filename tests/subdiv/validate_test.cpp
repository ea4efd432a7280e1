#include "subdiv/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/primitives.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {

// Breaks invariants that no public function can break.
struct SolidTester {
  static void drop_owner(Solid& s) { s.faces_[0].owners = {}; }
  static void move_corner(Solid& s) { s.corner_vertex_[1] = VertexId{7u}; }
  static void kill_edge(Solid& s) {
    s.edges_[0].live = false;
    --s.edge_count_;
  }
  static void kill_vertex(Solid& s) {
    s.vertex_live_[0] = 0;
    --s.vertex_count_;
  }
  static void miscount(Solid& s) { ++s.face_count_; }
  static void cut_list(Solid& s) { s.corner_next_[s.edges_[0].first_corner] = 0xffffffffU; }
  static void loop_list(Solid& s) { s.corner_next_[s.edges_[0].last_corner] = s.edges_[0].first_corner; }
  static void lose_link(Solid& s) { s.vertex_lists_[0].first = s.edge_link_next_[s.vertex_lists_[0].first]; }
  static void leave_range(Solid& s) { s.cell_faces_[0] = FaceUseId{1000u}; }
  static void shorten(Solid& s) { s.corner_edge_.pop_back(); }
  static void turn_use(Solid& s) {
    const FaceUseId use = s.cell_faces_[0];
    s.cell_faces_[0] = other_side(use);
    std::swap(s.faces_[use.index() / 2].owners[0], s.faces_[use.index() / 2].owners[1]);
  }
  static void falsify_hash(Solid& s) {
    (void)s.topology_hash();
    s.edges_[0].sharpness = 10;
  }
  static void spoil_sharpness(Solid& s) { s.vertex_sharpness_[0] = -1; }
};

namespace {

struct Breakage {
  void (*apply)(Solid&);
  const char* message;
};

TEST(Validate, NamesEachBrokenInvariant) {
  for (const auto& [apply, message] : {Breakage{SolidTester::drop_owner, "whose owner is another"},
                                       {SolidTester::move_corner, "does not join its corners"},
                                       {SolidTester::kill_edge, "dead edge 0"},
                                       {SolidTester::kill_vertex, "ends in dead vertex 0"},
                                       {SolidTester::miscount, "faces live, the count says"},
                                       {SolidTester::cut_list, "the list of edge 0"},
                                       {SolidTester::loop_list, "the list of edge 0 does not ascend"},
                                       {SolidTester::lose_link, "the list of vertex 0"},
                                       {SolidTester::leave_range, "a cell names face-use 1000"},
                                       {SolidTester::shorten, "corner_edge has"},
                                       {SolidTester::turn_use, "(incoherent orientation)"},
                                       {SolidTester::falsify_hash, "topology hash"},
                                       {SolidTester::spoil_sharpness, "vertex 0 has sharpness -1"}}) {
    Solid solid = box_grid(1, 1, 1, {1, 1, 1}).solid;
    ASSERT_THAT(validate(solid), testing::IsEmpty());
    apply(solid);
    EXPECT_THAT(validate(solid), testing::Contains(testing::HasSubstr(message)));
  }
}

TEST(Validate, ManyFaultsAreCutOff) {
  Builder builder;
  for (int i = 0; i < 1000; ++i) {
    const VertexId v = builder.add_vertex();
    builder.set_sharpness(v, -1);
  }
  EXPECT_EQ(validate(builder.finish()).size(), 100u);
}

}  // namespace
}  // namespace argil::subdiv
