// Springs, material lines and other solutions in pictures.

#include <gmock/gmock.h>

#include "sculpt/picture.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const std::vector<std::string> k_bar{"new box 4 1 1 size 0.4 0.1 0.1",
                                     "set young_modulus 2e4",
                                     "set density 300",
                                     "pin where x < 0.001",
                                     "gravity 0 0 -9.81",
                                     "model mass_spring",
                                     "solve"};

PictureRequest springs() {
  PictureRequest request;
  request.springs = true;
  return request;
}

TEST(Springs, OfEachConfigurationAreDrawnByKindWhereTheyAreNow) {
  struct Wanted {
    const char* model;
    std::size_t faces, inner;
  };
  // 4 cubes in a row: 36 edges, 21 faces.
  for (const Wanted& wanted : {Wanted{"mass_spring", 42, 0}, Wanted{"mass_spring_m2", 0, 16},
                               Wanted{"mass_spring_m3", 42, 16}, Wanted{"mass_spring_published", 0, 16}}) {
    TestSession session(k_bar);
    session.run({std::string("model ") + wanted.model});
    const Scene scene = make_scene(session.document(), springs());
    EXPECT_FALSE(scene.draw_surface);
    EXPECT_TRUE(scene.surface.wire.empty());
    EXPECT_EQ(scene.cage_points.size(), 20U);
    std::size_t faces = 0, inner = 0;
    for (const SceneLines& lines : scene.lines) {
      EXPECT_FALSE(lines.name.empty());
      if (lines.look == LineLook::edge_spring) {
        EXPECT_EQ(lines.lines.size(), 36U);
      }
      if (lines.look == LineLook::face_spring) faces = lines.lines.size();
      if (lines.look == LineLook::inner_spring) inner = lines.lines.size();
    }
    EXPECT_EQ(faces, wanted.faces) << wanted.model;
    EXPECT_EQ(inner, wanted.inner) << wanted.model;
    // The end hangs lower than any point of the body at rest.
    float lowest = 1;
    for (const auto& line : scene.lines[0].lines) lowest = std::min(lowest, line[1].z());
    EXPECT_LT(lowest, -0.01F);
  }
}

TEST(Springs, OfAClippedBodyAreThoseOfItsCells) {
  TestSession session(k_bar);
  session.run({"gravity 0 0 0", "solve"});  // straight, so that the plane meets what it meets at rest
  PictureRequest request = springs();
  request.clip = ClipPlane{{0.15, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(make_scene(session.document(), request).cage_points.size(), 12U);  // of 2 of the 4 cubes
}

TEST(Springs, AreRefusedWhereThereAreNoneAndBesideWhatTheyReplace) {
  TestSession session(k_bar);
  for (const char* line : {"render a.png springs field strain", "render a.png springs frames rotated",
                           "render a.png springs style wireframe"})
    EXPECT_THAT(std::string(session.fault_of(line).what()), HasSubstr("; leave out")) << line;
  session.run({"model corotational"});
  try {
    (void)make_scene(session.document(), springs());
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_THAT(error.what(), HasSubstr("`model mass_spring`"));
  }
}

TEST(MaterialLine, GoesWhereItsPointsAre) {
  TestSession session(k_bar);
  PictureRequest request;
  request.line = {Eigen::Vector3d(0, 0.05, 0.05), Eigen::Vector3d(0.4, 0.05, 0.05)};
  const Scene scene = make_scene(session.document(), request);
  const auto& lines = scene.lines.at(0).lines;
  EXPECT_EQ(lines.size(), 64U);
  EXPECT_NEAR(lines[0][0].z(), 0.05, 1e-6);
  EXPECT_NEAR(lines[63][1].z(), session.measure("position_z at 0.4 0.05 0.05"), 1e-6);
  for (std::size_t i = 1; i < 64; ++i) EXPECT_EQ(lines[i][0], lines[i - 1][1]);
  (*request.line)[1].x() = 0.5;
  EXPECT_THROW((void)make_scene(session.document(), request), Error);
  EXPECT_THAT(std::string(session.fault_of("render a.png line 1 1 1 1 1 1").what()), HasSubstr("same point"));
}

TEST(Underlay, IsTheOtherSolutionUnderTheWiresOfTheSolid) {
  TestSession session(k_bar);
  session.run({"save bent.vtu", "save bent.obj", "save shape.mesh"});
  const double bent = session.measure("displacement at 0.4 0.05 0.05"), tip = session.measure("max_displacement");
  EXPECT_GT(bent, 0.01);
  session.run({"gravity 0 0 0", "solve"});
  PictureRequest request;
  request.field = "displacement";
  request.underlay =
      std::make_shared<const ComparedMesh>(read_compared_mesh(session.folder().path() / "bent.vtu", 1000));
  const Scene scene = make_scene(session.document(), request);
  float largest = 0, lowest = 1;
  for (const float value : scene.surface.values) largest = std::max(largest, value);
  for (const Eigen::Vector3f& at : scene.surface.positions) lowest = std::min(lowest, at.z());
  EXPECT_NEAR(largest, tip, 1e-6);
  EXPECT_LT(lowest, -0.01F);  // the surface is the bent bar,
  EXPECT_TRUE(scene.surface.wire.empty());
  ASSERT_EQ(scene.lines.size(), 1U);  // the wires are those of the straight one
  EXPECT_EQ(scene.lines[0].lines.size(), 36U);
  for (const auto& line : scene.lines[0].lines) EXPECT_GT(line[0].z(), -1e-5F);
  EXPECT_TRUE(scene.draw_surface);
  request.range = {0, 0.2};
  EXPECT_EQ(make_scene(session.document(), request).legend->high, 0.2);
  for (const char* line :
       {"render a.png underlay bent.vtu volume field displacement",
        "render a.png underlay bent.vtu clip 0 0 0 1 0 0", "render a.png underlay bent.vtu frames tangent"})
    EXPECT_THAT(std::string(session.fault_of(line).what()), HasSubstr("leave out")) << line;
  request.field = "strain";
  EXPECT_THROW((void)make_scene(session.document(), request), Error);
  const auto fault = [&](const char* file) {
    request.field = "displacement";
    request.underlay =
        std::make_shared<const ComparedMesh>(read_compared_mesh(session.folder().path() / file, 1000));
    try {
      (void)make_scene(session.document(), request);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(fault("bent.obj"), HasSubstr("a surface alone"));
  EXPECT_THAT(fault("shape.mesh"), HasSubstr("leave out field"));
}

}  // namespace
}  // namespace argil::sculpt
