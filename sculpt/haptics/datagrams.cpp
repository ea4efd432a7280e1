#include "sculpt/haptics/datagrams.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

[[noreturn]] void refuse(const UdpAddress& address, const char* what) {
  throw Error(ErrorCode::unsupported,
              fmt::format("{} {}:{}: {}; give an IPv4 address of this machine and a port that is free", what,
                          address.host, address.port, std::strerror(errno)));
}

sockaddr_in socket_address(const UdpAddress& address) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_port = htons(address.port);
  if (inet_pton(AF_INET, address.host.c_str(), &result.sin_addr) != 1)
    throw Error(ErrorCode::bad_input, fmt::format("expected an IPv4 address such as 127.0.0.1, found \"{}\"; names "
                                                  "of machines are not looked up",
                                                  address.host));
  return result;
}

bool same(const sockaddr_in& a, const sockaddr_in& b) {
  return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port;
}

class UdpLink : public DatagramLink {
 public:
  UdpLink(const UdpAddress& here, const std::optional<UdpAddress>& there) {
    const sockaddr_in bound = socket_address(here);
    if (there) peer_ = socket_address(*there);
    socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0) refuse(here, "no UDP socket for");
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&bound), sizeof bound) != 0) {
      const int reason = errno;
      ::close(socket_);
      errno = reason;
      refuse(here, "cannot listen at");
    }
  }
  ~UdpLink() override { ::close(socket_); }
  UdpLink(const UdpLink&) = delete;
  UdpLink& operator=(const UdpLink&) = delete;

  bool send(std::span<const std::byte> datagram) override {
    if (!peer_ || datagram.size() > k_largest_datagram) return false;
    const ssize_t sent = ::sendto(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                                  reinterpret_cast<const sockaddr*>(&*peer_), sizeof *peer_);
    return sent == static_cast<ssize_t>(datagram.size());
  }

  std::optional<std::size_t> receive(std::span<std::byte> buffer) override {
    // Strangers are passed over, but not for ever: a flood must not hold the tick up.
    for (int strangers = 0; strangers < 64; ++strangers) {
      sockaddr_in from{};
      socklen_t length = sizeof from;
      const ssize_t size = ::recvfrom(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT,
                                      reinterpret_cast<sockaddr*>(&from), &length);
      if (size < 0) return std::nullopt;
      if (!peer_) peer_ = from;
      if (same(from, *peer_)) return static_cast<std::size_t>(size);
    }
    return std::nullopt;
  }

  std::uint16_t port() const {
    sockaddr_in bound{};
    socklen_t length = sizeof bound;
    if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&bound), &length) != 0) return 0;
    return ntohs(bound.sin_port);
  }

 private:
  int socket_ = -1;
  std::optional<sockaddr_in> peer_;
};

}  // namespace

std::unique_ptr<DatagramLink> open_udp(const UdpAddress& here, std::optional<UdpAddress> there) {
  return std::make_unique<UdpLink>(here, there);
}

std::uint16_t port_of(const DatagramLink& link) {
  if (const auto* udp = dynamic_cast<const UdpLink*>(&link)) return udp->port();
  throw Error(ErrorCode::bad_input, "expected a UDP link, found another kind, which has no port");
}

class SimulatedNetwork::End : public DatagramLink {
 public:
  End(SimulatedNetwork& network, int which) : network_(network), which_(which) {}

  bool send(std::span<const std::byte> datagram) override {
    if (datagram.size() > k_largest_datagram) return false;
    const NetworkWeather& weather = network_.weather_;
    const double fate = network_.random(), spread = 2 * network_.random() - 1;
    const Tick now = network_.now_;
    if (fate < weather.loss || (now >= weather.cut_first && now <= weather.cut_last)) return true;
    const Tick way = std::max<Tick>(
        0, weather.delay + static_cast<Tick>(std::llround(spread * static_cast<double>(weather.jitter))));
    network_.on_the_way_[1 - which_].emplace(now + way, std::vector<std::byte>(datagram.begin(), datagram.end()));
    return true;
  }

  std::optional<std::size_t> receive(std::span<std::byte> buffer) override {
    auto& queue = network_.on_the_way_[which_];
    if (queue.empty() || queue.begin()->first > network_.now_) return std::nullopt;
    const std::vector<std::byte> datagram = std::move(queue.begin()->second);
    queue.erase(queue.begin());
    const std::size_t size = std::min(datagram.size(), buffer.size());
    std::copy_n(datagram.begin(), size, buffer.begin());
    return size;
  }

 private:
  SimulatedNetwork& network_;
  int which_;
};

SimulatedNetwork::SimulatedNetwork(const NetworkWeather& weather)
    : weather_(weather),
      random_(weather.seed),
      ends_{std::make_unique<End>(*this, 0), std::make_unique<End>(*this, 1)} {}

SimulatedNetwork::~SimulatedNetwork() = default;

DatagramLink& SimulatedNetwork::end(int which) {
  assert(which == 0 || which == 1);
  return *ends_[which];
}

void SimulatedNetwork::advance(Tick now) {
  assert(now >= now_);
  now_ = now;
}

// SplitMix64 (Steele, Lea, Flood 2014), in [0, 1).
double SimulatedNetwork::random() {
  std::uint64_t z = random_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

}  // namespace argil::sculpt
