#include "sculpt/field_transfer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sessions.h"

namespace argil::sculpt {
namespace {

const Eigen::VectorXd& field(const TestSession& session, FieldName name) {
  return (*session.state().fields)[name];
}
Eigen::Matrix3Xd rest_nodes(TestSession& session) {
  return subdiv::apply(session.document().refinement().stencils.back(), session.document().rest());
}

TEST(FieldTransfer, ConstantsRiseExactly) {
  for (const char* shape : {"new box 2 3 2", "new wedge", "new pyramid", "new tetrahedron"}) {
    TestSession session(
        {shape, "peak 0.3 where z < 0.01", "set young_modulus 12345.6789", "set poisson_ratio 0.499", "levels 2"});
    const auto nodes = static_cast<Eigen::Index>(session.document().refinement().solid().vertex_count());
    EXPECT_EQ(field(session, FieldName::young_modulus), Eigen::VectorXd::Constant(nodes, 12345.6789)) << shape;
    EXPECT_EQ(field(session, FieldName::poisson_ratio), Eigen::VectorXd::Constant(nodes, 0.499)) << shape;
  }
}

TEST(FieldTransfer, LinearFieldsRiseLinearlyAlsoWithTheSharpBoundaryOfABox) {
  TestSession session({"new box 4 3 3 size 0.4 0.3 0.3", "select edges angle 30", "sharpen",
                       "select vertices where valence = 3", "sharpen", "set density 500 + 1000*x - 200*y",
                       "levels 2"});
  const Eigen::Matrix3Xd nodes = rest_nodes(session);
  const Eigen::VectorXd expected = 500 + 1000 * nodes.row(0).array() - 200 * nodes.row(1).array();
  // The same stencils refine the field and the positions: only rounding is between them.
  EXPECT_LT((field(session, FieldName::density) - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(FieldTransfer, RisingKeepsToTheRangeOfTheValues) {
  TestSession session({"new box 3 3 2 size 3 3 2", "peak 0.5 where z > 1.9 and x < 1", "set young_modulus 1e-3",
                       "set young_modulus 1e9 where x > 1.5", "set mask 1 where y < 1.5", "levels 2"});
  const Eigen::VectorXd& e = field(session, FieldName::young_modulus);
  EXPECT_GE(e.minCoeff(), 1e-3);
  EXPECT_LE(e.maxCoeff(), 1e9);
  const Eigen::VectorXd& mask = field(session, FieldName::mask);
  EXPECT_GE(mask.minCoeff(), 0);
  EXPECT_LE(mask.maxCoeff(), 1);
  EXPECT_GT(mask.maxCoeff(), 0.9);
}

TEST(FieldTransfer, FallingRestrictsAndWhatFellStaysAfterwards) {
  TestSession session({"new box 2 2 2", "levels 2", "set density 100 + 10*x + 20*y*y + 30*z^3"});
  const Eigen::Matrix3Xd fine = rest_nodes(session);
  const Eigen::VectorXd fine_values = field(session, FieldName::density);
  session.run({"levels 0"});
  const Eigen::VectorXd coarse = field(session, FieldName::density);
  ASSERT_EQ(coarse.size(), 27);
  // Each control vertex takes the value of the node that it became: the first ones.
  EXPECT_EQ(coarse, fine_values.head(27));
  // Rising is a smoothing: the range only shrinks, however often it is repeated.
  double low = fine_values.minCoeff(), high = fine_values.maxCoeff();
  for (int round = 0; round < 5; ++round) {
    session.run({"levels 2", "levels 0"});
    const Eigen::VectorXd& now = field(session, FieldName::density);
    EXPECT_GE(now.minCoeff(), low);
    EXPECT_LE(now.maxCoeff(), high);
    low = now.minCoeff();
    high = now.maxCoeff();
  }
}

TEST(FieldTransfer, AnEditKeepsTheValuesOfWhatStayed) {
  TestSession session({"new box 3 2 2 size 3 2 2", "levels 2", "set density 100 + 13*x + 29*y + 57*z"});
  const Eigen::VectorXd before = field(session, FieldName::density);
  const subdiv::Refinement from = session.document().refinement();
  session.run({"extrude 1 where x > 2.9"});
  const subdiv::Refinement& to = session.document().refinement();
  const Eigen::VectorXd& after = field(session, FieldName::density);
  const auto map = nodes_after_edit(from, to);
  // Nothing was taken away, so every node is still there, and each has its value, though smooth ends moved.
  std::vector<std::uint32_t> reached = map;
  std::sort(reached.begin(), reached.end());
  EXPECT_EQ(std::adjacent_find(reached.begin(), reached.end()), reached.end());
  for (std::size_t v = 0; v < map.size(); ++v) {
    ASSERT_NE(map[v], k_no_node);
    ASSERT_EQ(after[map[v]], before[static_cast<Eigen::Index>(v)]);
  }
  // What grew inherits: within the range of the face that it grew from.
  const Eigen::Matrix3Xd nodes = rest_nodes(session);
  EXPECT_GT(after.size(), before.size());
  EXPECT_GE(after.minCoeff(), before.minCoeff());
  EXPECT_LE(after.maxCoeff(), before.maxCoeff());
  for (Eigen::Index v = 0; v < after.size(); ++v)
    if (nodes(0, v) > 3.4) {
      EXPECT_GT(after[v], 100 + 13 * 2.0);
    }
  // Taken away again, the rest has what it had.
  session.run({"remove where x > 3"});
  EXPECT_EQ(field(session, FieldName::density), before);
}

TEST(FieldTransfer, NodesInsideWhatStayedKeepTheirPlaceThroughARemoval) {
  TestSession session({"new box 4 2 2 size 4 2 2", "levels 1"});
  const subdiv::Refinement from = session.document().refinement();
  const Eigen::Matrix3Xd before = rest_nodes(session);
  session.run({"remove where x > 3"});
  const auto map = nodes_after_edit(from, session.document().refinement());
  const Eigen::Matrix3Xd after = rest_nodes(session);
  std::size_t kept = 0;
  for (std::size_t v = 0; v < map.size(); ++v) {
    if (map[v] == k_no_node) {
      EXPECT_GT(before(0, static_cast<Eigen::Index>(v)), 3.0);
      continue;
    }
    ++kept;
    // Far from the cut the refined nodes stand where they stood.
    if (before(0, static_cast<Eigen::Index>(v)) < 1.9) {
      EXPECT_LT((after.col(map[v]) - before.col(static_cast<Eigen::Index>(v))).norm(), 1e-14);
    }
  }
  EXPECT_EQ(kept, session.document().refinement().solid().vertex_count());
}

TEST(FieldTransfer, SoftPinsAndSelectedNodesFollow) {
  TestSession session({"new box 3 2 2 size 3 2 2", "levels 2", "select nodes as side where x < 0.2 and y < 0.6",
                       "pin stiffness 30"});
  const auto places = [&] {
    const Eigen::Matrix3Xd nodes = rest_nodes(session);
    std::vector<Eigen::Vector3d> at;
    for (const SoftPin& pin : session.state().pins->nodes) at.emplace_back(nodes.col(pin.node));
    return at;
  };
  const std::vector<Eigen::Vector3d> first = places();
  const std::vector<SoftPin> pins = session.state().pins->nodes;
  ASSERT_GT(first.size(), 3U);
  session.run({"remove where x > 2", "extrude 0.5 where x > 1.9"});
  const std::vector<Eigen::Vector3d> second = places();
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    // The order of nodes may change: each has its target, which is where it was when it was pinned.
    EXPECT_EQ(session.state().pins->nodes[i].stiffness, 30);
    const auto old = std::find_if(pins.begin(), pins.end(), [&](const SoftPin& p) {
      return p.target == session.state().pins->nodes[i].target;
    });
    ASSERT_NE(old, pins.end());
    EXPECT_LT((second[i] - first[static_cast<std::size_t>(old - pins.begin())]).norm(), 1e-14);
  }
  EXPECT_EQ(session.state().sets->at("side").ids.size(), first.size());
  EXPECT_EQ(session.state().selection->type, ElementType::faces);  // the caps of the extrusion
}

TEST(FieldTransfer, LevelsCarryNodesOrFreeThem) {
  TestSession session(
      {"new box 2 2 2", "levels 1", "select nodes as corner where x < 0.2 and y < 0.2 and z < 0.2"});
  const std::size_t count = session.state().selection->ids.size();
  session.run({"pin stiffness 5", "levels 2"});
  ASSERT_EQ(session.state().pins->nodes.size(), count);
  for (const SoftPin& pin : session.state().pins->nodes)
    EXPECT_LT(rest_nodes(session).col(pin.node).maxCoeff(), 0.3);
  EXPECT_EQ(session.state().selection->ids.size(), count);
  session.run({"levels 0"});
  // Only the control vertex itself is left of them.
  ASSERT_EQ(session.state().pins->nodes.size(), 1U);
  EXPECT_EQ(session.state().pins->nodes[0].node, 0U);
  EXPECT_EQ(session.state().sets->at("corner").ids, std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace argil::sculpt
