#pragma once
// The studio without a display: drawn through OSMesa, moved by a script of what a hand would do, in virtual time.
// The frame is the very one of the window.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sculpt/renderer.h"
#include "tools/studio/studio.h"
#include "tools/view/osmesa_context.h"

namespace argil::studio {

struct OffscreenOptions {
  int width = 1280, height = 800;  // in units of the layout
  float scale = 1;
  BenchOptions bench;
  DeviceShop devices;
  bool card = true;
  bool real_time = false;  // the simulation in its own thread, as in a window
};

class Offscreen {
 public:
  /// Opens on `file`, or on a block where there is none. @throws Error (unsupported) where there is no OSMesa.
  explicit Offscreen(const OffscreenOptions& options, const std::filesystem::path& file = {});
  ~Offscreen();

  // Coordinates in units of the layout. Each is one frame or more of a sixtieth of a second.
  void wait(int frames = 1);
  void move(double x, double y);
  void button(int which, bool down);  // 0 left, 1 right, 2 middle
  /// A pen pressed so hard, 0 … 1, or by its other end; what moves the pointer then is the pen. 1: as a mouse.
  void pen(double pressure, bool eraser = false);
  void wheel(double notches);
  void key(int key, bool down);
  /// All within one frame.
  void together(const std::vector<KeyEvent>& events);
  /// "Ctrl-Z", pressed and let go, with its modifiers.
  void press(const std::string& chord);
  void type(const std::string& text);
  void click(double x, double y);
  void drag(double x0, double y0, double x1, double y1, int frames, int which = 0);
  /// The middle of a control of the last frame. @throws Error (not_found) that lists their names.
  void click(const std::string& control);
  /// Without any wait: the next frames see another size.
  void resize(int width, int height, float scale);

  /// The time that the next frames take the one before them to have needed, in place of a sixtieth [s].
  void took(double seconds) { input_.seconds = seconds; }
  /// Draws the last frame and waits until it is drawn.
  void draw();
  /// What the last frame shows. Only these draw: other frames are laid out, and seen by nobody.
  [[nodiscard]] sculpt::Picture picture();
  Studio& studio() { return *studio_; }
  Workshop& workshop() { return *workshop_; }
  const Snapshot& now() const { return *workshop_->latest(); }
  int frames() const { return frames_; }

 private:
  void frame();

  OffscreenOptions options_;
  view::OsmesaContext context_;
  std::unique_ptr<Workshop> workshop_;
  std::unique_ptr<view::Target> target_;
  std::unique_ptr<Studio> studio_;
  Input input_;
  int frames_ = 0;
};

}  // namespace argil::studio
