#pragma once
// One tick of the force loop, at 1 kHz: the newest contact model, evaluated where the device is, through the safety
// chain, to the device.

#include "sculpt/haptics/contact_model.h"
#include "sculpt/haptics/mapping.h"
#include "sculpt/haptics/safety.h"

namespace argil::sculpt {

struct ServoOptions {
  SafetyLimits limits;
  WorldFromDevice world_from_device;
  Tick command_life = 10;  // ticks that a command holds for if the servo falls silent
  /// Ticks in which the force fades, in a line, once the model's time is over, and those in which it comes back
  /// with a new one: a simulation that stalls lets go gently, and does not throw a hand out of what it sank into.
  Tick fade = 100, comeback = 800;
  /// A pose older than this gets no force: the passivity observer sees only poses, so what a late one pumps it
  /// cannot count. At 1000 N/m and 5 ticks late that is 66 mJ a press.
  Tick max_sample_age = 2;
};

struct ServoTick {
  DeviceSample sample;                               // after the exchange
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();  // in the device's frame, before the safety chain [N]
  SafetyReport safety;
  bool model_valid = false;  // in time, not fading
};

class Servo {
 public:
  /// Both must outlive the servo; it is the reader of the channel.
  Servo(Device& device, ContactChannel& channel, const ServoOptions& options = {});

  /// Call once a tick, in ascending order; ticks may be missed.
  ServoTick tick(Tick now);

  SafetyChain& safety() { return safety_; }
  void set_mapping(const WorldFromDevice& mapping) { options_.world_from_device = mapping; }
  /// Ticks that were not served, since the start.
  Tick missed() const { return missed_; }

 private:
  double next_share(const ContactModel* model, Tick now) const;

  Device& device_;
  ContactChannel& channel_;
  ServoOptions options_;
  SafetyChain safety_;
  DeviceSample sample_;
  double share_ = 1;  // of the model's force that is let through
  Tick last_ = 0, missed_ = 0;
  bool started_ = false;
};

}  // namespace argil::sculpt
