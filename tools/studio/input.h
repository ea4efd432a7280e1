#pragma once
// What came in since the last frame, from a window or from a script.

#include <cstdint>
#include <filesystem>
#include <vector>

namespace argil::studio {

struct KeyEvent {
  int key = 0;  // keys.h
  bool down = false;
};

struct Input {
  double seconds = 1.0 / 60;       // since the last frame
  int width = 1280, height = 800;  // [pixels]
  float scale = 1;                 // pixels a unit of the layout
  float x = -1, y = -1;            // of the pointer, from the top left
  bool buttons[3] = {};            // left, right, middle
  float wheel = 0;
  // Of a pen, if there is one: 0 … 1, and 1 while the mouse moves the pointer; whether its other end is down.
  bool has_pen = false, eraser = false;
  double pressure = 1;
  std::vector<KeyEvent> keys;
  std::vector<std::uint32_t> characters;
  std::vector<std::filesystem::path> dropped;
};

}  // namespace argil::studio
