#include "tools/devices/gamepad.h"

#include "subdiv/error.h"

#ifdef ARGIL_HAS_SDL2

#define SDL_MAIN_HANDLED
#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>

namespace argil::devices {

namespace {

/// SDL's own state is global; whoever uses it holds one of these.
class Sdl {
 public:
  Sdl() {
    SDL_SetMainReady();
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    if (SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER) != 0)
      throw Error(
          ErrorCode::unsupported,
          fmt::format("SDL does not start: {}; use the mouse, or mend the system's input devices", SDL_GetError()));
  }
  ~Sdl() { SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER); }
  Sdl(const Sdl&) = delete;
  Sdl& operator=(const Sdl&) = delete;
};

int first_controller() {
  SDL_GameControllerUpdate();
  for (int i = 0; i < SDL_NumJoysticks(); ++i)
    if (SDL_IsGameController(i)) return i;
  return -1;
}

double axis(SDL_GameController* pad, SDL_GameControllerAxis which) {
  return std::clamp(SDL_GameControllerGetAxis(pad, which) / 32767.0, -1.0, 1.0);
}

class Gamepad : public sculpt::RateSource {
 public:
  ~Gamepad() override { close(); }

  std::optional<sculpt::RateInput> poll() override {
    SDL_GameControllerUpdate();
    if (pad_ != nullptr && !SDL_GameControllerGetAttached(pad_)) close();
    if (pad_ == nullptr && since_look_++ % k_polls_between_looks == 0)
      if (const int index = first_controller(); index >= 0) pad_ = SDL_GameControllerOpen(index);
    if (pad_ == nullptr) return std::nullopt;
    sculpt::RateInput input;
    input.axes = {axis(pad_, SDL_CONTROLLER_AXIS_LEFTX),
                  -axis(pad_, SDL_CONTROLLER_AXIS_LEFTY),  // SDL's y points down
                  axis(pad_, SDL_CONTROLLER_AXIS_TRIGGERRIGHT) - axis(pad_, SDL_CONTROLLER_AXIS_TRIGGERLEFT),
                  axis(pad_, SDL_CONTROLLER_AXIS_RIGHTY),
                  axis(pad_, SDL_CONTROLLER_AXIS_RIGHTX),
                  0};
    for (int i = 0; i < SDL_CONTROLLER_BUTTON_MAX; ++i)
      if (SDL_GameControllerGetButton(pad_, static_cast<SDL_GameControllerButton>(i)))
        input.buttons |= std::uint32_t{1} << i;
    return input;
  }

  void rumble(double share) override {
    // A message to the pad takes longer than a tick: only what can be felt to differ, and before it runs out.
    const auto strength = static_cast<std::uint16_t>(65535 * std::clamp(share, 0.0, 1.0));
    if (pad_ == nullptr) return;
    const bool same = std::abs(strength - last_strength_) < 1024 && (strength == 0) == (last_strength_ == 0);
    if (same && ++since_rumble_ < k_rumble_ms / 2) return;
    SDL_GameControllerRumble(pad_, strength, strength, k_rumble_ms);
    last_strength_ = strength;
    since_rumble_ = 0;
  }

 private:
  static constexpr int k_polls_between_looks = 500, k_rumble_ms = 100;

  void close() {
    if (pad_ != nullptr) SDL_GameControllerClose(pad_);
    pad_ = nullptr;
  }

  Sdl sdl_;
  SDL_GameController* pad_ = nullptr;
  int since_look_ = 0, last_strength_ = 0, since_rumble_ = 0;
};

}  // namespace

bool gamepads_supported() {
  return true;
}

std::string gamepad_name() {
  const Sdl sdl;
  const int index = first_controller();
  const char* const name = index < 0 ? nullptr : SDL_GameControllerNameForIndex(index);
  return name == nullptr ? "" : name;
}

std::unique_ptr<sculpt::RateSource> open_gamepad() {
  return std::make_unique<Gamepad>();
}

}  // namespace argil::devices

#else

namespace argil::devices {

bool gamepads_supported() {
  return false;
}

std::string gamepad_name() {
  return {};
}

std::unique_ptr<sculpt::RateSource> open_gamepad() {
  throw Error(ErrorCode::unsupported,
              "this build has no gamepads; install libsdl2-dev and build again, or use "
              "the mouse");
}

}  // namespace argil::devices

#endif
