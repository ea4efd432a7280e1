// `argil bench studio`: how long frames of the window take, and how long they wait for the simulation beside them.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>

#include "subdiv/error.h"
#include "tools/argil/program.h"
#include "tools/studio/offscreen.h"

namespace argil::tools {

namespace {

using argil::studio::Bench;
using argil::studio::Offscreen;
using argil::studio::OffscreenOptions;
using Clock = std::chrono::steady_clock;

constexpr int k_frames_before = 20;

double milliseconds(Clock::duration span) {
  return std::chrono::duration<double, std::milli>(span).count();
}

double part(std::vector<double> times, double share) {
  if (times.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1));
  std::nth_element(times.begin(), times.begin() + place, times.end());
  return times[static_cast<std::size_t>(place)];
}

OffscreenOptions options_of(const std::filesystem::path& out) {
  OffscreenOptions options;
  options.width = 1280;
  options.height = 720;
  options.card = false;
  options.bench.out = out;
  options.bench.clock = [] { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); };
  return options;
}

std::size_t triangles_of(const sculpt::SceneSurface& surface) {
  std::size_t triangles = 0;
  for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f)
    triangles += surface.offsets[f + 1] - surface.offsets[f] - 2;
  return triangles;
}

/// The whole frame, laid out and drawn, while the view turns.
void turn(const StudioBenchArguments& arguments) {
  Offscreen window(options_of(arguments.out / "turn"));
  window.workshop().run_together({"new box 40 40 1 size 1 1 0.1", "levels 2"});
  window.wait(3);
  const Clock::time_point loaded = Clock::now();
  window.draw();
  const double first = milliseconds(Clock::now() - loaded);
  (void)window.picture();
  std::vector<double> laid, drawn;
  window.move(120, 600);
  window.button(2, true);
  for (int i = -k_frames_before; i < arguments.frames; ++i) {
    const Clock::time_point start = Clock::now();
    window.move(120 + 2 * ((i + k_frames_before) % 300), 600);
    const Clock::time_point between = Clock::now();
    window.draw();
    const Clock::time_point end = Clock::now();
    window.took(std::chrono::duration<double>(end - start).count());
    if (i < 0) continue;  // the samples a pixel that frames can afford are found
    laid.push_back(milliseconds(between - start));
    drawn.push_back(milliseconds(end - between));
  }
  const double frame = part(laid, 0.5) + part(drawn, 0.5);
  fmt::print(
      "turning {} triangles at 1280x720: {:.1f} frames/s (laid out in {:.2f} ms, drawn in {:.1f} ms; p99 {:.1f} "
      "ms; "
      "the first picture {:.0f} ms)\n",
      triangles_of(window.now().scene->surface), 1e3 / frame, part(laid, 0.5), part(drawn, 0.5),
      part(laid, 0.99) + part(drawn, 0.99), first);
}

/// A stroke on the solid in real time: what a frame takes beside the simulation, and without it.
void stroke(const std::filesystem::path& file, const StudioBenchArguments& arguments) {
  OffscreenOptions options = options_of(arguments.out / file.stem());
  options.real_time = true;
  Offscreen window(options, file);
  window.wait(3);
  // A place on the solid: the middle one of a row of looks across the view.
  const Eigen::Vector2d middle =
      window.studio().viewport().camera().pixel(0.5 * (window.now().low + window.now().high));
  std::vector<Eigen::Vector2d> places;
  for (int i = -20; i <= 20; ++i)
    for (int k = -12; k <= 12; ++k) {
      const Eigen::Vector2d at = middle + Eigen::Vector2d(12 * i, 18 * k);
      window.move(at.x(), at.y());
      if (window.studio().desk().reading.there) places.push_back(at);
    }
  if (places.empty()) throw Error(ErrorCode::not_found, "nothing of " + file.string() + " is in view");
  const Eigen::Vector2d at = places[places.size() / 2];
  window.move(at.x(), at.y());
  std::vector<double> still, moving;
  const auto frame = [&](std::vector<double>& times, const Eigen::Vector2d& to) {
    const Clock::time_point start = Clock::now();
    window.move(to.x(), to.y());
    times.push_back(milliseconds(Clock::now() - start));
    std::this_thread::sleep_until(start + std::chrono::microseconds(16667));
  };
  for (int i = 0; i < arguments.frames / 4; ++i) frame(still, at);
  window.button(0, true);
  for (int i = 0; i < arguments.frames; ++i)
    frame(moving, at + 40 * Eigen::Vector2d(std::sin(0.05 * i), std::cos(0.07 * i) - 1));
  const double step = window.now().step_ms;
  const long steps = window.now().steps;
  // The same with every frame drawn, beside the simulation on the same processors.
  std::vector<double> drawn;
  for (int i = 0; i < arguments.frames / 2; ++i) {
    const Clock::time_point start = Clock::now();
    window.move(at.x() + 40 * std::sin(0.05 * i), at.y() + 40 * (std::cos(0.07 * i) - 1));
    window.draw();
    drawn.push_back(milliseconds(Clock::now() - start));
    std::this_thread::sleep_until(start + std::chrono::microseconds(16667));
    window.took(std::chrono::duration<double>(Clock::now() - start).count());
  }
  window.button(0, false);
  fmt::print("{:<15} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.1f} {:>12.1f} {:>7}\n", file.stem().string(), part(still, 0.5),
             part(moving, 0.5), part(moving, 0.99), part(drawn, 0.5), step, steps);
}

}  // namespace

int bench_studio(const StudioBenchArguments& arguments) {
  std::vector<std::filesystem::path> files;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(arguments.folder, failure))
    if (entry.path().extension() == ".argil") files.push_back(entry.path());
  if (files.empty())
    throw Error(ErrorCode::not_found, "expected a folder of sessions, found none in '" + arguments.folder.string() +
                                          "'; samples/models is one");
  std::sort(files.begin(), files.end());
  // As a window has it: as many threads draw as there are processors.
  setenv("LP_NUM_THREADS", std::to_string(std::thread::hardware_concurrency()).c_str(), 0);
  turn(arguments);
  fmt::print("\na stroke at 60 frames/s, the simulation beside it\n{:<15} {:>9} {:>9} {:>9} {:>9} {:>12} {:>7}\n",
             "frame [ms]", "still", "stroke", "its p99", "drawn", "a step [ms]", "steps");
  for (const auto& file : files) stroke(file, arguments);
  return k_well;
}

}  // namespace argil::tools
