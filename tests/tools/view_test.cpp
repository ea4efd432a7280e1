#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sculpt/scene.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "tools/view/legend.h"
#include "tools/view/offscreen_renderer.h"
#include "tools/view/surface_mesh.h"

namespace argil::view {
namespace {

using sculpt::Picture;
using sculpt::PictureOptions;
using sculpt::Scene;
using subdiv::Built;
using subdiv::CellId;

constexpr std::uint32_t k_nothing = 0xffffffffU;

/// One renderer for all tests: what it keeps between pictures must not show.
sculpt::Renderer& renderer() {
  static const std::unique_ptr<sculpt::Renderer> shared = make_offscreen_renderer();
  return *shared;
}

PictureOptions options(int width, int height) {
  PictureOptions result;
  result.width = width;
  result.height = height;
  return result;
}

Scene scene_of(const Built& built) {
  Scene scene;
  scene.surface = sculpt::cells_surface(built.solid, built.positions);
  return scene;
}

std::set<std::uint32_t> ids_shown(const Picture& picture) {
  std::set<std::uint32_t> ids(picture.cell_ids.begin(), picture.cell_ids.end());
  ids.erase(k_nothing);
  return ids;
}

ErrorCode error_of(const Scene& scene, const PictureOptions& how) {
  try {
    (void)renderer().render(scene, how);
  } catch (const Error& error) {
    EXPECT_FALSE(std::string(error.what()).empty());
    return error.code();
  }
  ADD_FAILURE() << "expected an Error";
  return ErrorCode::refused;
}

/// Pixels of the id buffer that are covered, as a box: left, top, right, bottom.
std::array<int, 4> covered_box(const Picture& picture) {
  std::array<int, 4> box{picture.width, picture.height, -1, -1};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.cell_ids[static_cast<std::size_t>(y * picture.width + x)] != k_nothing)
        box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
  return box;
}

TEST(View, SixSidesTogetherShowExactlyTheCellsAtTheBoundary) {
  const Built grid = subdiv::box_grid(4, 3, 3, {4, 3, 3});
  const Scene scene = scene_of(grid);
  std::set<std::uint32_t> shown;
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(1, 0.1, 0.1), Eigen::Vector3d(-1, 0.1, 0.1), Eigen::Vector3d(0.1, 1, 0.1),
        Eigen::Vector3d(0.1, -1, 0.1), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1)}) {
    PictureOptions how = options(160, 120);
    how.view_from = from;
    shown.merge(ids_shown(renderer().render(scene, how)));
  }
  std::set<std::uint32_t> expected;
  for (std::uint32_t cell = 0; cell < 36; ++cell) {
    const std::uint32_t i = cell % 4, j = cell / 4 % 3, k = cell / 12;
    if (i == 0 || i == 3 || j != 1 || k != 1) expected.insert(cell);
  }
  EXPECT_EQ(shown, expected);
}

TEST(View, ClipPlaneShowsExactlyTheCellsThatItMeetsOrKeeps) {
  const Built grid = subdiv::box_grid(5, 4, 4, {5, 4, 4});
  // The plane x = 2.5 takes away x > 2.5 and meets the cells i = 2: layers 0, 1, 2 stay.
  Scene scene;
  scene.surface = sculpt::clipped_surface(grid.solid, grid.positions, {{2.5, 0, 0}, {3, 0, 0}});
  PictureOptions how = options(200, 150);
  how.view_from = {1, 0, 0};
  const Picture along = renderer().render(scene, how);
  std::set<std::uint32_t> expected;
  for (std::uint32_t jk = 0; jk < 16; ++jk) expected.insert(5 * jk + 2);
  EXPECT_EQ(ids_shown(along), expected);  // whole interior cells, all of the layer and nothing else

  std::set<std::uint32_t> around;
  for (const Eigen::Vector3d& from : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-1, -1, -1),
                                      Eigen::Vector3d(1, -1, 1), Eigen::Vector3d(-1, 1, -1)}) {
    how.view_from = from;
    around.merge(ids_shown(renderer().render(scene, how)));
  }
  for (const std::uint32_t id : around) EXPECT_LE(id % 5, 2U);
}

TEST(View, PlaneThroughFacesOfCellsOnlyTouchesThem) {
  const Built grid = subdiv::box_grid(4, 1, 1, {4, 1, 1});
  const auto kept = sculpt::cells_met_or_kept(grid.solid, grid.positions, {{2, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(kept.raw(), (std::vector<std::uint8_t>{1, 1, 0, 0}));
  const auto met = sculpt::cells_met_or_kept(grid.solid, grid.positions, {{2.001, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(met.raw(), (std::vector<std::uint8_t>{1, 1, 1, 0}));
  const auto other = sculpt::cells_met_or_kept(grid.solid, grid.positions, {{2, 0, 0}, {-7, 0, 0}});
  EXPECT_EQ(other.raw(), (std::vector<std::uint8_t>{0, 0, 1, 1}));
  EXPECT_THROW((void)sculpt::cells_met_or_kept(grid.solid, grid.positions, {{2, 0, 0}, {0, 0, 0}}), Error);
}

TEST(View, CutFacesAreMarkedTurnedOutwardsAndLighter) {
  const Built grid = subdiv::box_grid(3, 1, 1, {3, 1, 1});
  for (const double side : {1.0, -1.0}) {
    Scene scene;
    scene.surface = sculpt::clipped_surface(grid.solid, grid.positions, {{1.5, 0, 0}, {side, 0, 0}});
    const auto& surface = scene.surface;
    ASSERT_EQ(surface.cell_from_face.size(), 10U);  // two cells of the three
    std::size_t cuts = 0;
    const Eigen::Vector3f middle(side > 0 ? 1.0F : 2.0F, 0.5F, 0.5F);
    for (std::size_t f = 0; f < 10; ++f) {
      const auto at = [&](std::size_t i) { return surface.positions[surface.corners[surface.offsets[f] + i]]; };
      const Eigen::Vector3f normal = (at(1) - at(0)).cross(at(2) - at(0));
      EXPECT_GT(normal.dot(at(0) - middle), 0) << "face " << f;
      cuts += surface.cut_faces[f];
    }
    EXPECT_EQ(cuts, 1U);
  }
  // The same face, cut or not, seen straight on.
  Scene cut;
  cut.surface = sculpt::clipped_surface(grid.solid, grid.positions, {{1.5, 0, 0}, {1, 0, 0}});
  Scene whole = cut;
  whole.surface.cut_faces.clear();
  PictureOptions how = options(64, 64);
  how.view_from = {1, 0, 0};
  how.wireframe = false;
  const Picture a = renderer().render(cut, how), b = renderer().render(whole, how);
  const std::size_t centre = 4 * (32 * 64 + 32);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(a.rgba[centre + k], b.rgba[centre + k] + 10);
}

TEST(View, EverythingIsFramedWithMarginAtAnySizeOfModelAndPicture) {
  for (const double size : {1e-6, 1.0, 1e6})
    for (const auto& [width, height] : {std::pair{320, 200}, std::pair{120, 300}}) {
      const Built grid = subdiv::box_grid(2, 2, 2, {size, 2 * size, 0.5 * size});
      const Picture picture = renderer().render(scene_of(grid), options(width, height));
      EXPECT_EQ(ids_shown(picture).size(), 7U);  // of eight cells one is behind the others
      const auto box = covered_box(picture);
      EXPECT_GE(box[0], width / 20);
      EXPECT_GE(box[1], height / 20);
      EXPECT_LE(box[2], width - 1 - width / 20);
      EXPECT_LE(box[3], height - 1 - height / 20);
      // Nothing is lost either: it fills the free part (0.86 of the picture) in one direction.
      const double filled = std::max(double(box[2] - box[0] + 1) / width, double(box[3] - box[1] + 1) / height);
      EXPECT_NEAR(filled, 0.86, 0.03);
    }
}

TEST(View, LegendHasRoomBesideTheModel) {
  Scene scene = scene_of(subdiv::box_grid(4, 1, 1, {4, 1, 1}));
  std::vector<double> strain(20);
  for (std::size_t i = 0; i < strain.size(); ++i) strain[i] = 0.006 * static_cast<double>(i);
  sculpt::show_field(scene, strain, "strain", "%");
  EXPECT_DOUBLE_EQ(scene.legend->low, 0);
  EXPECT_NEAR(scene.legend->high, 0.12, 1e-12);
  PictureOptions how = options(640, 400);
  how.view_from = {0, -1, 0.2};
  const Picture picture = renderer().render(scene, how);
  // Right of the model: the bar, bright at the top (yellow) and violet below.
  const auto box = covered_box(picture);
  const int bar_x = 640 - 26;  // the bar is 14 pixels wide and ends 20 from the side
  EXPECT_LT(box[2], bar_x - 30);
  int yellow = -1, violet = -1;
  for (int y = 0; y < 400; ++y) {
    const std::uint8_t* p = &picture.rgba[4 * static_cast<std::size_t>(y * 640 + bar_x)];
    if (yellow < 0 && p[0] > 200 && p[1] > 180 && p[2] < 90) yellow = y;
    if (p[0] > 50 && p[1] < 30 && p[2] > 70) violet = y;
  }
  EXPECT_GT(yellow, 0);
  EXPECT_GT(violet, yellow + 100);
}

TEST(View, KeyNamesLinesInTheirColourRightOfTheModel) {
  Scene scene = scene_of(subdiv::box_grid(2, 1, 1, {2, 1, 1}));
  scene.lines.push_back({sculpt::LineLook::inner_spring, {{{Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 1, 1)}}}});
  PictureOptions how = options(640, 400);
  const Picture without = renderer().render(scene, how);
  scene.lines.back().name = "inner diagonals";
  const Picture with = renderer().render(scene, how);
  EXPECT_LT(covered_box(with)[2], covered_box(without)[2]);  // the model makes room
  // The stroke of the key: at the right, 62 of 800 parts from the top, in the orange of the lines.
  const std::uint8_t* p = &with.rgba[4 * static_cast<std::size_t>(46 * 640 + 610)];
  EXPECT_GT(p[0], 200);
  EXPECT_GT(p[0], 2 * p[2]);
}

TEST(View, FieldColoursFollowTheValues) {
  Scene scene = scene_of(subdiv::box_grid(2, 1, 1, {2, 1, 1}));
  std::vector<double> values(12, 1.0);
  sculpt::show_field(scene, values, "density", "kg/m³");
  scene.legend->low = 0;
  PictureOptions how = options(96, 64);
  how.wireframe = false;
  const auto centre = [&] {
    const Picture picture = renderer().render(scene, how);
    const std::uint8_t* p = &picture.rgba[4 * (32 * 96 + 40)];
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  scene.legend->high = 1;
  const auto high = centre();
  EXPECT_GT(high[0], 2 * high[2]);  // yellow
  scene.legend->high = 1000;
  const auto low = centre();
  EXPECT_GT(low[2], 3 * low[1]);  // violet
}

/// How far a pixel is from grey.
int chroma(const Picture& picture, int x, int y) {
  const std::uint8_t* p = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x)];
  return std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]});
}

TEST(View, TheGroundIsTheMoreSaturatedTheMoreIsFelt) {
  Scene scene = scene_of(subdiv::box_grid(2, 1, 1, {2, 1, 1}));
  for (const bool light : {false, true}) {
    PictureOptions how = options(200, 150);
    how.light_theme = light;
    int before_above = -1, before_below = -1;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      scene.felt = sculpt::SceneFelt{share, ""};
      const Picture picture = renderer().render(scene, how);
      EXPECT_GT(chroma(picture, 3, 3), before_above + 3) << share;
      EXPECT_GT(chroma(picture, 3, 146), before_below + 3) << share;
      before_above = chroma(picture, 3, 3);
      before_below = chroma(picture, 3, 146);
    }
    EXPECT_GT(before_above, 120);
    scene.felt = sculpt::SceneFelt{0.0, ""};
    const Picture none = renderer().render(scene, how);
    scene.felt.reset();
    EXPECT_EQ(chroma(none, 3, 3), chroma(renderer().render(scene, how), 3, 3));
    scene.felt = sculpt::SceneFelt{7.0, ""};  // more than all is all
    EXPECT_EQ(chroma(renderer().render(scene, how), 3, 3), before_above);
  }
}

TEST(View, AFrameHoldsTheCameraWhateverTheSceneDoes) {
  Scene small = scene_of(subdiv::box_grid(1, 1, 1, {1, 1, 1}));
  Scene large = small;
  large.cage_points.push_back({4, 4, 4});
  PictureOptions how = options(120, 100);
  EXPECT_NE(covered_box(renderer().render(small, how)), covered_box(renderer().render(large, how)));
  how.frame = sculpt::box_frame({-1, -1, -1}, {2, 2, 2});
  const auto framed = covered_box(renderer().render(small, how)), same = covered_box(renderer().render(large, how));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(framed[i], same[i], 1);
  // Beside a legend that gets wider the same places stay where they are, unless room is left for it.
  small.legend = sculpt::SceneLegend{.title = "strain", .unit = "", .low = 0, .high = 1};
  EXPECT_EQ(covered_box(renderer().render(small, how)), framed);
  how.width = 400;
  how.height = 300;
  const auto filled = covered_box(renderer().render(small, how));
  how.frame->leaves_room = true;
  const auto beside = covered_box(renderer().render(small, how));
  EXPECT_LT(beside[2], filled[2]);
  // Numbers that get longer, and arrows and pins that come, move nothing.
  small.legend = sculpt::SceneLegend{.title = "stress", .unit = "", .low = -20000, .high = 20000};
  small.arrows.push_back({{0, 0, 0}, {0.1F, 0, 0}});
  small.pins.push_back({0, 0, 0});
  EXPECT_EQ(covered_box(renderer().render(small, how)), beside);
  how.frame = sculpt::box_frame({1, 1, 1}, {1, 1, 1});
  EXPECT_EQ(error_of(small, how), ErrorCode::bad_input);
  how.frame->places.clear();
  EXPECT_EQ(error_of(small, how), ErrorCode::bad_input);
}

TEST(View, TitleAndForceAreWrittenInCornersThatStayFree) {
  Scene scene = scene_of(subdiv::box_grid(2, 1, 1, {2, 1, 1}));
  PictureOptions how = options(400, 300);
  const auto differs = [&](const Picture& a, const Picture& b, int top, int bottom) {
    int count = 0;
    for (int y = top; y < bottom; ++y)
      for (int x = 0; x < 200; ++x)
        if (a.rgba[4 * static_cast<std::size_t>(y * 400 + x)] != b.rgba[4 * static_cast<std::size_t>(y * 400 + x)])
          ++count;
    return count;
  };
  how.title = " ";
  scene.felt = sculpt::SceneFelt{0, ""};
  const Picture without = renderer().render(scene, how);
  how.title = "title";
  const Picture titled = renderer().render(scene, how);
  EXPECT_GT(differs(without, titled, 0, 45), 50);
  EXPECT_EQ(differs(without, titled, 45, 300), 0);
  how.title = " ";
  scene.felt->text = "felt 3 N";
  const Picture felt = renderer().render(scene, how);
  EXPECT_GT(differs(without, felt, 260, 300), 50);
  EXPECT_EQ(differs(without, felt, 0, 260), 0);
  const auto box = covered_box(titled);
  EXPECT_GT(box[1], 40);
  EXPECT_LT(box[3], 265);
}

TEST(View, KindsAreColouredExactlyAndNamedInAList) {
  Scene scene = scene_of(subdiv::box_grid(1, 1, 1, {1, 1, 1}));
  scene.surface.values.assign(scene.surface.positions.size(), 2);
  scene.legend = sculpt::SceneLegend{"cells", "", 0, 10, sculpt::ColourMap::kinds, {"regular", "", "irregular"}};
  const Picture picture = renderer().render(scene, options(500, 400));
  const auto has = [&](const std::array<float, 3>& wanted, int left, int right) {
    for (int y = 0; y < 400; ++y)
      for (int x = left; x < right; ++x) {
        const std::uint8_t* p = &picture.rgba[4 * static_cast<std::size_t>(y * 500 + x)];
        if (std::abs(p[0] - 255 * wanted[0]) < 2 && std::abs(p[1] - 255 * wanted[1]) < 2 &&
            std::abs(p[2] - 255 * wanted[2]) < 2)
          return true;
      }
    return false;
  };
  EXPECT_TRUE(has(k_kinds[0], 460, 500));
  EXPECT_FALSE(has(k_kinds[1], 460, 500));  // without a name it is not in the list
  EXPECT_TRUE(has(k_kinds[2], 460, 500));
  for (std::size_t a = 0; a < k_map_size; ++a)
    for (std::size_t b = a + 1; b < k_map_size; ++b)
      EXPECT_GT(
          std::hypot(k_kinds[a][0] - k_kinds[b][0], k_kinds[a][1] - k_kinds[b][1], k_kinds[a][2] - k_kinds[b][2]),
          0.15F);
}

TEST(Colours, GreenMeansSoftAndRedStiff) {
  const Colour soft = field_colour(k_green_red, 0), middle = field_colour(k_green_red, 0.5),
               stiff = field_colour(k_green_red, 1);
  EXPECT_GT(soft.green, 2 * soft.red);
  EXPECT_GT(stiff.red, 4 * stiff.green);
  const auto lightness = [](const Colour& c) { return 0.2126F * c.red + 0.7152F * c.green + 0.0722F * c.blue; };
  EXPECT_GT(lightness(middle), 1.5F * lightness(soft));
  EXPECT_GT(lightness(soft), 1.3F * lightness(stiff));
}

TEST(ShowField, AFieldThatIsTheSameEverywhereGetsOneColour) {
  // Rounding in the last digits must not be stretched over the whole range of colours.
  sculpt::Scene scene;
  scene.surface.vertex_from_surface = {0, 1, 2};
  const std::vector<double> same{0.0186, 0.0186 * (1 + 1e-13), 0.0186 * (1 - 1e-13)};
  sculpt::show_field(scene, same, "strain", "%");
  EXPECT_EQ(scene.legend->low, 0);
  EXPECT_NEAR(scene.legend->high, 0.02, 1e-12);
  const std::vector<double> none{0, 0, 0};
  sculpt::show_field(scene, none, "strain", "%");
  EXPECT_EQ(scene.legend->low, 0);
  EXPECT_GT(scene.legend->high, 0);
}

TEST(View, SamePictureTwiceAndAfterAnotherOne) {
  const Scene scene = scene_of(subdiv::box_grid(2, 2, 2, {1, 1, 1}));
  Scene other = scene_of(subdiv::wedge({1, 2, 3}));
  other.arrows.push_back({{0, 0, 5}, {0, 0, 3}});
  other.labels.push_back({{0, 0, 0}, "7"});
  other.pins.push_back({0, 0, 0});
  const Picture first = renderer().render(scene, options(150, 100));
  (void)renderer().render(other, options(64, 300));
  const Picture again = renderer().render(scene, options(150, 100));
  ASSERT_EQ(first.rgba.size(), again.rgba.size());
  for (std::size_t i = 0; i < first.rgba.size(); ++i)
    ASSERT_EQ(int{first.rgba[i]}, int{again.rgba[i]})
        << "channel " << i % 4 << " of pixel " << i / 4 % 150 << ", " << i / 600;
  EXPECT_EQ(first.cell_ids, again.cell_ids);
}

TEST(View, AntialiasedPictureKeepsItsSizeAndSoftensEdges) {
  const Scene scene = scene_of(subdiv::box_grid(1, 1, 1, {1, 1, 1}));
  PictureOptions how = options(131, 77);  // odd, so that no tile fits evenly
  how.wireframe = how.contact_shadow = false;
  std::size_t tones[2] = {};
  for (const int samples : {1, 16}) {
    how.samples = samples;
    const Picture picture = renderer().render(scene, how);
    ASSERT_EQ(picture.rgba.size(), 4U * 131 * 77);
    ASSERT_EQ(picture.cell_ids.size(), 131U * 77);
    std::set<int> reds;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      reds.insert(picture.rgba[i]);
      ASSERT_EQ(picture.rgba[i + 3], 255);
    }
    tones[samples == 1 ? 0 : 1] = reds.size();
  }
  EXPECT_GT(tones[1], tones[0] + 10);  // between clay and background
}

TEST(View, MarksShowWhereTheyAreAndArrowsPointAtTheirTip) {
  Scene scene;
  scene.draw_surface = false;
  scene.arrows.push_back({{0, 0, 1}, {0, 0, 0}});
  PictureOptions how = options(200, 200);
  how.view_from = {0, -1, 0};
  const Picture picture = renderer().render(scene, how);
  // Amber pixels in a row: more in the cone near the tip (below) than in the shaft.
  std::vector<int> amber(200, 0);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const std::uint8_t* p = &picture.rgba[4 * static_cast<std::size_t>(y * 200 + x)];
      if (p[0] > 140 && p[1] > 80 && p[2] < 90) ++amber[static_cast<std::size_t>(y)];
    }
  EXPECT_GT(*std::max_element(amber.begin() + 150, amber.end()), 6);
  EXPECT_GT(amber[60], 0);
  EXPECT_LT(*std::max_element(amber.begin(), amber.begin() + 120), 6);
}

TEST(View, OnePixelNoSceneOnePointAndTheLargestSizeAreFine) {
  EXPECT_EQ(renderer().render(Scene{}, options(1, 1)).rgba.size(), 4U);
  const Picture empty = renderer().render(Scene{}, options(40, 30));
  EXPECT_TRUE(ids_shown(empty).empty());
  EXPECT_GT(empty.rgba[0], empty.rgba[4 * 29 * 40]);  // the gradient: lighter above

  Scene point;
  point.pins.push_back({3, 3, 3});
  EXPECT_NE(renderer().render(point, options(40, 40)).rgba, renderer().render(Scene{}, options(40, 40)).rgba);

  PictureOptions large = options(4096, 2);
  large.samples = 16;
  const Picture wide = renderer().render(scene_of(subdiv::box_grid(1, 1, 1, {1, 1, 1})), large);
  EXPECT_EQ(wide.cell_ids.size(), 8192U);
}

TEST(View, RefusesWhatCannotBeDrawn) {
  const Scene good = scene_of(subdiv::box_grid(1, 1, 1, {1, 1, 1}));
  for (const auto& [width, height] :
       {std::pair{0, 10}, std::pair{10, -1}, std::pair{4097, 10}, std::pair{10, 100000}})
    EXPECT_EQ(error_of(good, options(width, height)), ErrorCode::bad_input);
  PictureOptions how = options(10, 10);
  how.samples = 3;
  EXPECT_EQ(error_of(good, how), ErrorCode::bad_input);
  how = options(10, 10);
  how.zoom = std::nan("");
  EXPECT_EQ(error_of(good, how), ErrorCode::bad_input);
  how = options(10, 10);
  how.view_from = Eigen::Vector3d::Zero();
  EXPECT_EQ(error_of(good, how), ErrorCode::bad_input);

  Scene bad = good;
  bad.surface.positions[3].y() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(error_of(bad, options(10, 10)), ErrorCode::bad_geometry);
  bad = good;
  bad.arrows.push_back({{0, 0, 0}, {0, std::nanf(""), 0}});
  EXPECT_EQ(error_of(bad, options(10, 10)), ErrorCode::bad_geometry);
  bad = good;
  bad.surface.values.assign(8, std::nanf(""));
  EXPECT_EQ(error_of(bad, options(10, 10)), ErrorCode::bad_geometry);

  Built broken = subdiv::box_grid(1, 1, 1, {1, 1, 1});
  broken.positions(0, 5) = std::nan("");
  EXPECT_THROW((void)sculpt::cells_surface(broken.solid, broken.positions), Error);
}

TEST(View, MissingOsmesaIsReportedWithItsRemedy) {
  const std::array<const char*, 1> names{"libNoSuchOSMesa.so.0"};
  try {
    (void)make_offscreen_renderer(names);
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_NE(std::string(error.what()).find("libosmesa6"), std::string::npos);
  }
}

TEST(Legend, TicksAreRoundWithinTheRangeAndCarryTheUnitOnce) {
  const auto texts = [](const sculpt::SceneLegend& legend) {
    std::vector<std::string> all;
    for (const Tick& tick : legend_ticks(legend, 6)) {
      EXPECT_GE(tick.value, legend.low - 1e-9 * std::abs(legend.low));
      EXPECT_LE(tick.value, legend.high + 1e-9 * std::abs(legend.high));
      all.push_back(tick.text);
    }
    return all;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts({"strain", "%", 0, 0.12}), (Texts{"0", "2", "4", "6", "8", "10", "12 %"}));
  EXPECT_EQ(texts({"stress", "Pa", -2e5, 6e5}), (Texts{"−200", "0", "200", "400", "600 kPa"}));
  EXPECT_EQ(texts({"density", "kg/m³", 0, 1500}), (Texts{"0", "500", "1000", "1500 kg/m³"}));
  EXPECT_EQ(texts({"displacement", "m", 0, 0.0031}), (Texts{"0", "1", "2", "3 mm"}));
  EXPECT_EQ(texts({"ratio", "", 0.1, 0.34}), (Texts{"0.10", "0.15", "0.20", "0.25", "0.30"}));
  EXPECT_EQ(texts({"constant", "N", 2500, 2500}), (Texts{"2.50 kN"}));
  EXPECT_EQ(texts({"nothing", "%", 0, 0}), (Texts{"0 %"}));
}

TEST(SurfaceMesh, NormalsAreSharedWithinSmoothRegionsAndSplitAtCreases) {
  // Two unit squares at a right angle along the edge 1–2.
  sculpt::SceneSurface surface;
  surface.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, -1}, {1, 1, -1}};
  surface.corners = {0, 1, 2, 3, 1, 4, 5, 2};
  surface.offsets = {0, 4, 8};
  surface.cell_from_face = {10, 11};
  const SurfaceMesh smooth = surface_mesh(surface, surface.positions);
  EXPECT_EQ(smooth.vertices.size(), 6U + 2U);
  surface.sharp_edges = {{2, 1}};
  const SurfaceMesh split = surface_mesh(surface, surface.positions);
  EXPECT_EQ(split.vertices.size(), 8U + 2U);
  for (const SurfaceVertex& vertex : split.vertices)  // each flat: exactly a unit axis up to rounding
    EXPECT_NEAR(std::max(vertex.normal.x(), vertex.normal.z()), 1.0F, 1e-6F);
  for (const SurfaceVertex& vertex : smooth.vertices)
    if (vertex.position.x() == 1 && vertex.position.z() == 0) {
      EXPECT_NEAR((vertex.normal - Eigen::Vector3f(1, 0, 1).normalized()).norm(), 0, 1e-6F);
    }
  ASSERT_EQ(split.triangles.size(), 3U * 8);
  for (std::size_t t = 0; t < 8; ++t) EXPECT_EQ(split.vertices[split.triangles[3 * t + 2]].cell, t < 4 ? 10U : 11U);
}

TEST(SceneSurface, SmoothShapesKeepTheirNormalsAndBoxesTheirEdges) {
  const Built box = subdiv::box_grid(2, 2, 2, {1, 1, 1});
  const auto surface = sculpt::cells_surface(box.solid, box.positions);
  EXPECT_EQ(surface.sharp_edges.size(), 24U);  // twelve edges of the box, two pieces each
  EXPECT_EQ(surface.wire.size(), 48U);         // boundary edges of the grid
  // Blown up to a ball no edge bends by more than 50 degrees but those at the former corners' middles stay below.
  Eigen::Matrix3Xd ball = box.positions.colwise() - Eigen::Vector3d(0.5, 0.5, 0.5);
  for (Eigen::Index i = 0; i < ball.cols(); ++i)
    if (ball.col(i).norm() > 0) ball.col(i).normalize();
  EXPECT_TRUE(sculpt::cells_surface(box.solid, ball).sharp_edges.empty());
}

TEST(SceneSurface, WireBetweenGroupsIsTheirCommonOutlineAndWhatIsSharp) {
  const Built box = subdiv::box_grid(4, 2, 2, {4, 2, 2});
  auto surface = sculpt::cells_surface(box.solid, box.positions);
  subdiv::CellData<CellId> group(16);
  for (std::size_t c = 0; c < 16; ++c) group[CellId{c}] = CellId{c % 4 < 2 ? 0U : 1U};
  sculpt::keep_wire_between(surface, group);
  std::size_t on_middle = 0;
  for (const auto& ends : surface.wire)
    on_middle += surface.positions[ends[0]].x() == 2 && surface.positions[ends[1]].x() == 2 ? 1 : 0;
  EXPECT_EQ(on_middle, 8U);                        // around the plane x = 2
  EXPECT_EQ(surface.wire.size(), 8U + 16U + 16U);  // and the box's edges: four of 4 pieces, eight of 2
}

TEST(SceneSurface, ControlCellsReachEveryRefinedCellAlike) {
  const Built box = subdiv::box_grid(3, 1, 1, {3, 1, 1});
  const subdiv::Refinement refinement = subdiv::refine_to_level(box.solid, 2);
  const auto control = sculpt::control_cells(refinement);
  std::array<int, 3> count{};
  for (const CellId cell : refinement.solid().cells()) ++count.at(control[cell].index());
  EXPECT_EQ(count, (std::array<int, 3>{64, 64, 64}));
}

TEST(SceneSurface, RoundStepCutsASpanIntoAtMostSoManyParts) {
  for (double span = 1e-7; span < 1e7; span *= 1.37)
    for (const int most : {1, 4, 6, 10}) {
      const double step = sculpt::round_step(span, most);
      EXPECT_LE(span / step, most * (1 + 1e-8));
      EXPECT_GT(span / step, most / 2.5 * (1 - 1e-8));  // 2 to 5 is the widest gap between round steps
    }
}

}  // namespace
}  // namespace argil::view
