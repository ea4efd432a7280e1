#pragma once
// One frame of the studio after another: input in, the window drawn. The same frame runs in a GLFW window and on
// OSMesa.

#include <array>
#include <memory>
#include <vector>

#include "tools/studio/chrome.h"
#include "tools/studio/input.h"
#include "tools/studio/viewport.h"

struct ImGuiContext;

namespace argil::studio {

class UiRenderer;

struct StudioOptions {
  float scale = 1;
  bool virtual_clock = false;
  bool card = true;
  std::string keys;      // of the sculptor; lines as in Bindings::read
  std::string settings;  // lines as in settings_file.h
};

class Studio {
 public:
  /// `gl` and `workshop` must outlive it; gl is current whenever a function is called.
  /// @throws Error (bad_input) for faulty keys.
  Studio(const view::Gl& gl, Workshop& workshop, const StudioOptions& options);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  /// Takes what came in and lays the window out. It runs no command and waits for none.
  void frame(const Input& input);
  /// Draws what the last frame laid out into the framebuffer of this name.
  void draw(unsigned framebuffer);
  void perform(Action action);
  bool quits() const { return desk_.quits; }
  /// Whether a picture of the view was asked for since the last call.
  bool takes_picture() { return std::exchange(desk_.takes_picture, false); }

  const Desk& desk() const { return desk_; }
  Desk& desk() { return desk_; }
  const Ui& ui() const { return *ui_; }
  const Viewport& viewport() const { return *viewport_; }

 private:
  void take_input(const Input& input);
  void take_keys(const Input& input);
  void follow_modifiers(const KeyEvent& event);

  Workshop* workshop_;
  ImGuiContext* context_;
  std::unique_ptr<Ui> ui_;
  std::unique_ptr<UiRenderer> renderer_;
  std::unique_ptr<Viewport> viewport_;
  Desk desk_;
  Input input_;                   // of the last frame
  std::vector<int> let_go_late_;  // keys, with the next frame
  bool control_ = false, shift_ = false, alt_ = false;
  std::array<bool, 3> controls_before_{};  // those at the beginning of the frame
};

}  // namespace argil::studio
