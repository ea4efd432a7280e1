#pragma once
// Selecting and editing by pointing: what the pointer and the keys of select mode do becomes lines of the session;
// a tool that has been taken is shown as a ghost until it is done or dropped.

#include "tools/studio/desk.h"
#include "tools/studio/orbit_camera.h"
#include "tools/studio/picking.h"

namespace argil::studio {

class SelectMode {
 public:
  /// To be called each frame: takes the tool that waits for select mode, and asks for the ghost again where the
  /// document has changed under it.
  void advance(Desk& desk, const OrbitCamera& camera, double x, double y);
  /// What lies under the pointer, if anything; sets desk.pointed.
  void hover(Desk& desk, const std::optional<Hit>& hit) const;
  /// Keys of select mode and of the tools that edit. True if it was one of them.
  bool perform(Desk& desk, const OrbitCamera& camera, Action action, double x, double y);
  /// Esc: drops what is pending, else the selection, else leaves select mode. False if there was nothing of it.
  bool cancel(Desk& desk);

  void press(const Desk& desk, double x, double y);
  /// Takes the face under the pointer to be drawn out by it. False where there is none.
  bool take_face(Desk& desk, const OrbitCamera& camera, double x, double y);
  /// A click, or a box if the pointer went far enough.
  void release(Desk& desk, const OrbitCamera& camera, double x, double y, bool control, bool shift);
  /// The pointer gives the amount of what is pending.
  void follow(Desk& desk, const OrbitCamera& camera, double x, double y, bool fine) const;
  /// True if the wheel was for what is pending.
  bool wheel(Desk& desk, double notches) const;
  void commit(Desk& desk) const;
  /// Asks for the ghost of what is pending now.
  void show_pending(const Desk& desk) const;

  [[nodiscard]] std::optional<ScreenBox> box(const Desk& desk, double x, double y) const;
  void drop_box() { pressed_.reset(); }

 private:
  void click(Desk& desk, bool control, bool shift);
  void begin(Desk& desk, const OrbitCamera& camera, const EditTool& tool, double x, double y);
  static void aim(const Desk& desk, const OrbitCamera& camera, const sculpt::Selection& acted,
                  PendingEdit& pending);

  const EditTool* waiting_ = nullptr;  // a tool for which the snapshot does not yet say what lies where
  std::optional<Eigen::Vector2d> pressed_;
  std::optional<std::uint32_t> pressed_on_;
  // The last click, to know a double one.
  double clicked_at_ = -1;
  std::optional<std::uint32_t> clicked_;
};

/// The line that selects by numbers, as `select faces ids 3 7 add`.
[[nodiscard]] std::string select_line(sculpt::ElementType type, const std::vector<std::uint32_t>& ids,
                                      const char* how = "");

/// The panel of select mode: what is selected, what can be done with it, named sets.
void draw_select_panel(Desk& desk, float x, float width, const std::function<void(Action)>& perform);
/// The amount of what is pending with its counts, over the view.
void draw_pending(Desk& desk, const Rect& free, const SelectMode& mode);
/// What can be done with what is selected, at the pointer.
void draw_context_menu(Desk& desk, const std::function<void(Action)>& perform);

}  // namespace argil::studio
