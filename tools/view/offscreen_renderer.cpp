#include "tools/view/offscreen_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "subdiv/error.h"
#include "tools/view/legend.h"
#include "tools/view/scene_painter.h"
#include "tools/view/volume_rays.h"

namespace argil::view {

namespace {

constexpr double k_framed_obstacle = 2;       // radii of the body
constexpr int k_largest = 4096;               // width or height of a picture
constexpr int k_samples_at_once = 4'000'000;  // a picture is drawn in strips of about so many samples

bool has_extent(const std::vector<Eigen::Vector3f>& places) {
  bool differ = false;
  for (const Eigen::Vector3f& place : places) {
    if (!place.allFinite()) return false;
    differ = differ || place != places.front();
  }
  return differ;
}

void check(const sculpt::PictureOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > k_largest || options.height > k_largest)
    throw Error(
        ErrorCode::bad_input,
        fmt::format("expected a picture of 1 x 1 to {0} x {0} pixels, found {1} x {2}; choose a size within",
                    k_largest, options.width, options.height));
  if (options.samples != 1 && options.samples != 4 && options.samples != 9 && options.samples != 16)
    throw Error(ErrorCode::bad_input,
                fmt::format("expected 1, 4, 9 or 16 samples a pixel, found {}; 4 is usual", options.samples));
  if (!(options.zoom >= 0.01 && options.zoom <= 1000))
    throw Error(
        ErrorCode::bad_input,
        fmt::format("expected a zoom between 0.01 and 1000, found {}; 1 shows the whole scene", options.zoom));
  if (options.frame && !has_extent(options.frame->places))
    throw Error(ErrorCode::bad_input,
                "expected a frame with two different finite places, found none; give it as six numbers such as "
                "0 0 0 1 1 1");
  if (!options.view_from.allFinite() || !(options.view_from.norm() > 1e-100) || options.view_from.norm() > 1e100)
    throw Error(
        ErrorCode::bad_input,
        fmt::format("expected a direction to look from, found {} {} {}; give three numbers such as 1 -1.6 0.9",
                    options.view_from.x(), options.view_from.y(), options.view_from.z()));
}

void check_volume(const sculpt::SceneVolume& volume, bool has_legend) {
  if (!has_legend)
    throw Error(ErrorCode::bad_input,
                "expected a legend with the volume, found none; it says what the colours mean");
  if (!(volume.opacity > 0 && std::isfinite(volume.opacity)))
    throw Error(ErrorCode::bad_input,
                fmt::format("expected an opacity above 0, found {}; 1 is usual", volume.opacity));
  for (std::size_t i = 0; i < volume.positions.size(); ++i)
    if (!volume.positions[i].allFinite() || !std::isfinite(volume.values[i]))
      throw Error(ErrorCode::bad_geometry,
                  "expected finite places and values to draw, found one that is not; undo to the last good state",
                  fmt::format("point {} of the volume", i));
}

/// Every place of the scene that must be seen; all are checked.
std::vector<Eigen::Vector3f> places(const sculpt::Scene& scene) {
  std::vector<Eigen::Vector3f> all;
  const auto add = [&](const Eigen::Vector3f& position, const char* what, std::size_t i) {
    if (!position.allFinite())
      throw Error(ErrorCode::bad_geometry,
                  "expected finite coordinates to draw, found one that is not; undo to the last good state",
                  fmt::format("{} {}", what, i));
    all.push_back(position);
  };
  for (std::size_t i = 0; i < scene.surface.positions.size(); ++i)
    add(scene.surface.positions[i], "surface vertex", i);
  for (std::size_t i = 0; i < scene.cage_lines.size(); ++i)
    for (const Eigen::Vector3f& end : scene.cage_lines[i]) add(end, "cage line", i);
  for (std::size_t i = 0; i < scene.cage_points.size(); ++i) add(scene.cage_points[i], "cage point", i);
  for (std::size_t i = 0; i < scene.arrows.size(); ++i)
    for (const Eigen::Vector3f& end : {scene.arrows[i].from, scene.arrows[i].to}) add(end, "arrow", i);
  for (std::size_t i = 0; i < scene.handles.size(); ++i) add(scene.handles[i], "handle", i);
  for (std::size_t i = 0; i < scene.pins.size(); ++i) add(scene.pins[i], "pin", i);
  for (std::size_t i = 0; i < scene.lines.size(); ++i)
    for (const auto& ends : scene.lines[i].lines)
      for (const Eigen::Vector3f& end : ends) add(end, "line of set", i);
  // Obstacles that are much larger than the body would leave little of it to see.
  const std::size_t framed = all.size();
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    for (const Eigen::Vector3f& position : scene.obstacles[i].surface.positions) add(position, "obstacle", i);
    const std::vector<Eigen::Vector3f> body(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(framed));
    if (scene.obstacles[i].is_ground ||
        place_of(scene.obstacles[i].surface.positions).radius > k_framed_obstacle * place_of(body).radius)
      all.resize(all.size() - scene.obstacles[i].surface.positions.size());
  }
  if (scene.volume) check_volume(*scene.volume, scene.legend.has_value());
  for (std::size_t i = 0; i < scene.labels.size(); ++i) add(scene.labels[i].at, "label", i);
  for (std::size_t i = 0; i < scene.surface.values.size(); ++i)
    if (!std::isfinite(scene.surface.values[i]))
      throw Error(ErrorCode::bad_geometry, "expected finite field values to draw, found one that is not",
                  fmt::format("surface vertex {}", i));
  if (scene.legend && !(std::isfinite(scene.legend->low) && std::isfinite(scene.legend->high)))
    throw Error(ErrorCode::bad_geometry, "expected a finite range of the legend, found " +
                                             fmt::format("{} to {}", scene.legend->low, scene.legend->high));
  return all;
}

class OffscreenRenderer final : public sculpt::Renderer {
 public:
  explicit OffscreenRenderer(std::span<const char* const> library_names)
      : context_(library_names), painter_(context_.gl()) {}

  sculpt::Picture render(const sculpt::Scene& scene, const sculpt::PictureOptions& options) override {
    check(options);
    std::vector<Eigen::Vector3f> positions = places(scene);
    const std::vector<Eigen::Vector3f> framed = options.frame ? options.frame->places : positions;
    if (options.frame) positions.insert(positions.end(), framed.begin(), framed.end());
    const Place place = place_of(positions);
    positions = framed;
    for (Eigen::Vector3f& position : positions) position = place(position);

    const float small =
        std::min(static_cast<float>(options.width) / 1280, static_cast<float>(options.height) / 800);
    const float pixel = std::clamp(small, 0.75F, 5.0F);
    const bool has_room = options.width >= 160 && options.height >= 120;  // for legend and key
    const bool has_legend = scene.legend && has_room;
    // A frame that leaves no room says itself what must be seen.
    const bool leaves_room = !options.frame || options.frame->leaves_room;
    Margins free = leaves_room ? margins(scene, options, pixel, has_legend) : Margins{};
    if (has_room && leaves_room) free.right = std::max(free.right, key_width(scene, font_, pixel, options.width));
    const Camera camera = framing_camera(positions, options, free);

    options.progress.at(0);
    context_.make_current();
    painter_.load(scene, place, options);
    while (!painter_.is_shaded()) painter_.shade_on();
    options.progress.at(0.3);
    if (scene.volume)
      painter_.set_volume(
          volume_picture(*scene.volume, *scene.legend, place, camera, options.width, options.height), options.width,
          options.height);
    const Sampling sampling{options.width, options.height,
                            static_cast<int>(std::lround(std::sqrt(options.samples))), pixel};
    sculpt::Picture picture;
    picture.width = options.width;
    picture.height = options.height;
    draw(camera, sampling, picture, options.progress.part(0.3, 0.9));
    picture.cell_ids = draw_words(camera, sampling, &ScenePainter::paint_ids);

    Canvas canvas(picture, font_);
    const Theme& theme = options.light_theme ? k_light_theme : k_dark_theme;
    if (!scene.labels.empty()) {
      const std::vector<std::uint32_t> depths = draw_words(camera, sampling, &ScenePainter::paint_depth);
      for (const sculpt::SceneLabel& label : scene.labels) {
        const Eigen::Vector3f at = place(label.at);
        const Eigen::Vector2f pixel_at = camera.pixel(at, picture.width, picture.height);
        draw_label(canvas, pixel_at, label.text, theme, pixel, picture.width,
                   is_hidden(camera, at, pixel_at, depths, sampling));
      }
    }
    if (has_room && !options.title.empty()) draw_title(canvas, options.title, theme, pixel);
    if (has_room && scene.felt) draw_felt(canvas, *scene.felt, theme, pixel, picture.height);
    if (has_legend) draw_legend(canvas, *scene.legend, theme, pixel, picture.width, picture.height);
    if (has_room) draw_key(canvas, scene, theme, pixel, picture.width, picture.height);
    return picture;
  }

 private:
  Margins margins(const sculpt::Scene& scene, const sculpt::PictureOptions& options, float pixel,
                  bool has_legend) const {
    Margins free;
    const double pixel_x = static_cast<double>(pixel) / options.width,
                 pixel_y = static_cast<double>(pixel) / options.height;
    // What comes and goes from one picture of a frame to the next must not move the eye.
    const bool framed = options.frame.has_value();
    if (has_legend) {
      sculpt::SceneLegend legend = *scene.legend;
      if (framed && legend.names.empty()) legend.names = {"-0.0000 k" + legend.unit};  // its widest number
      free.right = std::max(free.right, legend_width(legend, font_, pixel, options.width));
    }
    if (framed || !scene.arrows.empty() || !scene.cage_points.empty()) {
      free.left += 8 * pixel_x;
      free.right += 8 * pixel_x;
      free.top += 8 * pixel_y;
    }
    if (framed || !scene.pins.empty()) free.bottom += 18 * pixel_y;
    if (!options.title.empty()) free.top += 30 * pixel_y;
    if (scene.felt) free.bottom += 30 * pixel_y;
    return free;
  }

  /// In strips from the bottom, each averaged over the samples of a pixel.
  void draw(const Camera& camera, const Sampling& sampling, sculpt::Picture& picture, const Progress& progress) {
    const int factor = sampling.factor, columns = sampling.width * factor;
    const int rows = std::clamp(k_samples_at_once / (columns * factor), 1, sampling.height);
    const Target strip(context_.gl(), columns, rows * factor, true);
    picture.rgba.resize(4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    std::vector<std::uint8_t> samples;
    for (int bottom = 0; bottom < sampling.height; bottom += rows) {
      const int height = std::min(rows, sampling.height - bottom);
      progress.at(static_cast<double>(bottom) / sampling.height);
      strip.bind();
      painter_.paint(camera, sampling, 0, bottom * factor);
      strip.read(columns, height * factor, samples);
      for (int row = 0; row < height; ++row) {
        const int y = picture.height - 1 - bottom - row;
        for (int x = 0; x < picture.width; ++x)
          average(samples, columns, x, row, factor,
                  &picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                     static_cast<std::size_t>(x))]);
      }
    }
  }

  static void average(const std::vector<std::uint8_t>& samples, int columns, int x, int row, int factor,
                      std::uint8_t* pixel) {
    std::array<int, 3> sum{};
    for (int j = 0; j < factor; ++j)
      for (int i = 0; i < factor; ++i) {
        const std::uint8_t* sample =
            &samples[4 * (static_cast<std::size_t>(row * factor + j) * static_cast<std::size_t>(columns) +
                          static_cast<std::size_t>(x * factor + i))];
        for (std::size_t k = 0; k < 3; ++k) sum[k] += sample[k];
      }
    const int count = factor * factor;
    for (std::size_t k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>((sum[k] + count / 2) / count);
    pixel[3] = 255;
  }

  using PaintBytes = void (ScenePainter::*)(const Camera&, const Sampling&, int, int) const;

  /// Draws without antialiasing and reads each pixel's four bytes as a number, lowest byte first; top row first.
  std::vector<std::uint32_t> draw_words(const Camera& camera, Sampling sampling, PaintBytes paint) {
    sampling.factor = 1;
    const int rows = std::clamp(k_samples_at_once / sampling.width, 1, sampling.height);
    const Target strip(context_.gl(), sampling.width, rows, true);
    std::vector<std::uint32_t> words(static_cast<std::size_t>(sampling.width) *
                                     static_cast<std::size_t>(sampling.height));
    std::vector<std::uint8_t> bytes;
    for (int bottom = 0; bottom < sampling.height; bottom += rows) {
      const int height = std::min(rows, sampling.height - bottom);
      strip.bind();
      (painter_.*paint)(camera, sampling, 0, bottom);
      strip.read(sampling.width, height, bytes);
      for (int row = 0; row < height; ++row) {
        std::uint32_t* target = &words[static_cast<std::size_t>(sampling.height - 1 - bottom - row) *
                                       static_cast<std::size_t>(sampling.width)];
        const std::uint8_t* b = &bytes[4 * static_cast<std::size_t>(row * sampling.width)];
        for (int x = 0; x < sampling.width; ++x, b += 4)
          *target++ = static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8U |
                      static_cast<std::uint32_t>(b[2]) << 16U | static_cast<std::uint32_t>(b[3]) << 24U;
      }
    }
    return words;
  }

  /// Whether the surface hides a place: it lies nearer in all pixels about it, by more than a hundredth of the
  /// scene.
  static bool is_hidden(const Camera& camera, const Eigen::Vector3f& at, const Eigen::Vector2f& pixel,
                        const std::vector<std::uint32_t>& depths, const Sampling& sampling) {
    const Eigen::Vector3f nearer = at + 0.01F * (camera.eye - at).normalized();
    const Eigen::Vector4f clip = camera.clip_from_world * nearer.homogeneous();
    const float depth = 0.5F + 0.5F * clip.z() / clip.w();
    const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
    for (int j = y - 1; j <= y + 1; ++j)
      for (int i = x - 1; i <= x + 1; ++i) {
        if (i < 0 || j < 0 || i >= sampling.width || j >= sampling.height) return false;
        const std::uint32_t word = depths[static_cast<std::size_t>(j) * static_cast<std::size_t>(sampling.width) +
                                          static_cast<std::size_t>(i)];
        if (static_cast<float>(word & 0xffffffU) / 16777215.0F >= depth) return false;
      }
    return true;
  }

  OsmesaContext context_;
  ScenePainter painter_;
  Font font_;
};

}  // namespace

std::unique_ptr<sculpt::Renderer> make_offscreen_renderer(std::span<const char* const> library_names) {
  return std::make_unique<OffscreenRenderer>(library_names);
}

}  // namespace argil::view
