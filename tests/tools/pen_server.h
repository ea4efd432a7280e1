#pragma once
// An X server without a screen that has a pen, its eraser and a mouse, moved by the test: Xorg with its drivers
// `dummy` and `inputtest`.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "tests/tools/process.h"

namespace argil::tests {

/// DISPLAY is another for a while.
class OtherDisplay {
 public:
  explicit OtherDisplay(const std::string& name);
  ~OtherDisplay();
  OtherDisplay(const OtherDisplay&) = delete;
  OtherDisplay& operator=(const OtherDisplay&) = delete;

 private:
  std::optional<std::string> before_;
};

/// A device of the server, by the protocol of its driver (xf86-input-inputtest-protocol.h, version 1).
class ServerDevice {
 public:
  ~ServerDevice();
  /// False if the server does not answer there.
  [[nodiscard]] bool connect(const std::filesystem::path& socket);
  /// To a place in 0 … 65535 each way over the screen, with a pressure in 0 … 1000.
  void move(double x, double y, double pressure);
  void move_by(double x, double y);  // [pixels]
  void button(int which, bool down);

 private:
  void send(std::uint32_t kind, std::initializer_list<std::uint32_t> words, const std::map<int, double>& valuators);
  int socket_ = -1;
};

class PenServer {
 public:
  /// Takes a second or two to start.
  PenServer();
  ~PenServer();
  PenServer(const PenServer&) = delete;
  PenServer& operator=(const PenServer&) = delete;

  bool runs() const { return process_ > 0; }
  const std::string& reason() const { return reason_; }  // why it does not
  const std::string& display() const { return display_; }
  void stop();
  /// As when a device is plugged in or out.
  void enable(const std::string& device, bool on);

  ServerDevice& pen() { return devices_[0]; }
  ServerDevice& eraser() { return devices_[1]; }
  ServerDevice& mouse() { return devices_[2]; }

 private:
  TemporaryFolder folder_;
  int process_ = -1;
  std::string display_, reason_;
  std::array<ServerDevice, 3> devices_;
};

}  // namespace argil::tests
