// The mask protects from every tool: what is touched is weaker by 1 − mask, and what force there is is still the
// device's in all.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fem/measure/energy.h"
#include "sculpt/control_elements.h"
#include "sculpt/force_tools/force_tool.h"
#include "sculpt/force_tools/touched.h"
#include "sculpt/picture.h"
#include "sculpt/stroke.h"
#include "tests/sculpt/force_tools/held_block.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

std::string what(TestSession& session, const std::string& line) {
  return session.fault_of(line).what();
}

const Eigen::VectorXd& mask(const TestSession& session) {
  return (*session.state().fields)[FieldName::mask];
}

constexpr const char* k_force_tools[] = {"pull", "grab", "inflate", "twist", "pinch", "smooth"};

TEST(Mask, AnEvenMaskMakesEveryToolWeakerByWhatItHides) {
  // Inside the solid as well, and where fields are trilinear over tricubic elements.
  for (const char* space : {"default", "cubic"})
    for (const char* name : k_force_tools)
      for (const double height : {0.2, 0.1}) {
        TestSession free(held_block(space)), masked(held_block(space));
        masked.run({"set mask 0.75"});
        const Eigen::Vector3d at(0.15, 0.15, height);
        const GripOptions options{.inside = height < 0.2};
        StrokePose moved{at + Eigen::Vector3d(0.01, 0.004, 0.02)};
        const auto whole = take_hold(free.document(), tool_of(name), {at}, options);
        const auto less = take_hold(masked.document(), tool_of(name), {at}, options);
        Eigen::Matrix3Xd bent = free.document().positions();
        for (Eigen::Index i = 0; i < bent.cols(); ++i)
          bent(2, i) += 0.02 * std::sin(9 * bent(0, i) + 5 * bent(1, i));
        const auto force_of = [&](ForceTool& tool) {
          const fem::Loads loads = tool.loads(moved, bent);
          Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, bent.cols());
          if (loads.forces.cols() > 0) forces = loads.forces;
          fem::add_spring_forces(loads.springs, bent, forces);
          return forces;
        };
        const Eigen::Matrix3Xd all = force_of(*whole), quarter = force_of(*less);
        ASSERT_GT(all.cwiseAbs().maxCoeff(), 1e-6) << name;
        // Only rounding of the weights stands between the two.
        EXPECT_LT((quarter - 0.25 * all).cwiseAbs().maxCoeff(), 1e-9 * all.cwiseAbs().maxCoeff())
            << name << ' ' << space << ' ' << height;
      }
}

TEST(Mask, NetForceIsStillTheDevices) {
  TestSession session(held_block());
  session.run({"set mask x / 0.3"});
  for (const char* name : {"pull", "grab"}) {
    const auto tool = take_hold(session.document(), tool_of(name), {{0.15, 0.15, 0.2}}, {});
    const StrokePose moved{{0.16, 0.13, 0.25}};
    const Eigen::Matrix3Xd& now = session.document().positions();
    const Eigen::Vector3d net = tool->wrench(moved, now).force;
    EXPECT_GT(net.norm(), 0.1);
    EXPECT_LT((net + tool->felt(moved, now).force).norm(), 1e-10 * net.norm()) << name;
  }
}

TEST(Mask, ToolsWithoutANetForceHaveNoneUnderAnUnevenMask) {
  TestSession session(held_block());
  session.run({"set mask min(1, x / 0.3 + y)"});
  Eigen::Matrix3Xd bent = session.document().positions();
  for (Eigen::Index i = 0; i < bent.cols(); ++i) bent(2, i) += 0.02 * std::sin(9 * bent(0, i) + 5 * bent(1, i));
  for (const char* name : {"twist", "pinch", "smooth"}) {
    const auto tool = take_hold(session.document(), tool_of(name), {{0.15, 0.15, 0.2}}, {});
    const StrokePose moved{{0.17, 0.14, 0.22}};
    const fem::Loads loads = tool->loads(moved, bent);
    Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, bent.cols());
    if (loads.forces.cols() > 0) forces = loads.forces;
    fem::add_spring_forces(loads.springs, bent, forces);
    EXPECT_GT(forces.norm(), 1e-6) << name;
    EXPECT_LT(forces.rowwise().sum().norm(), 1e-10 * forces.norm()) << name;
  }
}

TEST(Mask, WhatIsMaskedIsNotTouched) {
  TestSession session(held_block());
  session.run({"set mask 1 where x < 0.15"});
  const Touched held = touch(session.document(), tool_of("grab"), {0.15, 0.15, 0.2}, false);
  EXPECT_GT(held.share, 0.2);
  EXPECT_LT(held.share, 0.9);
  double sum = 0;
  for (Eigen::Index i = 0; i < held.weights.size(); ++i) {
    sum += held.weights[i];
    // Between the last masked node and the first free one the mask falls off over one cell of 0.05 m.
    EXPECT_GT(held.positions(0, i), 0.07);
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(Mask, WhatIsMaskedWhollyIsRefusedAndTheProbeFeelsIt) {
  TestSession session(held_block());
  session.run({"set mask 1"});
  const std::uint64_t before = session.hash();
  for (const char* tool : {"pull", "grab", "inflate", "twist", "pinch", "smooth", "paint_stiffness", "pin_brush"}) {
    session.run({fmt::format("tool {} radius 0.09", tool)});
    EXPECT_THAT(what(session, "stroke path 0 0.15 0.15 0.2 20 0.15 0.15 0.25"), HasSubstr("masked")) << tool;
    session.run({"undo"});
    EXPECT_EQ(session.hash(), before) << tool;
  }
  EXPECT_THAT(what(session, "curve through 0.1 0.15 0.2 0.2 0.15 0.2 handle 1 to 0.1 0.15 0.25"),
              HasSubstr("masked"));
  session.run({"tool probe radius 0.09", "stroke path 0 0.15 0.15 0.2 40 0.15 0.15 0.2"});
  EXPECT_GT(session.measure("felt_stiffness at 0.15 0.15 0.2"), 0);
}

TEST(Mask, TheBrushPaintsItAndInvertedTakesItAway) {
  TestSession session(held_block());
  session.run({"tool paint_mask radius 0.08 falloff constant", "stroke path 0 0.15 0.15 0.2"});
  const Eigen::Matrix3Xd nodes =
      subdiv::apply(session.document().refinement().stencils.back(), session.document().positions());
  for (Eigen::Index i = 0; i < nodes.cols(); ++i)
    EXPECT_EQ(mask(session)[i], (nodes.col(i) - Eigen::Vector3d(0.15, 0.15, 0.2)).norm() < 0.08 ? 1 : 0);
  // Where it is masked it can be painted all the same.
  session.run({"tool paint_mask value 0.5", "stroke path 0 0.15 0.15 0.2"});
  EXPECT_EQ(mask(session).maxCoeff(), 0.5);
  session.run({"stroke path 0 0.15 0.15 0.2 invert"});
  EXPECT_EQ(mask(session).maxCoeff(), 0);
}

TEST(Mask, APullPaintedAroundIsTheSameBitsLiveAndReplayed) {
  TestSession live(held_block()), replayed(held_block());
  std::vector<std::string> lines{"tool paint_mask radius 0.1", "stroke path 0 0.1 0.15 0.2 30 0.1 0.25 0.2",
                                 "tool pull radius 0.1 strength 300"};
  live.run(lines);
  Stroke stroke(live.session(), {{0.15, 0.15, 0.2}});
  for (int tick = 1; tick <= 90; ++tick) stroke.tick({{0.15, 0.15, 0.2 + 0.001 * tick}});
  lines.push_back(stroke.finish());
  replayed.run(lines);
  EXPECT_EQ(live.hash(), replayed.hash());
  live.run({"undo 2", "redo 2"});
  EXPECT_EQ(live.hash(), replayed.hash());
}

TEST(Mask, CommandsClearInvertAndTakeTheSelection) {
  TestSession session(held_block());
  session.run({"select faces where z > 0.19 and x < 0.1 and y < 0.1", "mask selected"});
  // One face of nine on top, refined once: three nodes by three.
  EXPECT_EQ(mask(session).sum(), 9);
  const std::uint64_t hash = session.hash();
  session.run({"mask invert"});
  EXPECT_EQ(mask(session).sum(), static_cast<double>(mask(session).size()) - 9);
  session.run({"undo"});
  EXPECT_EQ(session.hash(), hash);
  session.run({"mask unselected value 0.5", "mask selected value 0"});
  EXPECT_EQ(mask(session).maxCoeff(), 0.5);
  session.run({"mask clear"});
  EXPECT_EQ(mask(session).maxCoeff(), 0);
  session.run({"select cells where x < 0.1 and y < 0.1 and z < 0.1", "mask selected"});
  EXPECT_EQ(mask(session).sum(), 27);
  session.run({"mask clear", "select edges where x < 0.01 and y < 0.01 and z < 0.1", "mask selected"});
  EXPECT_EQ(mask(session).sum(), 3);
  session.run({"mask clear", "select vertices where x < 0.01 and y < 0.01 and z < 0.01", "mask selected"});
  EXPECT_EQ(mask(session).sum(), 1);
  session.run({"select faces none"});
  EXPECT_THAT(what(session, "mask selected"), HasSubstr("nothing is selected"));
  EXPECT_THAT(what(session, "mask clear value 0.5"), HasSubstr("leave it out"));
}

TEST(Mask, AfterAnEditWithPyramidsElementsStillKnowTheirControlElements) {
  // Split cells beside whole ones: refinement there makes faces of other than four corners.
  for (const char* level : {"levels 1", "levels 2"}) {
    TestSession session({"new box 2 2 2", "split where x > 0.5 and y > 0.5 and z > 0.5", level});
    const subdiv::Refinement& refinement = session.document().refinement();
    const ControlElements on = control_elements(refinement);
    const subdiv::Solid& fine = refinement.solid();
    const Eigen::Matrix3Xd nodes = subdiv::apply(refinement.stencils.back(), session.document().positions());
    // A face that lies on a control face lies on a cell of it; what lies on the boundary, on a boundary face.
    for (const subdiv::FaceId f : fine.faces()) {
      if (fine.is_boundary(f)) {
        ASSERT_TRUE(on.face[f].valid());
        EXPECT_TRUE(session.document().solid().is_boundary(on.face[f]));
      }
      if (!on.face[f].valid()) continue;
      const auto owner = fine.owner(fine.boundary_use(f));
      if (!fine.is_boundary(f)) continue;
      EXPECT_EQ(on.cell[owner],
                session.document().solid().owner(session.document().solid().boundary_use(on.face[f])));
    }
    // The ends of an edge that lies on a control edge lie on it too, or at its ends.
    for (const subdiv::EdgeId e : fine.edges()) {
      if (!on.edge[e].valid()) continue;
      for (const subdiv::VertexId v : fine.edge_vertices(e))
        if (on.vertex[v].valid()) {
          const auto& ends = session.document().solid().edge_vertices(on.edge[e]);
          EXPECT_TRUE(ends[0] == on.vertex[v] || ends[1] == on.vertex[v]);
        }
    }
  }
}

TEST(Select, ByNumbersAndAmongTheSelected) {
  TestSession session({"new box 2 2 1"});
  session.run({"select faces where z > 0.9"});
  const std::vector<std::uint32_t> top = session.state().selection->ids;
  session.run({"select faces none", fmt::format("select faces ids {} {} {}", top[2], top[0], top[2])});
  EXPECT_EQ(session.state().selection->ids, (std::vector<std::uint32_t>{top[0], top[2]}));
  session.run({fmt::format("select faces ids {} add", top[1]), "select faces selected as some"});
  EXPECT_EQ(session.state().sets->at("some").ids.size(), 3U);
  session.run({fmt::format("select faces ids {} remove", top[0])});
  EXPECT_EQ(session.state().selection->ids.size(), 2U);
  EXPECT_THAT(what(session, "select faces ids 9999"), HasSubstr("no faces with the number 9999"));
  EXPECT_THAT(what(session, "select edges selected"), HasSubstr("are faces, not edges"));
}

TEST(Peel, TakesCellsAwayByTheirDepth) {
  TestSession session({"new box 5 5 5"});
  const auto depth = cell_depths(session.document().solid());
  std::array<int, 3> count{};
  for (const subdiv::CellId c : session.document().solid().cells()) ++count.at(depth[c]);
  EXPECT_EQ(count, (std::array<int, 3>{125 - 27, 26, 1}));
  PictureRequest request;
  request.peel = 1;
  const Scene scene = make_scene(session.document(), request);
  EXPECT_EQ(scene.surface.cell_from_face.size(), 54U);
  for (const std::uint8_t cut : scene.surface.cut_faces) EXPECT_EQ(cut, 1);
  request.clip = ClipPlane{{0.5, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(make_scene(session.document(), request).surface.cell_from_face.size(), 2 * 9 + 4 * 6U);
  request.peel = 3;
  EXPECT_THROW((void)make_scene(session.document(), request), Error);
}

}  // namespace
}  // namespace argil::sculpt
