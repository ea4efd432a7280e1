#pragma once
// The studio on a display, by GLFW: real time, the simulation in its own thread.

#include <filesystem>
#include <functional>

#include "tools/studio/bench.h"
#include "tools/studio/hand.h"
#include "tools/studio/input.h"

namespace argil::studio {

struct WindowOptions {
  BenchOptions bench;
  DeviceShop devices;
  std::string device = "mouse";
  std::filesystem::path file;  // empty: a block
  /// Tells what a pen does now, in the input of a frame; it must not wait. Null: there are no pens.
  std::function<void(Input&)> read_pen{};
};

/// Runs until the window is closed. @throws Error (unsupported) where there is no display or no OpenGL 3.3.
void run_window(const WindowOptions& options);

}  // namespace argil::studio
