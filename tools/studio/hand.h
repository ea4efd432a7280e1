#pragma once
// A device other than the mouse in the sculptor's hand: its servo, and what it does in the world. In real time a
// thread of its own serves it once a millisecond, beside the simulation; in virtual time whoever advances it does.

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "sculpt/haptics/servo.h"

namespace argil::studio {

/// Devices that the program offers to the window, which knows none itself.
struct DeviceChoice {
  std::string name, summary, state;  // `state`: what was found, or how to get it
  bool present = false;
  bool opens = true;  // by its name alone
};
struct DeviceShop {
  std::function<std::vector<DeviceChoice>()> list;
  /// @throws Error where there is none of this name now.
  std::function<std::shared_ptr<sculpt::Device>(const std::string& name)> open;
};

/// In world coordinates.
struct HandSample {
  sculpt::DevicePose pose;
  double pressure = 1;
  std::uint32_t buttons = 0;
  sculpt::DeviceMode mode = sculpt::DeviceMode::closed;
  sculpt::Tick now = 0;                             // of the servo
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // on the hand, through the safety chain [N]
};

class Hand {
 public:
  Hand(std::string name, std::shared_ptr<sculpt::Device> device);
  ~Hand();
  Hand(const Hand&) = delete;
  Hand& operator=(const Hand&) = delete;

  const std::string& name() const { return name_; }
  sculpt::DeviceCapabilities capabilities() const { return device_->capabilities(); }
  sculpt::Tick missed() const { return missed_.load(); }

  // Of the one thread that owns the hand.
  /// What the device should feel from now on, in the world.
  void publish(const sculpt::ContactModel& model) { models_.publish(model); }
  /// Where the device's frame is in the world from the next tick on.
  void place(const sculpt::WorldFromDevice& mapping) { mappings_.publish(mapping); }
  /// The newest sample; null before the first.
  [[nodiscard]] const HandSample* latest() { return samples_.latest(); }

  /// Real time.
  void start();
  /// Virtual time: one tick on the caller's thread.
  void tick();

 private:
  void serve(sculpt::Tick now);

  std::string name_;
  std::shared_ptr<sculpt::Device> device_;
  sculpt::ContactChannel to_servo_;
  sculpt::Servo servo_;
  sculpt::LatestChannel<sculpt::ContactModel> models_;
  sculpt::LatestChannel<sculpt::WorldFromDevice> mappings_;
  sculpt::LatestChannel<HandSample> samples_;
  sculpt::WorldFromDevice mapping_;  // the servo's
  std::atomic<sculpt::Tick> missed_{0};
  std::atomic<bool> ends_{false};
  sculpt::Tick now_ = 0;
  std::thread thread_;
};

/// The mapping that lays the device's workspace over a ball of the world as it is seen along `view` (from the eye):
/// the device's x to the right, y away from the viewer, z up, its middle in the ball's middle.
[[nodiscard]] sculpt::WorldFromDevice mapping_over(const sculpt::DeviceCapabilities& device,
                                                   const Eigen::Vector3d& middle, double radius,
                                                   const Eigen::Vector3d& view);

}  // namespace argil::studio
