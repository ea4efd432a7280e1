// The gamepad by a virtual one of SDL's own, so that nothing need be plugged in.

#include "tools/devices/gamepad.h"

#include <gtest/gtest.h>

#include "tools/devices/device_table.h"

#ifdef ARGIL_TEST_SDL2
#define SDL_MAIN_HANDLED
#include <SDL.h>
#endif

namespace argil::devices {
namespace {

TEST(Devices, TheMouseIsThereAndWhatIsMissingSaysWhy) {
  const std::vector<DeviceEntry> entries = list_devices();
  ASSERT_FALSE(entries.empty());
  EXPECT_EQ(entries[0].name, "mouse");
  EXPECT_TRUE(entries[0].present);
  for (const DeviceEntry& entry : entries) {
    EXPECT_FALSE(entry.state.empty()) << entry.name;
    EXPECT_FALSE(entry.summary.empty()) << entry.name;
  }
}

#ifdef ARGIL_TEST_SDL2
TEST(Gamepad, SticksButtonsAndUnplugging) {
  SDL_SetMainReady();
  ASSERT_EQ(SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER), 0) << SDL_GetError();
  {
    const std::unique_ptr<sculpt::RateSource> source = open_gamepad();
    if (!gamepad_name().empty()) GTEST_SKIP() << "a real one is plugged in";
    EXPECT_FALSE(source->poll().has_value());
    const int index = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_GAMECONTROLLER, SDL_CONTROLLER_AXIS_MAX,
                                                SDL_CONTROLLER_BUTTON_MAX, 0);
    ASSERT_GE(index, 0) << SDL_GetError();
    if (!SDL_IsGameController(index)) {
      SDL_JoystickDetachVirtual(index);
      SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
      GTEST_SKIP() << "this SDL does not map virtual joysticks";
    }
    EXPECT_FALSE(gamepad_name().empty());
    std::optional<sculpt::RateInput> input;
    for (int poll = 0; poll < 1000 && !input; ++poll) input = source->poll();  // it looks now and then
    ASSERT_TRUE(input.has_value());
    SDL_Joystick* const stick = SDL_JoystickOpen(index);
    SDL_JoystickSetVirtualAxis(stick, SDL_CONTROLLER_AXIS_LEFTX, 32767);
    SDL_JoystickSetVirtualAxis(stick, SDL_CONTROLLER_AXIS_LEFTY, 32767);
    SDL_JoystickSetVirtualButton(stick, SDL_CONTROLLER_BUTTON_B, 1);
    SDL_GameControllerUpdate();
    input = source->poll();
    ASSERT_TRUE(input.has_value());
    EXPECT_EQ(input->axes[0], 1);
    EXPECT_EQ(input->axes[1], -1);
    EXPECT_EQ(input->buttons, 2u);
    source->rumble(0.5);  // a virtual pad cannot; nothing happens
    SDL_JoystickClose(stick);
    SDL_JoystickDetachVirtual(index);
    EXPECT_FALSE(source->poll().has_value());
  }
  SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
}
#endif

}  // namespace
}  // namespace argil::devices
