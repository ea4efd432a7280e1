// A tick of the servo neither allocates nor locks. This program replaces the allocator's and the mutex's doors by
// ones that count, so it is one of its own.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <cstdlib>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

#include "sculpt/haptics/fault_injector.h"
#include "sculpt/haptics/mouse_device.h"
#include "sculpt/haptics/network_device.h"
#include "sculpt/haptics/scripted_device.h"
#include "sculpt/haptics/servo.h"
#include "sculpt/haptics/simulated_hand.h"

namespace {
thread_local bool counting = false;
thread_local long allocations = 0, locks = 0;

// Not inlined, or the compiler compares malloc here with what another place frees.
[[gnu::noinline]] void* take(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  void* const place = alignment == 0
                          ? std::malloc(size == 0 ? 1 : size)
                          : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (place == nullptr) throw std::bad_alloc();
  return place;
}
[[gnu::noinline]] void give_back(void* place) {
  if (counting) ++allocations;
  std::free(place);
}
}  // namespace

void* operator new(std::size_t size) {
  return take(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* place) noexcept {
  give_back(place);
}
void operator delete(void* place, std::size_t) noexcept {
  give_back(place);
}
void operator delete(void* place, std::align_val_t) noexcept {
  give_back(place);
}
void operator delete(void* place, std::size_t, std::align_val_t) noexcept {
  give_back(place);
}

extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) {
  static const auto real = reinterpret_cast<int (*)(pthread_mutex_t*)>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  if (counting) ++locks;
  return real(mutex);
}

namespace argil::sculpt {
namespace {

using Eigen::Vector3d;

struct Counted {
  long allocations, locks;
};

template <class Work>
Counted count(const Work& work) {
  allocations = locks = 0;
  counting = true;
  work();
  counting = false;
  return {allocations, locks};
}

ScriptedDevice press() {
  DevicePose above, below;
  above.position.z() = 0.01;
  below.position.z() = -0.01;
  return ScriptedDevice({{above, below, 500, Ease::smooth}, {below, above, 500}});
}

ContactModel floor_model(Tick valid_until) {
  ContactModel model;
  model.planes[0] = {Vector3d::UnitZ(), 0, 1000};
  model.plane_count = 1;
  model.valid_until = valid_until;
  return model;
}

TEST(Ticks, TheCountersCount) {
  const Counted counted = count([] {
    const auto number = std::make_unique<std::vector<double>>(100);
    std::mutex mutex;
    const std::scoped_lock lock(mutex);
    EXPECT_EQ(number->size(), 100u);
  });
  EXPECT_GE(counted.allocations, 2);
  EXPECT_GE(counted.locks, 1);
}

TEST(Ticks, OfTheServoNeitherAllocateNorLock) {
  ScriptedDevice intention = press();
  SimulatedHand hand(intention);
  ContactChannel channel;
  Servo servo(hand, channel);
  const Counted counted = count([&] {
    for (Tick t = 0; t < 2000; ++t) {
      if (t % 16 == 0 && t < 1500) channel.publish(floor_model(t + 50));  // later it fades
      (void)servo.tick(t);
    }
  });
  EXPECT_EQ(counted.allocations, 0);
  EXPECT_EQ(counted.locks, 0);
}

TEST(Ticks, OfAFaultySpoiltDeviceNeither) {
  MouseDevice mouse;
  mouse.grab(Vector3d::Zero(), -Vector3d::UnitZ());
  FaultInjector device(mouse, {{DeviceFault::not_a_number, 500, 510}, {DeviceFault::stall, 200, 300}});
  ContactChannel channel;
  Servo servo(device, channel);
  const Counted counted = count([&] {
    channel.publish(floor_model(10000));
    for (Tick t = 0; t < 1000; ++t) {
      mouse.push(1e-5);
      (void)servo.tick(t);
    }
  });
  EXPECT_EQ(counted.allocations, 0);
  EXPECT_EQ(counted.locks, 0);
}

TEST(Ticks, OfTheHostOfANetworkDeviceNeither) {
  const std::unique_ptr<DatagramLink> host_link = open_udp({}, std::nullopt);
  const std::unique_ptr<DatagramLink> program_link = open_udp({}, UdpAddress{"127.0.0.1", port_of(*host_link)});
  ScriptedDevice intention = press();
  SimulatedHand hand(intention);
  DeviceHost host(hand, *host_link, 1);
  NetworkDevice program(*program_link, 2);
  bool felt = false;
  const Counted counted = count([&] {
    for (Tick t = 0; t < 1000; ++t) {
      (void)program.exchange({}, t);
      if (t % 16 == 0) program.publish(floor_model(t + 50), t);
      felt = host.tick(t).safety.force.z() > 0 || felt;
    }
  });
  EXPECT_TRUE(felt);
  EXPECT_EQ(counted.allocations, 0);
  EXPECT_EQ(counted.locks, 0);
}

}  // namespace
}  // namespace argil::sculpt
