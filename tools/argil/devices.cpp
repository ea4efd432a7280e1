// `argil devices`: what there is to sculpt with, how well this machine keeps time, and a host for a device that the
// program reaches by UDP.

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "sculpt/haptics/clock.h"
#include "sculpt/haptics/network_device.h"
#include "tools/argil/program.h"
#include "tools/devices/device_table.h"

namespace argil::tools {

namespace {

std::string axes_of(const sculpt::DeviceCapabilities& can) {
  std::string text = fmt::format("senses {} axes", can.sensed_axes);
  if (can.senses_pressure) text += " and pressure, 0 to 1";
  if (can.actuated_axes > 0)
    text += fmt::format(", {} with force up to {:.3g} N", can.actuated_axes, can.max_force);
  if (can.max_stiffness > 0) text += fmt::format(", walls up to {:.3g} N/m", can.max_stiffness);
  return text;
}

void print_table(bool json) {
  const std::vector<devices::DeviceEntry> entries = devices::list_devices();
  if (json) {
    auto list = nlohmann::ordered_json::array();
    for (const devices::DeviceEntry& entry : entries)
      list.push_back({{"name", entry.name},
                      {"summary", entry.summary},
                      {"present", entry.present},
                      {"state", entry.state},
                      {"sensed_axes", entry.capabilities.sensed_axes},
                      {"senses_pressure", entry.capabilities.senses_pressure},
                      {"actuated_axes", entry.capabilities.actuated_axes},
                      {"max_force_N", entry.capabilities.max_force},
                      {"max_stiffness_N_per_m", entry.capabilities.max_stiffness},
                      {"rate_Hz", entry.capabilities.rate}});
    fmt::print("{}\n", nlohmann::ordered_json{{"devices", list}}.dump(2));
    return;
  }
  for (const devices::DeviceEntry& entry : entries)
    fmt::print("{} {:<12} {}\n    {}; {}\n", entry.present ? "*" : " ", entry.name, entry.summary,
               axes_of(entry.capabilities), entry.state);
  fmt::print("* is there now\n");
}

void print_bench(double seconds, bool json) {
  const devices::TickBench bench = devices::bench_ticks(seconds);
  if (json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"ticks", bench.ticks},
                                              {"missed", bench.missed},
                                              {"late_us", {bench.late_p50, bench.late_p99, bench.late_most}},
                                              {"work_us", {bench.work_p50, bench.work_p99, bench.work_most}}}
                           .dump(2));
    return;
  }
  fmt::print("{} ticks of 1 ms, {} missed\n", bench.ticks, bench.missed);
  fmt::print("             median       99 %    largest  [µs]\n");
  fmt::print("late     {:10.1f} {:10.1f} {:10.1f}\n", bench.late_p50, bench.late_p99, bench.late_most);
  fmt::print("computed {:10.2f} {:10.2f} {:10.2f}\n", bench.work_p50, bench.work_p99, bench.work_most);
}

void serve(const DevicesArguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const std::unique_ptr<devices::OwnedDevice> owned = devices::open_device(arguments.serve);
  const std::unique_ptr<sculpt::DatagramLink> link =
      sculpt::open_udp({arguments.address, arguments.port}, std::nullopt);
  fmt::print("{} at {}:{}\n", arguments.serve, arguments.address, sculpt::port_of(*link));
  std::fflush(stdout);
  std::random_device random;
  sculpt::DeviceHost host(owned->device(), *link, (std::uint64_t{random()} << 32) | random());
  const Clock::time_point start = Clock::now();
  const auto last = static_cast<sculpt::Tick>(arguments.seconds / sculpt::k_tick_seconds);
  for (sculpt::Tick tick = 0; arguments.seconds <= 0 || tick <= last;) {
    (void)host.tick(tick);
    const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start).count();
    tick = std::max<sculpt::Tick>(tick, passed) + 1;
    std::this_thread::sleep_until(start + std::chrono::milliseconds(tick));
  }
}

}  // namespace

int devices_command(const DevicesArguments& arguments) {
  if (!arguments.serve.empty())
    serve(arguments);
  else if (arguments.bench)
    print_bench(arguments.seconds > 0 ? arguments.seconds : 2, arguments.json);
  else
    print_table(arguments.json);
  return k_well;
}

}  // namespace argil::tools
