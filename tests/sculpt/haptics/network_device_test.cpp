#include "sculpt/haptics/network_device.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdio>
#include <limits>
#include <random>

#include "sculpt/haptics/fault_injector.h"
#include "sculpt/haptics/recorded_device.h"
#include "sculpt/haptics/scripted_device.h"
#include "sculpt/haptics/simulated_hand.h"
#include "subdiv/error.h"

namespace argil::sculpt {
namespace {

using Eigen::Vector3d;

DevicePose at(double z) {
  return {Vector3d(0, 0, z), Eigen::Quaterniond::Identity()};
}

ContactModel floor_model(Tick valid_until) {
  ContactModel model;
  model.planes[0] = {Vector3d::UnitZ(), 0, 1000};
  model.plane_count = 1;
  model.valid_until = valid_until;
  return model;
}

Packet some_model() {
  ModelPacket body{41, floor_model(50)};
  body.model.point = Vector3d(0.1, -2, 3e-9);
  body.model.force = Vector3d(-1, 2, 0.5);
  body.model.derivative << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  return {7, 8, body};
}

Packet some_sample() {
  SamplePacket body;
  body.sample = {{Vector3d(1, 2, 3), Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)}, 5, -3, DeviceMode::force};
  body.force = Vector3d(0, 0, 1.5);
  return {1u << 31, std::uint64_t{1} << 60, body};
}

TEST(DevicePackets, ComeBackAsTheyWere) {
  PacketBytes bytes;
  const std::optional<Packet> model =
      read_packet(std::span<const std::byte>(bytes).first(write_packet(some_model(), bytes)));
  ASSERT_TRUE(model.has_value());
  const auto& read = std::get<ModelPacket>(model->body);
  EXPECT_EQ(model->session, 7u);
  EXPECT_EQ(model->sequence, 8u);
  EXPECT_EQ(read.answers, 41);
  EXPECT_EQ(read.model.valid_until, 50);
  EXPECT_EQ(read.model.point, Vector3d(0.1, -2, 3e-9));
  EXPECT_EQ(read.model.derivative(1, 2), 6);
  EXPECT_EQ(read.model.plane_count, 1u);
  EXPECT_EQ(read.model.planes[0].stiffness, 1000);
  const std::optional<Packet> sample =
      read_packet(std::span<const std::byte>(bytes).first(write_packet(some_sample(), bytes)));
  ASSERT_TRUE(sample.has_value());
  const auto& pose = std::get<SamplePacket>(sample->body);
  EXPECT_EQ(pose.sample.tick, -3);
  EXPECT_EQ(pose.sample.buttons, 5u);
  EXPECT_EQ(pose.sample.pose.orientation.y(), -0.5);
  EXPECT_EQ(pose.force.z(), 1.5);
  EXPECT_EQ(sample->sequence, std::uint64_t{1} << 60);
}

TEST(DevicePackets, EveryOtherLengthAndEveryWrongNumberIsRefused) {
  for (const Packet& packet : {some_model(), some_sample()}) {
    PacketBytes bytes{};
    const std::size_t size = write_packet(packet, bytes);
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_EQ(read_packet(std::span<const std::byte>(bytes).first(length)).has_value(), length == size) << length;
    // Another magic, version or kind.
    for (const std::size_t place : {0, 4, 6}) {
      PacketBytes other = bytes;
      other[place] ^= std::byte{0x40};
      EXPECT_FALSE(read_packet(std::span<const std::byte>(other).first(size)).has_value());
    }
  }
  Packet wrong = some_model();
  auto& model = std::get<ModelPacket>(wrong.body).model;
  const auto refused = [&] {
    PacketBytes bytes;
    return !read_packet(std::span<const std::byte>(bytes).first(write_packet(wrong, bytes))).has_value();
  };
  EXPECT_FALSE(refused());
  model.planes[0].stiffness = -1;
  EXPECT_TRUE(refused());
  model.planes[0].stiffness = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(refused());
  model.planes[0].stiffness = 1;
  model.planes[0].normal = Vector3d(0, 0, 2);
  EXPECT_TRUE(refused());
  model.planes[0].normal = Vector3d(0, 1, 0);
  model.force.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused());
}

TEST(DevicePackets, SpoiltOnesAreRefusedOrWhole) {
  std::mt19937_64 random(3);
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    PacketBytes bytes{};
    const std::size_t size = write_packet(i % 2 ? some_model() : some_sample(), bytes);
    for (int k = 0; k < 1 + i % 4; ++k) bytes[random() % size] = static_cast<std::byte>(random());
    const std::optional<Packet> packet =
        read_packet(std::span<const std::byte>(bytes).first(random() % 8 ? size : random() % 1200));
    if (!packet) continue;
    ++read;
    if (const auto* model = std::get_if<ModelPacket>(&packet->body)) {
      EXPECT_LE(model->model.plane_count, ContactModel::k_max_planes);
      EXPECT_TRUE(model->model.force.allFinite());
    }
  }
  EXPECT_GT(read, 1000);  // most spoilt bytes are digits of a number
}

TEST(Udp, LoopbackCarriesDatagramsAndStrangersAreNotHeard) {
  const std::unique_ptr<DatagramLink> host = open_udp({"127.0.0.1", 0}, std::nullopt);
  const UdpAddress host_address{"127.0.0.1", port_of(*host)};
  const std::unique_ptr<DatagramLink> program = open_udp({"127.0.0.1", 0}, host_address);
  const std::unique_ptr<DatagramLink> stranger = open_udp({"127.0.0.1", 0}, host_address);
  const std::array<std::byte, 3> words{std::byte{1}, std::byte{2}, std::byte{3}};
  std::array<std::byte, 8> heard{};
  EXPECT_FALSE(host->send(words));  // to whom?
  EXPECT_EQ(host->receive(heard), std::nullopt);
  EXPECT_TRUE(program->send(words));
  ASSERT_EQ(host->receive(heard), 3u);
  EXPECT_EQ(heard[2], std::byte{3});
  EXPECT_TRUE(stranger->send(words));
  EXPECT_EQ(host->receive(heard), std::nullopt);
  EXPECT_TRUE(host->send(words));
  EXPECT_EQ(program->receive(heard), 3u);
  EXPECT_THROW((void)open_udp({"127.0.0.1", host_address.port}, std::nullopt), Error);
  EXPECT_THROW((void)open_udp({"localhost", 0}, std::nullopt), Error);
}

TEST(NetworkDevice, SamplesComeThroughAndOldOnesDoNot) {
  SimulatedNetwork network({.delay = 5, .jitter = 5});
  ScriptedDevice script({{at(0), at(1), 1000}});
  DeviceHost host(script, network.end(0), 1);
  NetworkDevice device(network.end(1), 2);
  double last = -1;
  for (Tick t = 0; t <= 1000; ++t) {
    network.advance(t);
    (void)host.tick(t);
    const DeviceSample sample = device.exchange({}, t);
    if (t == 0) {
      EXPECT_EQ(sample.mode, DeviceMode::closed);
    }
    if (t > 10) {
      EXPECT_EQ(sample.mode, DeviceMode::idle);
      EXPECT_GE(sample.pose.position.z(), last);  // never back in time
      EXPECT_NEAR(sample.pose.position.z(), 1e-3 * static_cast<double>(t), 10.5e-3);
      last = sample.pose.position.z();
    }
  }
  EXPECT_GT(device.lost(), 0u);  // those that others overtook
  for (Tick t = 1001; t < 1600; ++t) {
    network.advance(t);
    EXPECT_EQ(device.exchange({}, t).mode == DeviceMode::closed,
              t > 1010 + 500 || t - device.exchange({}, t).tick > 500)
        << t;
  }
}

TEST(NetworkDevice, ARestartedHostIsHeardOnceTheOldOneIsSilent) {
  SimulatedNetwork network({});
  ScriptedDevice script({{at(0), at(0), 1}});
  NetworkDevice device(network.end(1), 2);
  {
    DeviceHost host(script, network.end(0), 10);
    for (Tick t = 0; t < 100; ++t) {
      network.advance(t);
      (void)host.tick(t);
      EXPECT_EQ(device.exchange({}, t).mode, DeviceMode::idle);
    }
  }
  DeviceHost again(script, network.end(0), 11);
  for (Tick t = 100; t < 2000; ++t) {
    network.advance(t);
    (void)again.tick(t - 100);
    const bool closed = device.exchange({}, t).mode == DeviceMode::closed;
    EXPECT_EQ(closed, t > 599 && t < 1099) << t;
  }
}

/// A hand presses 1 cm deep on a floor of 1000 N/m for some seconds; the simulation, 60 steps a second, is at the
/// other end of a network with delay, loss and a cut.
struct Press {
  double largest_step = 0, most_work = 0, largest_force = 0, force_in_cut = 0, force_after = 0;
};

Press press_over(const NetworkWeather& weather) {
  SimulatedNetwork network(weather);
  ScriptedDevice intention({{at(0.005), at(-0.01), 1000, Ease::smooth},
                            {at(-0.01), at(-0.01), 4000},
                            {at(-0.01), at(0.02), 1000, Ease::smooth}});
  SimulatedHand hand(intention);
  DeviceHost host(hand, network.end(0), 1);
  NetworkDevice device(network.end(1), 2);
  Press press;
  Vector3d last = Vector3d::Zero();
  for (Tick t = 0; t <= 6000; ++t) {
    network.advance(t);
    const DeviceSample seen = device.exchange({}, t);
    if (t * 60 / 1000 != (t - 1) * 60 / 1000 && seen.mode != DeviceMode::closed)
      device.publish(floor_model(t + 50), t);
    const Vector3d force = host.tick(t).safety.force;
    press.largest_step = std::max(press.largest_step, (force - last).norm());
    press.largest_force = std::max(press.largest_force, force.norm());
    press.most_work = std::max(press.most_work, hand.work_received());
    // The last model that was sent before the cut arrives a delay later.
    if (t > weather.cut_first + weather.delay + weather.jitter + 150 && t <= weather.cut_last)
      press.force_in_cut = std::max(press.force_in_cut, force.norm());
    if (t == 3500 + 1400) press.force_after = force.norm();
    last = force;
  }
  return press;
}

TEST(NetworkDevice, DelayLossAndACutKeepThePressPassiveAndGentle) {
  Press worst;
  worst.force_after = 1e9;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Press press =
        press_over({.delay = 20, .jitter = 10, .loss = 0.05, .cut_first = 2500, .cut_last = 3500, .seed = seed});
    // Springs in series: 1 cm · 200 · 1000 / 1200 N/m.
    EXPECT_GT(press.largest_force, 1.5);
    EXPECT_LE(press.largest_step, 0.12) << seed;
    EXPECT_LE(press.most_work, 0.05e-3) << seed;
    EXPECT_LT(press.force_in_cut, 0.01);
    // The wall comes back as far as the hand's own work pays for: 1 cm in, it takes more to lift the hand to where
    // it stood than the hand gave while it sank.
    EXPECT_GT(press.force_after, 0.8);
    worst.largest_step = std::max(worst.largest_step, press.largest_step);
    worst.most_work = std::max(worst.most_work, press.most_work);
    worst.force_after = std::min(worst.force_after, press.force_after);
  }
  std::printf("press over 40 networks: step %.4f N/ms, work %.4f mJ at most; %.3f N after the cut at least\n",
              worst.largest_step, 1e3 * worst.most_work, worst.force_after);
}

TEST(NetworkDevice, ModelsGoThroughWhatWrapsIt) {
  SimulatedNetwork network({});
  NetworkDevice device(network.end(1), 2);
  FaultInjector faulty(device, {{DeviceFault::drop, 10, 20}});
  DeviceRecorder recorder(faulty);
  ASSERT_TRUE(recorder.takes_models());
  PacketBytes bytes;
  for (const auto& [tick, arrives] :
       {std::pair{Tick{9}, true}, std::pair{Tick{10}, false}, std::pair{Tick{21}, true}}) {
    network.advance(tick);
    recorder.publish(floor_model(tick + 50), tick);
    EXPECT_EQ(network.end(0).receive(bytes).has_value(), arrives) << tick;
  }
}

TEST(Mapping, AModelInTheDevicesFrameGivesTheForceThatIsFelt) {
  WorldFromDevice mapping;
  mapping.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()));
  mapping.scale = 3;
  mapping.translation = Vector3d(0.2, -0.1, 0.4);
  mapping.force_scale = 0.25;
  ContactModel world = std::get<ModelPacket>(some_model().body).model;
  world.planes[0] = {Vector3d(1, 1, 0).normalized(), 2, 300};
  const Vector3d at_device(0.03, 0.1, -0.2);
  const Vector3d felt = contact_force(mapping.device_model(world), at_device);
  const Vector3d expected = mapping.device_force(contact_force(world, mapping.position(at_device)));
  EXPECT_LT((felt - expected).norm(), 1e-12 * expected.norm());  // rounding of sums
}

}  // namespace
}  // namespace argil::sculpt
