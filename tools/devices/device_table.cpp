#include "tools/devices/device_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <limits>
#include <random>
#include <thread>

#include "sculpt/haptics/clock.h"
#include "sculpt/haptics/mouse_device.h"
#include "sculpt/haptics/network_device.h"
#include "sculpt/haptics/scripted_device.h"
#include "sculpt/haptics/servo.h"
#include "sculpt/haptics/simulated_hand.h"
#include "subdiv/error.h"
#include "tools/devices/gamepad.h"
#include "tools/devices/pen.h"
#include "tools/devices/space_mouse.h"

namespace argil::devices {

using sculpt::DevicePose;
using sculpt::ScriptedDevice;
using sculpt::Tick;

namespace {

DevicePose at_height(double z) {
  DevicePose pose;
  pose.position.z() = z;
  return pose;
}

/// Down to 5 mm below zero and up again, over and over for an hour.
ScriptedDevice pressing() {
  std::vector<sculpt::PoseSegment> segments;
  for (int i = 0; i < 1800; ++i) {
    segments.push_back({at_height(0.01), at_height(-0.005), 1000, sculpt::Ease::smooth});
    segments.push_back({at_height(-0.005), at_height(0.01), 1000, sculpt::Ease::smooth});
  }
  return ScriptedDevice(std::move(segments));
}

class OwnedHand : public OwnedDevice {
 public:
  sculpt::Device& device() override { return hand_; }

 private:
  ScriptedDevice intention_ = pressing();
  sculpt::SimulatedHand hand_{intention_};
};

class OwnedRates : public OwnedDevice {
 public:
  explicit OwnedRates(std::unique_ptr<sculpt::RateSource> source) : source_(std::move(source)), device_(*source_) {}
  sculpt::Device& device() override { return device_; }

 private:
  std::unique_ptr<sculpt::RateSource> source_;
  sculpt::RateDevice device_;
};

/// "ADDRESS:PORT".
sculpt::UdpAddress address_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  unsigned port = 0;
  const char* const end = text.data() + text.size();
  if (colon == std::string::npos || colon == 0 || std::from_chars(text.data() + colon + 1, end, port).ptr != end ||
      port == 0 || port > 65535)
    throw Error(ErrorCode::bad_input,
                fmt::format("expected an address and a port such as 127.0.0.1:4711, found '{}'; `argil devices "
                            "--serve NAME` on the machine with the device says them",
                            text));
  return {text.substr(0, colon), static_cast<std::uint16_t>(port)};
}

class OwnedNetwork : public OwnedDevice {
 public:
  explicit OwnedNetwork(const sculpt::UdpAddress& there)
      : link_(sculpt::open_udp({there.host.starts_with("127.") ? "127.0.0.1" : "0.0.0.0", 0}, there)),
        device_(*link_, (std::uint64_t{std::random_device()()} << 32) | std::random_device()()) {}
  sculpt::Device& device() override { return device_; }

 private:
  std::unique_ptr<sculpt::DatagramLink> link_;
  sculpt::NetworkDevice device_;
};

class NoSource : public sculpt::RateSource {
 public:
  std::optional<sculpt::RateInput> poll() override { return std::nullopt; }
  void rumble(double) override {}
};

DeviceEntry gamepad_entry() {
  DeviceEntry entry{.name = "gamepad", .summary = "sticks steer it, it rumbles by the force"};
  NoSource none;
  entry.capabilities = sculpt::RateDevice(none).capabilities();
  if (!gamepads_supported()) {
    entry.state = "not in this build; install libsdl2-dev and build again";
    return entry;
  }
  try {
    entry.state = gamepad_name();
    entry.present = !entry.state.empty();
    if (!entry.present) entry.state = "none is plugged in";
  } catch (const Error& error) {
    entry.state = error.what();
  }
  return entry;
}

DeviceEntry space_mouse_entry() {
  DeviceEntry entry{.name = "space_mouse", .summary = "a 3D mouse by spacenavd"};
  NoSource none;
  entry.capabilities = sculpt::RateDevice(none).capabilities();
  entry.present = space_mice_supported() && space_mouse_present();
  entry.state = entry.present            ? "spacenavd answers"
                : space_mice_supported() ? "spacenavd does not answer; install it (package spacenavd) and start it"
                                         : "not in this build; install libspnav-dev and build again";
  return entry;
}

double part(std::vector<double>& times, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1));
  std::nth_element(times.begin(), times.begin() + place, times.end());
  return times[static_cast<std::size_t>(place)];
}

}  // namespace

std::vector<DeviceEntry> list_devices() {
  std::vector<DeviceEntry> entries;
  const sculpt::DeviceCapabilities pen = sculpt::MouseDevice().capabilities();
  sculpt::DeviceCapabilities mouse = pen;
  mouse.senses_pressure = false;
  entries.push_back(
      {"mouse", "the ray under the pointer and the wheel; force is drawn", true, "always there", mouse});
  const PensFound pens = find_pens();
  entries.push_back({"pen", "as the mouse; its pressure scales the brush, its eraser inverts", pens.present,
                     pens.state, pen, false});
  entries.push_back(
      {"scripted", "follows the path of a session's stroke", true, "always there", pressing().capabilities()});
  entries.push_back({"hand", "a simulated hand on a path, which feels the force", true, "always there",
                     OwnedHand().device().capabilities()});
  entries.push_back(gamepad_entry());
  entries.push_back(space_mouse_entry());
  sculpt::SimulatedNetwork network({});
  entries.push_back({"network", "a device beside its own servo, by UDP", true,
                     "`argil devices --serve NAME` on the machine that has the device; then "
                     "`argil studio --device \"network ADDRESS:PORT\"`",
                     sculpt::NetworkDevice(network.end(0), 0).capabilities(), false});
  return entries;
}

std::unique_ptr<OwnedDevice> open_device(const std::string& name) {
  if (name == "hand") return std::make_unique<OwnedHand>();
  if (name == "gamepad") return std::make_unique<OwnedRates>(open_gamepad());
  if (name.starts_with("network ")) return std::make_unique<OwnedNetwork>(address_of(name.substr(8)));
  if (name == "space_mouse") return std::make_unique<OwnedRates>(open_space_mouse());
  if (name == "pen")
    throw Error(ErrorCode::not_found,
                "a pen is no device of its own: where there is one it goes with the mouse; leave --device out");
  throw Error(ErrorCode::not_found, fmt::format("expected hand, gamepad, space_mouse or `network ADDRESS:PORT`, "
                                                "found \"{}\"; `argil devices` lists what is there",
                                                name));
}

TickBench bench_ticks(double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto microseconds = [](Clock::duration span) {
    return std::chrono::duration<double, std::micro>(span).count();
  };
  ScriptedDevice intention = pressing();
  sculpt::SimulatedHand hand(intention);
  sculpt::ContactChannel channel;
  sculpt::ContactModel floor;
  floor.plane_count = 1;
  floor.planes[0] = {Eigen::Vector3d::UnitZ(), 0, 1000};
  floor.valid_until = std::numeric_limits<Tick>::max() / 2;
  channel.publish(floor);
  sculpt::Servo servo(hand, channel);

  const auto count = static_cast<Tick>(seconds / sculpt::k_tick_seconds);
  std::vector<double> late, work;
  late.reserve(static_cast<std::size_t>(count));
  work.reserve(static_cast<std::size_t>(count));
  const Clock::time_point start = Clock::now();
  for (Tick due = 1; due <= count;) {
    const Clock::time_point at = start + std::chrono::milliseconds(due);
    std::this_thread::sleep_until(at);
    const Clock::time_point begin = Clock::now();
    (void)servo.tick(due);
    const Clock::time_point end = Clock::now();
    late.push_back(microseconds(begin - at));
    work.push_back(microseconds(end - begin));
    // The next one that is not yet due.
    due = std::max(due, static_cast<Tick>(microseconds(end - start) / 1000)) + 1;
  }
  TickBench bench;
  bench.ticks = static_cast<long>(late.size());
  bench.missed = static_cast<long>(servo.missed());
  if (late.empty()) return bench;
  bench.late_p50 = part(late, 0.5);
  bench.late_p99 = part(late, 0.99);
  bench.late_most = part(late, 1);
  bench.work_p50 = part(work, 0.5);
  bench.work_p99 = part(work, 0.99);
  bench.work_most = part(work, 1);
  return bench;
}

}  // namespace argil::devices
