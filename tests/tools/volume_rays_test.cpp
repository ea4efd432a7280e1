#include "tools/view/volume_rays.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "sculpt/physics_picture.h"
#include "sculpt/scene.h"
#include "subdiv/primitives.h"
#include "tools/view/colour.h"
#include "tools/view/offscreen_renderer.h"

namespace argil::view {
namespace {

using sculpt::ColourMap;
using sculpt::SceneVolume;

constexpr int k_width = 90, k_height = 60;
const Eigen::Vector3d k_size(2, 1, 0.7);

double linear_field(const Eigen::Vector3d& x) {
  return 1 + 2 * x.x() - 0.5 * x.y() + 3 * x.z();
}

// A box of 4 x 3 x 2 hexahedra; the vertices inside and on the sides are moved within the box, so that cells are
// neither boxes nor alike, and the body stays a box.
subdiv::Built box(bool distorted) {
  subdiv::Built built = subdiv::box_grid(4, 3, 2, k_size);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.08, 0.08);
  if (distorted)
    for (Eigen::Index v = 0; v < built.positions.cols(); ++v)
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const double at = built.positions(axis, v), by = shift(random);
        if (at > 1e-9 && at < k_size[axis] - 1e-9) built.positions(axis, v) = at + by;
      }
  return built;
}

template <class Field>
SceneVolume volume_of(const subdiv::Built& built, const Field& field) {
  Eigen::VectorXd values(built.positions.cols());
  for (Eigen::Index v = 0; v < values.size(); ++v) values[v] = field(Eigen::Vector3d(built.positions.col(v)));
  return sculpt::scene_volume(built.solid, built.positions, {}, values);
}

struct View {
  Place place;
  Camera camera;
};
View view_from(const SceneVolume& volume, const Eigen::Vector3d& from) {
  View view;
  view.place = place_of(volume.positions);
  std::vector<Eigen::Vector3f> placed;
  for (const Eigen::Vector3f& position : volume.positions) placed.push_back(view.place(position));
  sculpt::PictureOptions options;
  options.width = k_width;
  options.height = k_height;
  options.view_from = from;
  view.camera = framing_camera(placed, options, {});
  return view;
}

// Where the ray of a pixel enters and leaves the box [m], by unprojecting two places of the pixel and cutting the
// line between them with the box's sides: nothing is shared with the code under test.
struct Chord {
  Eigen::Vector3d enter = Eigen::Vector3d::Zero(), exit = Eigen::Vector3d::Zero();
  double length = 0;
};
Chord chord_of(const View& view, int x, int y) {
  const Eigen::Matrix4d world_from_clip = view.camera.clip_from_world.cast<double>().inverse();
  const auto unproject = [&](double depth) -> Eigen::Vector3d {
    const Eigen::Vector4d at =
        world_from_clip * Eigen::Vector4d(2 * (x + 0.5) / k_width - 1, 1 - 2 * (y + 0.5) / k_height, depth, 1);
    return view.place.middle + view.place.radius * at.head<3>() / at.w();
  };
  const Eigen::Vector3d from = unproject(-1), along = unproject(1) - from;
  double enter = 0, exit = 1;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    double a = -from[axis] / along[axis], b = (k_size[axis] - from[axis]) / along[axis];
    if (a > b) std::swap(a, b);
    enter = std::max(enter, a);
    exit = std::min(exit, b);
  }
  if (!(exit > enter)) return {};
  return {from + enter * along, from + exit * along, (exit - enter) * along.norm()};
}

const Eigen::Vector3d k_directions[] = {{0, -1, 0},     {1, 0, 0},       {0, 0, 1},
                                        {1, -1.6, 0.9}, {-0.3, 0.2, -1}, {-2, -1, 0.1}};

TEST(VolumeRays, ALinearFieldThroughABoxGivesTheAnalyticIntegralAlongEveryRay) {
  for (const bool distorted : {false, true}) {
    const SceneVolume volume = volume_of(box(distorted), linear_field);
    for (const Eigen::Vector3d& from : k_directions) {
      const View view = view_from(volume, from);
      const std::vector<double> found = line_integrals(volume, view.place, view.camera, k_width, k_height);
      int hit = 0;
      for (int y = 0; y < k_height; ++y)
        for (int x = 0; x < k_width; ++x) {
          const Chord chord = chord_of(view, x, y);
          const double wanted = 0.5 * (linear_field(chord.enter) + linear_field(chord.exit)) * chord.length;
          // The camera and the positions are in single precision: places are off by up to 1e-6 of the scene, a
          // chord by as much over the sine at which it meets a side. The issue asks for 1 %.
          ASSERT_NEAR(found[static_cast<std::size_t>(y * k_width + x)], chord.length > 0 ? wanted : 0,
                      1e-4 * std::abs(wanted) + 2e-4)
              << x << ' ' << y << " from " << from.transpose() << (distorted ? " distorted" : "");
          hit += chord.length > 0.1 ? 1 : 0;
        }
      EXPECT_GT(hit, k_width * k_height / 8);
    }
  }
}

TEST(VolumeRays, OpacityIsThatOfTheIntegralOfTheExtinction) {
  const SceneVolume volume = [] {
    SceneVolume made = volume_of(box(true), linear_field);
    made.opacity = 0.2;
    return made;
  }();
  const sculpt::SceneLegend legend{"", "", 0, 8, ColourMap::viridis};  // 0.5 … 7.1 lies within: no clamping
  const View view = view_from(volume, {1, -1.6, 0.9});
  const std::vector<float> picture = volume_picture(volume, legend, view.place, view.camera, k_width, k_height);
  for (int y = 0; y < k_height; ++y)
    for (int x = 0; x < k_width; ++x) {
      const Chord chord = chord_of(view, x, y);
      double depth = 0;
      if (chord.length > 0)
        depth = 0.2 * 0.5 *
                (extinction(legend.map, linear_field(chord.enter) / 8) +
                 extinction(legend.map, linear_field(chord.exit) / 8)) *
                chord.length / view.place.radius;
      ASSERT_NEAR(picture[4 * static_cast<std::size_t>(y * k_width + x) + 3], 1 - std::exp(-depth), 1e-3)
          << x << ' ' << y;
    }
}

TEST(VolumeRays, AConstantFieldHasItsColourAndWhatIsBeyondTheLegendItsEnds) {
  for (const double value : {-3.0, 0.25, 0.6, 9.0}) {
    const SceneVolume volume = volume_of(box(true), [&](const Eigen::Vector3d&) { return value; });
    const sculpt::SceneLegend legend{"", "", 0, 1, ColourMap::cividis};
    const View view = view_from(volume, {1, -1.6, 0.9});
    const std::vector<float> picture = volume_picture(volume, legend, view.place, view.camera, k_width, k_height);
    const float* pixel = &picture[4 * (k_height / 2 * k_width + k_width / 2)];
    const Colour wanted = field_colour(k_cividis, value);
    ASSERT_GT(pixel[3], 0.1);
    EXPECT_NEAR(pixel[0] / pixel[3], wanted.red, 1e-3) << value;
    EXPECT_NEAR(pixel[1] / pixel[3], wanted.green, 1e-3) << value;
    EXPECT_NEAR(pixel[2] / pixel[3], wanted.blue, 1e-3) << value;
  }
}

TEST(VolumeRays, WhatIsNearerHidesWhatIsFarther) {
  // −1 (blue) at one end of the box and +1 (red) at the other.
  const SceneVolume volume = volume_of(box(false), [](const Eigen::Vector3d& x) { return x.x() - 1; });
  const sculpt::SceneLegend legend{"", "", -1, 1, ColourMap::balanced};
  for (const double side : {-1.0, 1.0}) {
    const View view = view_from(volume, {side, 0, 0});
    const std::vector<float> picture = volume_picture(volume, legend, view.place, view.camera, k_width, k_height);
    const float* pixel = &picture[4 * (k_height / 2 * k_width + k_width / 2)];
    ASSERT_GT(pixel[3], 0.9);
    if (side < 0)
      EXPECT_GT(pixel[2], pixel[0] + 0.3F);
    else
      EXPECT_GT(pixel[0], pixel[2] + 0.3F);
  }
}

TEST(VolumeRays, GiveTheSameBitsForAnyNumberOfThreads) {
  const SceneVolume volume = volume_of(box(true), linear_field);
  const View view = view_from(volume, {1, -1.6, 0.9});
  const sculpt::SceneLegend legend{"", "", 0, 8, ColourMap::viridis};
  std::vector<float> first;
  for (const std::size_t threads : {1, 2, 3}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const std::vector<float> found = volume_picture(volume, legend, view.place, view.camera, k_width, k_height);
    if (first.empty()) first = found;
    EXPECT_EQ(found, first);
  }
}

TEST(VolumeRays, ShowInThePictureWithItsLegendInPlaceOfTheSurface) {
  const subdiv::Built built = box(false);
  sculpt::Scene scene;
  scene.surface = sculpt::cells_surface(built.solid, built.positions);
  scene.draw_surface = false;
  scene.volume = volume_of(built, [](const Eigen::Vector3d&) { return 1.0; });
  scene.volume->opacity = 50;  // nothing shines through
  scene.legend = sculpt::SceneLegend{"strain", "%", 0, 1, ColourMap::viridis};
  sculpt::PictureOptions options;
  options.width = 200;
  options.height = 150;
  options.wireframe = false;
  const sculpt::Picture picture = make_offscreen_renderer()->render(scene, options);
  const std::uint8_t* pixel = &picture.rgba[4 * (75 * 200 + 80)];
  const Colour wanted = field_colour(k_viridis, 1);
  EXPECT_NEAR(pixel[0], 255 * wanted.red, 2);
  EXPECT_NEAR(pixel[1], 255 * wanted.green, 2);
  EXPECT_NEAR(pixel[2], 255 * wanted.blue, 2);
}

TEST(FieldColours, OfThreeMapsRunThroughTheirEndsAndTheBalancedOneIsEvenInLightness) {
  for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis, ColourMap::balanced}) {
    const MapColours& colours = map_colours(map);
    EXPECT_FLOAT_EQ(field_colour(colours, -1).red, colours[0][0]);
    EXPECT_FLOAT_EQ(field_colour(colours, 2).blue, colours[10][2]);
    EXPECT_FLOAT_EQ(field_colour(colours, 0.35).green, 0.5F * (colours[3][1] + colours[4][1]));
  }
  // Relative luminance of sRGB; both ends and all pairs are as light as each other, to 0.06 of white.
  const auto luminance = [](const std::array<float, 3>& c) {
    const auto linear = [](float v) { return std::pow((v + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
  };
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(luminance(k_balanced[i]), luminance(k_balanced[10 - i]), 0.06) << i;
    EXPECT_LT(luminance(k_balanced[i]), luminance(k_balanced[i + 1]));
  }
}

}  // namespace
}  // namespace argil::view
