#include "tools/devices/space_mouse.h"

#include "subdiv/error.h"

#ifdef ARGIL_HAS_SPNAV

#include <spnav.h>

namespace argil::devices {

namespace {

class SpaceMouse : public sculpt::RateSource {
 public:
  SpaceMouse() {
    if (spnav_open() != 0)
      throw Error(ErrorCode::unsupported,
                  "no 3D mouse: spacenavd does not answer; start it (package spacenavd) and plug the mouse in");
  }
  ~SpaceMouse() override { spnav_close(); }
  SpaceMouse(const SpaceMouse&) = delete;
  SpaceMouse& operator=(const SpaceMouse&) = delete;

  std::optional<sculpt::RateInput> poll() override {
    spnav_event event;
    for (int i = 0; i < 64 && spnav_poll_event(&event) != 0; ++i) {
      if (event.type == SPNAV_EVENT_MOTION) {
        const spnav_event_motion& motion = event.motion;
        // The driver's z points away from the viewer; 350 is full deflection.
        const int raw[6] = {motion.x, motion.y, -motion.z, motion.rx, motion.ry, -motion.rz};
        for (std::size_t axis = 0; axis < 6; ++axis) input_.axes[axis] = raw[axis] / 350.0;
      } else if (event.type == SPNAV_EVENT_BUTTON && event.button.bnum >= 0 && event.button.bnum < 32) {
        const std::uint32_t bit = std::uint32_t{1} << event.button.bnum;
        input_.buttons = event.button.press ? input_.buttons | bit : input_.buttons & ~bit;
      }
    }
    return input_;
  }
  void rumble(double) override {}

 private:
  sculpt::RateInput input_;
};

}  // namespace

bool space_mice_supported() {
  return true;
}

bool space_mouse_present() {
  if (spnav_open() != 0) return false;
  spnav_close();
  return true;
}

std::unique_ptr<sculpt::RateSource> open_space_mouse() {
  return std::make_unique<SpaceMouse>();
}

}  // namespace argil::devices

#else

namespace argil::devices {

bool space_mice_supported() {
  return false;
}

bool space_mouse_present() {
  return false;
}

std::unique_ptr<sculpt::RateSource> open_space_mouse() {
  throw Error(ErrorCode::unsupported,
              "this build has no 3D mice; install libspnav-dev and build again, or use "
              "the mouse");
}

}  // namespace argil::devices

#endif
