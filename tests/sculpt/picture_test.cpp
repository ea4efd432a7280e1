// What `render` shows beside the surface: finer shapes, cells by themselves, curves, and what the hand feels.

#include "sculpt/picture.h"

#include <gmock/gmock.h>

#include <map>

#include "sculpt/cell_picture.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

/// Keeps what it is asked for, and answers with a grey picture.
class GreyRenderer final : public Renderer {
 public:
  Picture render(const Scene& scene, const PictureOptions& options) override {
    last_scene = scene;
    last_options = options;
    Picture picture{options.width, options.height, {}, {}};
    picture.rgba.assign(4 * static_cast<std::size_t>(options.width * options.height), 99);
    return picture;
  }
  Scene last_scene;
  PictureOptions last_options;
};

const std::vector<std::string> k_slab{"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "set young_modulus 5e4",
                                      "pin where z < 0.001"};

TEST(SmoothPictures, DrawTheControlPointsRefinedFurtherAndLeaveTheBodyAlone) {
  TestSession session(k_slab);
  session.run({"set density 100 + 400 * x"});
  const std::uint64_t before = session.hash();
  PictureRequest request;
  request.field = "density";
  request.smooth = 1;
  const Scene finer = make_scene(session.document(), request);
  EXPECT_EQ(session.hash(), before);
  session.run({"levels 2"});
  request.smooth = 0;
  const Scene wanted = make_scene(session.document(), request);
  ASSERT_EQ(finer.surface.positions.size(), wanted.surface.positions.size());
  EXPECT_EQ(finer.surface.corners, wanted.surface.corners);
  EXPECT_EQ(finer.surface.values, wanted.surface.values);
  for (std::size_t v = 0; v < wanted.surface.positions.size(); ++v)
    EXPECT_EQ(finer.surface.positions[v], wanted.surface.positions[v]);
  EXPECT_EQ(finer.pins.size(), wanted.pins.size());
  EXPECT_EQ(finer.pins.size(), 25U);
}

TEST(SeparateCells, AreAllThereEachAboutItsOwnMiddle) {
  TestSession session({"new box 3 2 2 size 3 2 2", "levels 1"});
  const subdiv::Solid& solid = session.document().refinement().solid();
  const Eigen::Matrix3Xd positions = session.document().surface_nodes(session.document().rest());
  const SceneSurface whole = separate_cells(solid, positions, 1), small = separate_cells(solid, positions, 0.5);
  ASSERT_EQ(whole.positions.size(), 8 * 96U);
  EXPECT_EQ(whole.cell_from_face.size(), 6 * 96U);
  EXPECT_EQ(whole.wire.size(), 12 * 96U);
  EXPECT_EQ(whole.sharp_edges, whole.wire);
  for (std::size_t cell = 0; cell < 96; ++cell) {
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (std::size_t v = 8 * cell; v < 8 * cell + 8; ++v) middle += whole.positions[v] / 8;
    for (std::size_t v = 8 * cell; v < 8 * cell + 8; ++v)
      EXPECT_LT((small.positions[v] - middle - 0.5F * (whole.positions[v] - middle)).norm(), 1e-6F);
  }
  // Faces look outwards: the volume by the divergence theorem is that of the cells, an eighth of it when halved.
  const auto volume = [](const SceneSurface& surface) {
    double sum = 0;
    for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f)
      for (std::size_t c = surface.offsets[f] + 1; c + 1 < surface.offsets[f + 1]; ++c) {
        const auto at = [&](std::size_t corner) -> Eigen::Vector3d {
          return surface.positions[surface.corners[corner]].cast<double>();
        };
        sum += at(surface.offsets[f]).dot(at(c).cross(at(c + 1))) / 6;
      }
    return sum;
  };
  EXPECT_GT(volume(whole), 6);
  EXPECT_NEAR(volume(small), volume(whole) / 8, 1e-5 * volume(whole));
}

TEST(CellKinds, ColourEachCellAsTheTableOfElementsCounts) {
  TestSession session({"new box 4 4 3 size 4 4 3", "peak 0.5 where z > 2.9 and x < 1 and y < 1", "levels 1"});
  PictureRequest request;
  request.cell_kinds = true;
  const Scene scene = make_scene(session.document(), request);
  const fem::CellCounts& counts = session.document().discretization().cells;
  std::map<float, std::size_t> cells;  // by the value of the first corner of their faces
  std::vector<std::uint32_t> seen;
  for (std::size_t f = 0; f + 1 < scene.surface.offsets.size(); ++f) {
    const std::uint32_t cell = scene.surface.cell_from_face[f];
    const float kind = scene.surface.values[scene.surface.corners[scene.surface.offsets[f]]];
    for (std::size_t c = scene.surface.offsets[f]; c < scene.surface.offsets[f + 1]; ++c)
      EXPECT_EQ(scene.surface.values[scene.surface.corners[c]], kind);
    if (!seen.empty() && seen.back() == cell) continue;
    seen.push_back(cell);
    ++cells[kind];
  }
  EXPECT_EQ(cells[0], counts.regular_published);
  EXPECT_EQ(cells[0] + cells[1], counts.regular);
  EXPECT_EQ(cells[2], counts.extraordinary);
  EXPECT_EQ(cells[3], counts.irregular);
  EXPECT_GT(counts.irregular, 0U);
  ASSERT_TRUE(scene.legend);
  EXPECT_THAT(scene.legend->names,
              testing::ElementsAre("regular", "regular, at the boundary", "extraordinary", "irregular"));
}

TEST(CurvePictures, ShowTheHandlesWhereTheyWentAndTheCurveOnTheSurface) {
  TestSession session(k_slab);
  session.run({"tool pull radius 0.1 strength 50000",
               "curve through 0.1 0.3 0.1 0.3 0.3 0.1 0.5 0.3 0.1 handle 2 to 0.3 0.3 0.16 ticks 200 hold 100"});
  ASSERT_TRUE(session->tool_force());
  const std::vector<Eigen::Vector3d> handles = session->tool_force()->curve_handles;
  ASSERT_EQ(handles.size(), 3U);
  EXPECT_EQ(handles[0], Eigen::Vector3d(0.1, 0.3, 0.1));
  EXPECT_LT((handles[1] - Eigen::Vector3d(0.3, 0.3, 0.16)).norm(), 1e-12);
  PictureRequest request;
  request.curve_handles = handles;
  const Scene scene = make_scene(session.document(), request);
  ASSERT_EQ(scene.handles.size(), 3U);
  ASSERT_EQ(scene.lines.size(), 1U);
  EXPECT_EQ(scene.lines[0].look, LineLook::curve);
  // The highest point of the curve is that of the surface: the slab has been drawn up there.
  float highest = 0, surface = 0;
  for (const auto& line : scene.lines[0].lines) highest = std::max(highest, line[0].z());
  for (const Eigen::Vector3f& v : scene.surface.positions) surface = std::max(surface, v.z());
  EXPECT_NEAR(highest, surface, 0.004F);  // it need not pass through the node that is highest
  EXPECT_GT(highest, 0.12F);
  session.run({"step"});  // anything else ends what the picture shows of the stroke
  EXPECT_FALSE(session->tool_force());
}

TEST(FeltForce, OfAProbeIsItsStiffnessTimesItsDepthUpToItsLimit) {
  TestSession session({"new box 6 6 6 size 0.6 0.6 0.6", "levels 1", "set young_modulus 5e4", "pin where z < 0.001",
                       "tool probe radius 0.15"});
  const std::uint64_t before = session.hash();
  const auto press = [&](double z) {
    session.run({"stroke from 0.3 0.3 " + std::to_string(z) + " to 0.3 0.3 " + std::to_string(z) + " ticks 10"});
    return session.measure("tool_force");
  };
  EXPECT_EQ(press(0.61), 0);
  const double deep = press(0.59), deeper = press(0.58), deepest = press(0.57);
  EXPECT_GT(deep, 0);
  // The stiffness read hardly depends on the depth while the brush holds nearly the same points.
  EXPECT_NEAR(deeper - deep, deepest - deeper, 0.03 * (deeper - deep));
  EXPECT_NEAR((deeper - deep) / 0.01, session.measure("felt_stiffness at 0.3 0.3 0.58"),
              0.05 * (deeper - deep) / 0.01);
  session.run({"tool probe radius 0.15 limit 2"});
  EXPECT_DOUBLE_EQ(press(0.57), 2);
  session.run({"undo"});
  EXPECT_EQ(session.hash(), before);  // a probe changes nothing
  EXPECT_EQ(session.measure("tool_force"), 0);
}

TEST(FeltForce, FillsTheGroundOfThePictureByItsShare) {
  GreyRenderer renderer;
  SessionOptions options;
  options.renderer = &renderer;
  TestSession session(k_slab, std::move(options));
  session.run({"tool pull radius 0.1 strength 1000 limit 5", "stroke from 0.3 0.3 0.1 to 0.3 0.3 0.3 ticks 100",
               "render a.png size 64 48 felt 20 title \"a pull\" frame 0 0 0 1 2 3"});
  ASSERT_TRUE(renderer.last_scene.felt);
  EXPECT_NEAR(renderer.last_scene.felt->share, session.measure("tool_force") / 20, 1e-12);
  EXPECT_NEAR(renderer.last_scene.felt->share, 0.25, 1e-9);
  EXPECT_THAT(renderer.last_scene.felt->text, HasSubstr("5 N"));
  EXPECT_EQ(renderer.last_options.title, "a pull");
  ASSERT_TRUE(renderer.last_options.frame);
  EXPECT_EQ(renderer.last_options.frame->places.back(), Eigen::Vector3f(1, 2, 3));
  session.run({"step", "render a.png size 64 48 felt 20"});
  EXPECT_EQ(renderer.last_scene.felt->share, 0);
}

TEST(Render, RefusesWhatDoesNotGoTogether) {
  TestSession session(k_slab);
  for (const auto& [line, word] :
       std::vector<std::pair<const char*, const char*>>{{"render a.png smooth 1 springs", "smooth"},
                                                        {"render a.png smooth 1 shrink 0.5", "smooth"},
                                                        {"render a.png shrink 0.5 wire control", "wire control"},
                                                        {"render a.png cell_kinds field density", "cell_kinds"},
                                                        {"render a.png shrink 0.5 volume field density", "volume"},
                                                        {"render a.png frame 1 2 3 1 2 3", "frame"},
                                                        {"render a.png felt 0", "felt"},
                                                        {"render a.png shrink 1.5", "shrink"}})
    EXPECT_THAT(session.fault_of(line).what(), HasSubstr(word)) << line;
}

}  // namespace
}  // namespace argil::sculpt
