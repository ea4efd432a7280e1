#pragma once
// The solid in the window: drawn, looked at from all sides, touched. What the pointer does there becomes orders of
// the workshop; what is only looked at (camera, brush under the pointer) stays here.

#include <memory>
#include <optional>

#include "sculpt/haptics/mouse_device.h"
#include "tools/studio/desk.h"
#include "tools/studio/input.h"
#include "tools/studio/picking.h"
#include "tools/studio/sample_pace.h"
#include "tools/studio/select_mode.h"
#include "tools/view/overlay_painter.h"
#include "tools/view/sample_average.h"
#include "tools/view/scene_painter.h"

namespace argil::studio {

class Viewport {
 public:
  explicit Viewport(const view::Gl& gl);

  /// The window in pixels and its part that no panel covers.
  void camera_window(int width, int height, const Rect& free) { camera_.set_window(width, height, free); }
  /// Keys of the camera and the brush. True if it was one of them.
  bool perform(Desk& desk, Action action);
  void key_released(Desk& desk, int key);
  /// The pointer, wheel and buttons; `over_ui`: a control has them.
  void handle(Desk& desk, const Input& input, bool control, bool shift, bool over_ui);
  /// Takes what the snapshot has new to the graphics card and draws into the framebuffer of this name.
  void draw(const Desk& desk, const Input& input, unsigned framebuffer);
  /// False while drawing the same again would show it smoother or better shaded.
  bool is_finished() const {
    return average_ && !hurried_ && average_->count() == view::SampleAverage::k_most && painter_.is_shaded();
  }
  /// What lies over the picture: numbers at the arrow, the plane's handle, why a tool cannot act.
  void draw_marks(Desk& desk);

  const OrbitCamera& camera() const { return camera_; }
  const SelectMode& select_mode() const { return select_; }
  bool is_busy() const { return drag_ != Drag::none; }

 private:
  enum class Drag { none, stroke, handle, choose, amount, orbit, pan, plane, radius, strength };
  bool press_on_plane(Desk& desk);
  bool press_in_select_mode(Desk& desk, const Input& input);
  bool press_on_curve(Desk& desk, const Input& input);
  void update_overlay(const Desk& desk);
  void press(Desk& desk, const Input& input, bool control, bool shift);
  void drag(Desk& desk, const Input& input, bool shift);
  void release(Desk& desk);
  void cancel(Desk& desk);
  void move_device(Desk& desk, const Input& input);
  void move_plane(Desk& desk, double distance);
  void update_hover(Desk& desk, bool over_ui);
  void take_hold(const Eigen::Vector3d& at);
  Box box_of(const Snapshot& now) const;

  const view::Gl* gl_;
  view::ScenePainter painter_;
  view::OverlayPainter overlay_;
  std::vector<std::uint64_t> overlaid_;  // all that the overlay depends on
  bool overlay_changed_ = true;
  std::uint64_t overlaid_version_ = 0;
  SelectMode select_;
  std::size_t handle_ = 0;            // of the curve, while it is drawn
  bool right_armed_ = false;          // it may be a click
  double right_x_ = 0, right_y_ = 0;  // where the right button went down
  std::unique_ptr<view::SampleAverage> average_;
  SamplePace pace_;
  bool hurried_ = false;  // what the average holds
  view::Place place_;
  OrbitCamera camera_;
  std::uint64_t layout_ = 0, version_ = 0;
  std::uint64_t framed_solid_ = 0;  // the one that the camera was last placed for
  std::shared_ptr<const sculpt::Scene> loaded_;
  std::vector<float> drawn_;  // all that the picture depends on but for the scene
  bool scene_changed_ = true;

  std::optional<Hit> hover_;
  Drag drag_ = Drag::none;
  double x_ = 0, y_ = 0, last_x_ = 0, last_y_ = 0, pressed_x_ = 0, pressed_y_ = 0;
  bool left_ = false, middle_ = false, right_ = false;
  bool inverts_ = false;
  double pressure_ = 1;  // of the pen, in the last frame
  // A stroke.
  Eigen::Vector3d grip_ = Eigen::Vector3d::Zero(), device_ = grip_;
  sculpt::MouseDevice mouse_;
  // The brush while it is sized.
  double brush_start_ = 0, brush_now_ = 0;
};

}  // namespace argil::studio
