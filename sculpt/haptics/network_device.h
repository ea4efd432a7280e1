#pragma once
// A device on another machine, or in another program: a host beside the device runs its servo and sends samples,
// the program sends contact models (device_packets.h). Each end is driven once a tick, by any clock.
//
//   program: NetworkDevice ── contact models ──► DeviceHost: servo ── forces ──► Device
//                          ◄──── samples ───────                   ◄── poses ───

#include "sculpt/haptics/datagrams.h"
#include "sculpt/haptics/device_packets.h"
#include "sculpt/haptics/servo.h"

namespace argil::sculpt {

/// Of two ends: which packets count. Older ones than the newest, and those of another run while the present one is
/// heard, do not.
class PacketOrder {
 public:
  /// Whether a packet that arrives at `now` is the newest.
  bool accept(const Packet& packet, Tick now);
  Tick silent_since(Tick now) const { return heard_ ? now - last_ : now; }
  bool heard() const { return heard_; }
  std::uint64_t lost() const { return lost_; }  // never came, or came too late

 private:
  static constexpr Tick k_run_is_over = 1000;  // of silence

  std::uint64_t session_ = 0, sequence_ = 0, lost_ = 0;
  Tick last_ = 0;
  bool heard_ = false;
};

/// The program's end. Its samples have the ticks of their arrival here: how long they took nobody knows.
class NetworkDevice : public Device {
 public:
  /// The link must outlive it. `session` tells this run from others. Poses silent for longer than `patience`
  /// [ticks] make the device `closed` until it is heard again.
  NetworkDevice(DatagramLink& link, std::uint64_t session, Tick patience = 500);

  DeviceCapabilities capabilities() const override;
  bool takes_models() const override { return true; }
  /// Sends it at once; in the device's frame (mapping.h), `valid_until` in this end's ticks.
  void publish(const ContactModel& model, Tick now) override;
  /// The command is not used: forces are made by the host's servo.
  DeviceSample exchange(const ForceCommand& command, Tick tick) override;

  const Eigen::Vector3d& applied_force() const { return force_; }  // as last told [N]
  std::uint64_t lost() const { return order_.lost(); }

 private:
  DatagramLink& link_;
  std::uint64_t session_, sequence_ = 0;
  Tick patience_, answers_ = 0;
  PacketOrder order_;
  DeviceSample sample_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

/// The device's end.
class DeviceHost {
 public:
  /// Both must outlive it.
  DeviceHost(Device& device, DatagramLink& link, std::uint64_t session, const ServoOptions& options = {});

  /// Call once a tick: takes the models that have arrived, serves the device, sends its sample. Neither waits nor
  /// allocates.
  ServoTick tick(Tick now);
  Servo& servo() { return servo_; }

 private:
  static constexpr Tick k_oldest_answer = 500;  // ticks; a model about an older pose is not used

  DatagramLink& link_;
  std::uint64_t session_, sequence_ = 0;
  PacketOrder order_;
  ContactChannel channel_;
  Servo servo_;
};

}  // namespace argil::sculpt
