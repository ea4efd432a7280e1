// What the window draws with, frame by frame, beside what view_test.cpp shows of whole pictures.

#include "tools/view/scene_painter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/scene.h"
#include "subdiv/primitives.h"
#include "tools/view/offscreen_renderer.h"
#include "tools/view/osmesa_context.h"
#include "tools/view/sample_average.h"
#include "tools/view/shaders.h"

namespace argil::view {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int k_width = 320, k_height = 240;

sculpt::Scene box(int cells) {
  const subdiv::Built built = subdiv::box_grid(cells, cells, 2, Eigen::Vector3d(1, 1, 0.2));
  sculpt::Scene scene;
  scene.surface = sculpt::cells_surface(built.solid, built.positions);
  return scene;
}

/// A context with a scene in it, seen from above its corner.
struct Stage {
  explicit Stage(const sculpt::Scene& scene)
      : context(), gl(context.gl()), place(place_of(scene.surface.positions)), painter(gl) {
    std::vector<Eigen::Vector3f> positions;
    for (const Eigen::Vector3f& position : scene.surface.positions) positions.push_back(place(position));
    options.width = k_width;
    options.height = k_height;
    camera = framing_camera(positions, options, Margins{});
    painter.load(scene, place, options);
    while (!painter.is_shaded()) painter.shade_on();
  }
  Bytes read(const Target& target) const {
    Bytes bytes;
    target.bind();
    target.read(k_width, k_height, bytes);
    for (std::size_t i = 3; i < bytes.size(); i += 4) bytes[i] = 255;
    return bytes;
  }
  /// The mean of so many samples.
  Bytes mean(int samples) {
    SampleAverage average(gl, k_width, k_height);
    for (int i = 0; i < samples; ++i) {
      const Camera shifted = average.shifted(camera);
      average.begin_sample();
      painter.paint(shifted, sampling, 0, 0);
    }
    const Target shown(gl, k_width, k_height, false);
    average.show(shown.framebuffer());
    return read(shown);
  }

  OsmesaContext context;
  const Gl& gl;
  Place place;
  ScenePainter painter;
  sculpt::PictureOptions options;
  Camera camera;
  Sampling sampling{k_width, k_height, 1, 1};
};

/// Root of the mean square, which edges decide.
double difference(const Bytes& a, const Bytes& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(int{a[i]} - int{b[i]}, 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

int largest_difference(const Bytes& a, const Bytes& b) {
  int most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(int{a[i]} - int{b[i]}));
  return most;
}

TEST(SampleAverage, ShiftsWithinAPixelAndAboutItsMiddle) {
  Stage stage(box(2));
  SampleAverage average(stage.gl, k_width, k_height);
  const Eigen::Vector3f at(0.1F, 0.2F, 0.1F);
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  for (int i = 0; i < SampleAverage::k_most; ++i) {
    const Eigen::Vector2f shift =
        average.shifted(stage.camera).pixel(at, k_width, k_height) - stage.camera.pixel(at, k_width, k_height);
    EXPECT_LE(shift.cwiseAbs().maxCoeff(), 0.501F);
    if (i == 0) {
      EXPECT_LE(shift.norm(), 1e-4F);
    }
    sum += shift;
    // Three of them already do not move the picture by more than an eighth of a pixel.
    if (i != 1) {
      EXPECT_LE((sum / (i + 1)).norm(), 0.13F) << i;
    }
    average.begin_sample();
  }
  EXPECT_LE((sum / SampleAverage::k_most).norm(), 0.125F);
}

TEST(SampleAverage, OneSampleIsThePictureItself) {
  Stage stage(box(3));
  const Target target(stage.gl, k_width, k_height, true);
  target.bind();
  stage.painter.paint(stage.camera, stage.sampling, 0, 0);
  EXPECT_EQ(stage.read(target), stage.mean(1));
}

TEST(SampleAverage, MoreSamplesComeNearerToWhatManyWithinAPixelShow) {
  const sculpt::Scene scene = box(3);
  Stage stage(scene);
  // Without wires, which are smooth in every sample.
  stage.painter.set_look(false, false);
  stage.options.wireframe = false;
  const Bytes one = stage.mean(1), four = stage.mean(4), eight = stage.mean(8);
  // Sixteen a pixel on a grid, as pictures off the screen have them.
  sculpt::PictureOptions options = stage.options;
  options.samples = 16;
  const sculpt::Picture fine = make_offscreen_renderer()->render(scene, options);
  Bytes wanted(fine.rgba.size());
  const std::size_t row = 4 * k_width;
  for (std::size_t y = 0; y < k_height; ++y)
    std::copy_n(fine.rgba.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                wanted.begin() + static_cast<std::ptrdiff_t>((k_height - 1 - y) * row));
  for (std::size_t i = 3; i < wanted.size(); i += 4) wanted[i] = 255;
  EXPECT_LT(difference(four, wanted), 0.6 * difference(one, wanted));
  EXPECT_LT(difference(eight, wanted), 0.85 * difference(four, wanted));
  EXPECT_LT(difference(eight, wanted), 2);  // of 255
}

TEST(SampleAverage, StartsAnewAndShowsTheSameAtAnyTime) {
  Stage stage(box(2));
  SampleAverage average(stage.gl, k_width, k_height);
  const Target shown(stage.gl, k_width, k_height, false);
  Bytes first;
  for (int round = 0; round < 2; ++round) {
    average.restart();
    for (int i = 0; i < 5; ++i) {
      const Camera shifted = average.shifted(stage.camera);
      average.begin_sample();
      stage.painter.paint(shifted, stage.sampling, 0, 0);
      // Whether what was drawn so far was looked at in between does not matter.
      if (round == 1) average.show(shown.framebuffer());
    }
    average.show(shown.framebuffer());
    if (round == 0)
      first = stage.read(shown);
    else
      EXPECT_LE(largest_difference(first, stage.read(shown)), 1);
  }
}

TEST(Wires, OnlyThoseThatNobodyWouldSeeAreLeftOut) {
  // Cells from 10 to less than 2 pixels wide.
  for (const int cells : {20, 60, 100}) {
    const sculpt::Scene scene = box(cells);
    Stage stage(scene);
    std::vector<Eigen::Vector3f> positions;
    for (const Eigen::Vector3f& position : scene.surface.positions) positions.push_back(stage.place(position));
    std::vector<std::array<Eigen::Vector3f, 2>> lines;
    for (const auto& ends : scene.surface.wire) lines.push_back({positions[ends[0]], positions[ends[1]]});
    VertexArray all(stage.gl);
    all.set(lines, k_line_attributes, 1);
    const ShapePainter shapes(stage.gl);
    Wires wires(stage.gl);
    wires.load(scene.surface, positions);
    const Colour tint{1, 1, 1, 0.4F};
    const auto picture = [&](bool those_seen) {
      const Target target(stage.gl, k_width, k_height, true);
      target.bind();
      stage.gl.Viewport(0, 0, k_width, k_height);
      stage.gl.ClearColor(0, 0, 0, 1);
      stage.gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      stage.gl.Disable(GL_DEPTH_TEST);
      stage.gl.Enable(GL_BLEND);
      stage.gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
      if (those_seen)
        wires.draw(shapes, stage.camera, stage.sampling, tint);
      else
        shapes.lines(all, stage.camera, stage.sampling, {tint, 0.5F, 22, 0.07F * 22});
      stage.gl.Disable(GL_BLEND);
      return stage.read(target);
    };
    // Where several that each round to nothing cross, it may be one or two levels.
    EXPECT_LE(largest_difference(picture(true), picture(false)), 2) << cells << " cells";
  }
}

TEST(ScenePainter, InAHurryLeavesOutFaintWiresAlone) {
  for (const int cells : {3, 60}) {
    Stage stage(box(cells));
    const auto picture = [&](bool wires, bool hurried) {
      stage.painter.set_look(wires, false);
      const Target target(stage.gl, k_width, k_height, true);
      target.bind();
      Sampling sampling = stage.sampling;
      sampling.hurried = hurried;
      stage.painter.paint(stage.camera, sampling, 0, 0);
      return stage.read(target);
    };
    // Along the outline, of some 600 pixels, backs and fronts meet; fronts win.
    const auto pixels_apart = [](const Bytes& a, const Bytes& b, int levels) {
      int count = 0;
      for (std::size_t i = 0; i < a.size(); i += 4)
        for (std::size_t k = i; k < i + 3; ++k)
          if (std::abs(int{a[k]} - int{b[k]}) > levels) {
            ++count;
            break;
          }
      return count;
    };
    EXPECT_LE(pixels_apart(picture(false, true), picture(false, false), 0), 20);
    EXPECT_LE(pixels_apart(picture(true, true), picture(true, false), cells == 3 ? 0 : 26), 20);
  }
}

TEST(SurfaceMesh, KnowsWhetherItIsClosed) {
  sculpt::SceneSurface surface = box(2).surface;
  EXPECT_TRUE(surface_mesh(surface, surface.positions).is_closed);
  const std::size_t last = surface.offsets[surface.offsets.size() - 2];
  surface.offsets.pop_back();
  surface.corners.resize(last);
  surface.cell_from_face.pop_back();
  EXPECT_FALSE(surface_mesh(surface, surface.positions).is_closed);
}

TEST(OpennessMeasure, TakesItsTimeOverLargeMeshesAndComesToTheSame) {
  const sculpt::Scene scene = box(120);
  std::vector<Eigen::Vector3f> positions;
  const Place place = place_of(scene.surface.positions);
  for (const Eigen::Vector3f& position : scene.surface.positions) positions.push_back(place(position));
  SurfaceMesh mesh = surface_mesh(scene.surface, positions), again = mesh;
  Stage stage(box(1));
  const Program depth(stage.gl, shaders::k_surface_vertex, shaders::k_depth_fragment);
  OpennessMeasure measure(stage.gl, depth);
  measure.begin(mesh);
  int frames = 0;
  for (; !measure.is_done(); ++frames) measure.look_on();
  EXPECT_GT(frames, 1);
  measure.write(mesh);
  measure.begin(again);
  while (!measure.is_done()) measure.look_on();
  measure.write(again);
  float lowest = 2, highest = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    ASSERT_EQ(mesh.vertices[i].openness, again.vertices[i].openness);
    lowest = std::min(lowest, mesh.vertices[i].openness);
    highest = std::max(highest, mesh.vertices[i].openness);
  }
  EXPECT_GT(lowest, 0.5F);  // a box has no hollows
  EXPECT_LE(highest, 1.01F);
}

TEST(SurfaceMesh, ItsSimpleTrianglesAreTheSameFacesWithoutMiddles) {
  sculpt::Scene scene = box(3);
  sculpt::SceneSurface& surface = scene.surface;
  surface.cut_faces.assign(surface.cell_from_face.size(), 0);
  surface.cut_faces[4] = surface.cut_faces[7] = 1;
  const SurfaceMesh mesh = surface_mesh(surface, surface.positions);
  ASSERT_EQ(mesh.simple_triangles.size(), 3 * 2 * surface.cell_from_face.size());
  Eigen::Vector3f area = Eigen::Vector3f::Zero();
  float whole = 0, fanned = 0;
  const auto cross = [&](const std::vector<std::uint32_t>& triangles, std::size_t t) -> Eigen::Vector3f {
    const auto at = [&](std::size_t k) { return mesh.vertices[triangles[3 * t + k]].position; };
    return (at(1) - at(0)).cross(at(2) - at(0));
  };
  for (std::size_t t = 0; 3 * t < mesh.simple_triangles.size(); ++t) {
    area += cross(mesh.simple_triangles, t);
    whole += cross(mesh.simple_triangles, t).norm();
    // All about a face point outwards as its normals do, and know whether it was cut.
    EXPECT_GT(cross(mesh.simple_triangles, t).dot(mesh.vertices[mesh.simple_triangles[3 * t]].normal), 0);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(mesh.vertices[mesh.simple_triangles[3 * t + k]].cut, surface.cut_faces[t / 2]);
  }
  for (std::size_t t = 0; 3 * t < mesh.triangles.size(); ++t) fanned += cross(mesh.triangles, t).norm();
  EXPECT_LE(area.norm(), 1e-5F);
  EXPECT_NEAR(whole, fanned, 1e-4F);
}

}  // namespace
}  // namespace argil::view
