#include "sculpt/force_tools/probe.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sculpt/force_tools/touched.h"
#include "sculpt/stroke.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

std::vector<std::string> cushion() {
  return {"new box 6 6 3 size 0.3 0.3 0.15", "levels 1", "pin where z < 0.01", "tool probe radius 0.03"};
}

class ProbeIn : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Spaces, ProbeIn, testing::Values("default", "cubic"));

TEST_P(ProbeIn, ReadsTheStaticAnswer) {
  TestSession session({"new box 4 4 2 size 0.3 0.3 0.15", "levels 1", "pin where z < 0.01",
                       "tool probe radius 0.03", std::string("space ") + GetParam(),
                       "paint young_modulus scale 5 where x < 0.1"});
  Document& document = session.document();
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(0.15, 0.15, 0.14), Eigen::Vector3d(0.08, 0.2, 0.14), Eigen::Vector3d(0.15, 0.15, 0.07)}) {
    const ProbeReading reading = Probe(document).read(document.state().tool, at);
    // The static solver under a force so small that the body answers linearly.
    const Touched touched = touch(document, document.state().tool, at, false);
    const fem::PointStencil middle = middle_of(touched);
    const double force = 1e-4;
    fem::Loads loads = document.loads();
    loads.forces +=
        fem::point_forces(middle, static_cast<std::size_t>(loads.forces.cols()), force * touched.normal);
    fem::BodyState body = *document.state().motion;
    fem::StepOptions options;
    options.linear_tolerance = 1e-9;
    static_cast<void>(document.integrator().solve_static(loads, body, options));
    const double way = touched.normal.dot(fem::position(middle, body.positions) - touched.middle);
    EXPECT_NEAR(reading.stiffness, force / way, 1e-3 * reading.stiffness);
    EXPECT_LT((reading.at - touched.middle).norm(), 1e-15);
  }
}

TEST(Probe, FindsANoduleUnderTheSkin) {
  TestSession session(cushion());
  // Ten times as stiff, of 6 cm, 2 cm under the skin.
  session.run({"paint young_modulus scale 10 at 0.1 0.15 0.085 radius 0.045 falloff constant"});
  const auto read = [&](double x, double y) {
    session.run({fmt::format("stroke path 0 {0} {1} 0.14 20 {0} {1} 0.139", x, y)});
    return session->measures().back().value;
  };
  const double over = read(0.1, 0.15);
  EXPECT_GE(over, 1.5 * read(0.21, 0.15));
  EXPECT_GE(over, 1.5 * read(0.2, 0.22));
}

TEST(Probe, ChangesNothing) {
  TestSession session(cushion());
  session.run({"gravity 0 0 -10", "step 5"});
  const std::uint64_t before = session.hash();
  const std::size_t depth = session->undo_depth(), steps = session->steps().size();
  const Eigen::Matrix3Xd rest = session.document().rest(), positions = session.document().positions();
  session.run({"stroke from 0.15 0.15 0.13 to 0.2 0.2 0.12 ticks 200"});
  EXPECT_EQ(session.hash(), before);
  EXPECT_EQ(session->undo_depth(), depth);
  EXPECT_EQ(session->steps().size(), steps);
  EXPECT_EQ(session->measures().size(), 1U);
  EXPECT_EQ(session->measures().back().name, "felt_stiffness");
  EXPECT_GT(session->measures().back().value, 0);
  EXPECT_EQ(session.document().rest(), rest);
  EXPECT_EQ(session.document().positions(), positions);
}

TEST(Probe, IsAMeasureAtAMaterialPoint) {
  TestSession session(cushion());
  const double here = session.measure("felt_stiffness at 0.15 0.15 0.14");
  const Eigen::Vector3d at(0.15, 0.15, 0.14);
  EXPECT_NEAR(here, Probe(session.document()).read(session.state().tool, at).stiffness, 1e-6 * here);
  session.run({"set young_modulus 3e5"});
  EXPECT_NEAR(session.measure("felt_stiffness at 0.15 0.15 0.14"), 3 * here, 1e-3 * here);
}

TEST(Probe, IsFeltAsAWall) {
  TestSession session(cushion());
  Stroke stroke(session.session(), {{0.15, 0.15, 0.14}});
  ASSERT_TRUE(stroke.reading().has_value());
  const ContactModel model = stroke.felt(100);
  const Eigen::Vector3d normal = stroke.reading()->normal, skin = stroke.reading()->at;
  EXPECT_LT(contact_force(model, skin + 0.01 * normal).norm(), 1e-12);
  EXPECT_LT((contact_force(model, skin - 0.01 * normal) - 0.01 * stroke.reading()->stiffness * normal).norm(),
            1e-9 * stroke.reading()->stiffness);
  const std::string line = stroke.finish();
  EXPECT_EQ(line, "stroke path 0 0.15 0.15 0.14");
}

TEST(Probe, AFreeBodyIsBalancedByItsInertia) {
  // Only deformation is read, so that the mass does not matter.
  const std::vector<std::string> bar{"new box 8 2 2 size 0.8 0.2 0.2", "levels 1", "tool probe radius 0.08"};
  const auto read = [&](const std::string& extra) {
    TestSession session(bar);
    if (!extra.empty()) session.run({extra});
    return Probe(session.document()).read(session.state().tool, {0.4, 0.1, 0.19}).stiffness;
  };
  const double free = read("");
  EXPECT_GT(free, 0);
  // The inertia that keeps a hinge from being infinitely soft adds 1e-4 of the stiffness at most.
  EXPECT_NEAR(read("set young_modulus 2e5") / free, 2, 2e-3);
  EXPECT_NEAR(read("set density 4000") / free, 1, 1e-3);
}

}  // namespace
}  // namespace argil::sculpt
