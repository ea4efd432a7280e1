#include <cstdio>
#include <cstdlib>

#include <chrono>

#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tools/argil/program.h"
#include "tools/devices/device_table.h"
#include "tools/devices/pen.h"
#include "tools/studio/script.h"
#include "tools/studio/window.h"
#include "tools/view/film.h"
#include "tools/view/offscreen_renderer.h"

namespace argil::tools {

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::filesystem::path settings_folder() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder != '\0')
    return std::filesystem::path(folder) / "argil";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::filesystem::path(home) / ".config" / "argil";
  return {};
}

argil::studio::DeviceShop device_shop() {
  argil::studio::DeviceShop shop;
  shop.list = [] {
    std::vector<argil::studio::DeviceChoice> choices;
    for (const devices::DeviceEntry& entry : devices::list_devices())
      if (entry.name != "scripted")
        choices.push_back({entry.name, entry.summary, entry.state, entry.present, entry.opens});
    return choices;
  };
  shop.open = [](const std::string& name) {
    const std::shared_ptr<devices::OwnedDevice> owned = devices::open_device(name);
    return std::shared_ptr<sculpt::Device>(owned, &owned->device());
  };
  return shop;
}

std::function<void(argil::studio::Input&)> pen_input(devices::PenReader* pens) {
  if (pens == nullptr) return nullptr;
  return [pens](argil::studio::Input& input) {
    const devices::PenState pen = pens->state();
    input.has_pen = pen.plugged;
    input.pressure = pen.pressure;
    input.eraser = pen.eraser;
  };
}

std::string make_film(const argil::studio::FilmOrder& order, const Progress::Listener& progress) {
  MovieArguments arguments;
  arguments.session = order.out / "journal.argil";
  arguments.read_root = order.read_root;
  arguments.out = order.out;
  const bool has_ffmpeg = view::can_write_films();
  arguments.file =
      (order.turntable ? std::string("turntable") : std::string("film")) + (has_ffmpeg ? ".mp4" : ".png");
  arguments.turntable = order.turntable;
  const std::string file = make_movie(arguments, order.session, progress).file.string();
  return has_ffmpeg ? "the film is " + file : "there is no ffmpeg; its pictures are numbered beside " + file;
}

// Beside an installed program, else where it was built from.
std::filesystem::path samples_folder() {
  std::error_code failure;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failure);
  const std::filesystem::path installed = program.parent_path().parent_path() / "share" / "argil" / "samples";
  return std::filesystem::is_directory(installed, failure) ? installed : std::filesystem::path(ARGIL_SAMPLES);
}

}  // namespace

int studio(const StudioArguments& arguments) {
  if (!arguments.file.empty() && !std::filesystem::is_regular_file(arguments.file))
    throw Error(ErrorCode::bad_input, "expected a session or a mesh to open, found no file '" +
                                          arguments.file.string() + "'; leave it out for a new block");
  argil::studio::BenchOptions bench;
  bench.out = arguments.out;
  bench.limits = arguments.limits;
  bench.clock = seconds;
  bench.samples = samples_folder();
  bench.film = make_film;
  if (arguments.script.empty()) {
    bench.settings = settings_folder();
    const std::unique_ptr<devices::PenReader> pens = devices::open_pens();
    argil::studio::run_window({bench, device_shop(), arguments.device, arguments.file, pen_input(pens.get())});
    return k_well;
  }
  const std::string script = io::read_file(arguments.script);
  argil::studio::OffscreenOptions options;
  options.bench = bench;
  options.bench.save_root = arguments.out;
  options.devices = device_shop();
  argil::studio::Offscreen window(options, arguments.file);
  const auto result = argil::studio::run_script(script, arguments.script.string(), window, arguments.out,
                                                [](const std::string& line) { std::printf("%s\n", line.c_str()); });
  return result.failed == 0 ? k_well : k_expectation_failed;
}

}  // namespace argil::tools
