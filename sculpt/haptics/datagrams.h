#pragma once
// The seam to whatever carries datagrams between a force device's host and the program: whole, late, out of order,
// or not at all. Sending and receiving never wait and never throw.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

/// Longer ones are neither sent nor received: they fit into one frame of any network.
inline constexpr std::size_t k_largest_datagram = 1200;

class DatagramLink {
 public:
  virtual ~DatagramLink() = default;
  /// @returns false where it could not be handed over; a lost one is not noticed.
  virtual bool send(std::span<const std::byte> datagram) = 0;
  /// The next that has arrived, cut to `buffer` (then its size is that of the buffer); nothing if none has.
  virtual std::optional<std::size_t> receive(std::span<std::byte> buffer) = 0;
};

struct UdpAddress {
  std::string host = "127.0.0.1";  // IPv4, in numbers: nothing is looked up
  std::uint16_t port = 0;
};

/// A UDP socket bound to `here`. It hears only `there`; without one, it hears whoever speaks first, and answers
/// that one.
/// @throws Error (unsupported) with the reason of the system and a remedy where the socket cannot be had.
[[nodiscard]] std::unique_ptr<DatagramLink> open_udp(const UdpAddress& here, std::optional<UdpAddress> there);
/// The port that a link made by open_udp with port 0 was given. @throws Error (bad_input) for another link.
[[nodiscard]] std::uint16_t port_of(const DatagramLink& link);

/// What a network does to datagrams.
struct NetworkWeather {
  Tick delay = 0, jitter = 0;          // each takes delay ± jitter ticks, evenly spread
  double loss = 0;                     // share that never arrives
  Tick cut_first = -1, cut_last = -1;  // nothing sent in these ticks arrives
  std::uint64_t seed = 1;
};

/// Two ends of a network with weather on a virtual clock, the same for the same seed.
class SimulatedNetwork {
 public:
  explicit SimulatedNetwork(const NetworkWeather& weather);
  ~SimulatedNetwork();
  /// End 0 or 1, to be used while the network lives.
  DatagramLink& end(int which);
  /// Time for both ends; must not fall.
  void advance(Tick now);

 private:
  class End;
  double random();

  NetworkWeather weather_;
  std::uint64_t random_;
  Tick now_ = 0;
  std::multimap<Tick, std::vector<std::byte>> on_the_way_[2];  // to end 0 and 1, by tick of arrival
  std::unique_ptr<End> ends_[2];
};

}  // namespace argil::sculpt
