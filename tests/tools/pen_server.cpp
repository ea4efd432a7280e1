#include "tests/tools/pen_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <vector>

#ifdef ARGIL_TEST_XINPUT
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/extensions/XInput2.h>
#endif

namespace argil::tests {

namespace {

constexpr const char* k_server = "/usr/lib/xorg/Xorg";
constexpr const char* k_driver = "/usr/lib/xorg/modules/input/inputtest_drv.so";
constexpr const char* k_screen = "/usr/lib/xorg/modules/drivers/dummy_drv.so";
constexpr std::array<const char*, 3> k_devices{"pen", "pen eraser", "mouse"};

std::filesystem::path socket_of(const TemporaryFolder& folder, std::size_t device) {
  return folder / fmt::format("device{}", device);
}

std::string configuration(const TemporaryFolder& folder) {
  std::string devices, layout;
  for (std::size_t i = 0; i < k_devices.size(); ++i) {
    const bool is_pen = i < 2;
    devices += fmt::format(
        "Section \"InputDevice\"\n Identifier \"{}\"\n Driver \"inputtest\"\n Option \"SocketPath\" \"{}\"\n"
        " Option \"DeviceType\" \"{}\"\n Option \"PointerHasPressure\" \"{}\"\nEndSection\n",
        k_devices[i], socket_of(folder, i).string(), is_pen ? "PointerAbsoluteProximity" : "Pointer", is_pen);
    layout += fmt::format(" InputDevice \"{}\" \"{}\"\n", k_devices[i], i == 0 ? "CorePointer" : "SendCoreEvents");
  }
  return "Section \"ServerFlags\"\n Option \"AutoAddDevices\" \"false\"\n Option \"AutoAddGPU\" \"false\"\n"
         " Option \"AllowEmptyInput\" \"true\"\nEndSection\n"
         "Section \"ServerLayout\"\n Identifier \"layout\"\n Screen \"screen\"\n" +
         layout + "EndSection\n" + devices +
         "Section \"Device\"\n Identifier \"none\"\n Driver \"dummy\"\n VideoRam 65536\nEndSection\n"
         "Section \"Monitor\"\n Identifier \"monitor\"\n HorizSync 5-1000\n VertRefresh 5-200\n"
         " Modeline \"1440x900\" 106.5 1440 1528 1672 1904 900 903 909 934\nEndSection\n"
         "Section \"Screen\"\n Identifier \"screen\"\n Device \"none\"\n Monitor \"monitor\"\n DefaultDepth 24\n"
         " SubSection \"Display\"\n  Depth 24\n  Modes \"1440x900\"\n EndSubSection\nEndSection\n";
}

}  // namespace

OtherDisplay::OtherDisplay(const std::string& name) {
  if (const char* const before = std::getenv("DISPLAY")) before_ = before;
  if (name.empty())
    unsetenv("DISPLAY");
  else
    setenv("DISPLAY", name.c_str(), 1);
}

OtherDisplay::~OtherDisplay() {
  if (before_)
    setenv("DISPLAY", before_->c_str(), 1);
  else
    unsetenv("DISPLAY");
}

ServerDevice::~ServerDevice() {
  if (socket_ >= 0) close(socket_);
}

bool ServerDevice::connect(const std::filesystem::path& path) {
  if (socket_ >= 0) close(socket_);
  socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return false;
  const std::array<std::uint16_t, 6> version{12, 0, 0, 0, 1, 1};  // length, kind 0, major, minor
  std::array<std::uint16_t, 6> answer{};
  return ::send(socket_, version.data(), 12, MSG_NOSIGNAL) == 12 && recv(socket_, answer.data(), 12, 0) == 12;
}

// Length and kind, so many words, then which valuators there are and their values, accelerated and not.
void ServerDevice::send(std::uint32_t kind, std::initializer_list<std::uint32_t> words,
                        const std::map<int, double>& valuators) {
  std::vector<std::byte> bytes;
  const auto add = [&](const void* from, std::size_t count) {
    const auto* const first = static_cast<const std::byte*>(from);
    bytes.insert(bytes.end(), first, first + count);
  };
  std::vector<std::uint32_t> head{0, kind};
  head.insert(head.end(), words);
  if (head.size() % 2 != 0) head.push_back(0);  // what follows is aligned to eight bytes
  add(head.data(), 4 * head.size());
  std::array<std::uint32_t, 4> which{};  // unaccelerated: none; 64 bits; padding
  std::array<double, 128> values{};
  for (const auto& [valuator, value] : valuators) {
    which[1] |= 1U << valuator;
    values[static_cast<std::size_t>(valuator)] = value;
  }
  add(which.data(), sizeof which);
  add(values.data(), sizeof values);
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(bytes.data(), &length, 4);
  EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
}

void ServerDevice::move(double x, double y, double pressure) {
  send(2, {1}, {{0, x}, {1, y}, {4, pressure}});
}

void ServerDevice::move_by(double x, double y) {
  send(2, {0}, {{0, x}, {1, y}});
}

void ServerDevice::button(int which, bool down) {
  send(4, {0, static_cast<std::uint32_t>(which), down ? 1U : 0U}, {});
}

PenServer::PenServer() {
  for (const char* part : {k_server, k_driver, k_screen})
    if (access(part, R_OK) != 0) {
      reason_ = fmt::format("there is no {}; tools/setup --pens installs it", part);
      return;
    }
  folder_.write("xorg.conf", configuration(folder_));
  const std::string config = (folder_ / "xorg.conf").string(), log = (folder_ / "log").string();
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), 0) != 0) return;
  const std::string display_file = std::to_string(pipe[1]);
  std::vector<std::string> words{k_server,      "-config",    config,      "-logfile",   log,
                                 "-displayfd",  display_file, "-noreset",  "+extension", "GLX",
                                 "-novtswitch", "-sharevts",  "-nolisten", "tcp"};
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder_ / "err").c_str(), O_CREAT | O_WRONLY, 0600);
  posix_spawn_file_actions_addclose(&actions, pipe[0]);
  const int failed = posix_spawn(&process_, k_server, &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe[1]);
  // It writes its number when it is ready, or ends without.
  std::string number;
  char letter = 0;
  pollfd file{pipe[0], POLLIN, 0};
  while (failed == 0 && poll(&file, 1, 20'000) > 0 && read(pipe[0], &letter, 1) == 1 && letter != '\n')
    number += letter;
  close(pipe[0]);
  if (failed != 0) process_ = -1;
  display_ = ':' + number;
  for (std::size_t i = 0; i < devices_.size() && !number.empty(); ++i)
    if (!devices_[i].connect(socket_of(folder_, i))) number.clear();
  if (!number.empty()) return;
  reason_ = "the X server does not start: " + read_bytes(folder_ / "err");
  stop();
}

PenServer::~PenServer() {
  stop();
}

void PenServer::enable(const std::string& device, bool on) {
#ifdef ARGIL_TEST_XINPUT
  Display* const display = XOpenDisplay(display_.c_str());
  ASSERT_NE(display, nullptr);
  int count = 0;
  XIDeviceInfo* const all = XIQueryDevice(display, XIAllDevices, &count);
  unsigned char enabled = on ? 1 : 0;
  const Atom property = XInternAtom(display, "Device Enabled", False);
  for (int i = 0; i < count; ++i)
    if (device == all[i].name)
      XIChangeProperty(display, all[i].deviceid, property, XA_INTEGER, 8, XIPropModeReplace, &enabled, 1);
  XIFreeDeviceInfo(all);
  XCloseDisplay(display);  // when all of it is done
  for (std::size_t i = 0; i < k_devices.size(); ++i) {
    if (!on || device != k_devices[i]) continue;
    EXPECT_TRUE(devices_[i].connect(socket_of(folder_, i)));
  }
#else
  (void)device;
  (void)on;
#endif
}

void PenServer::stop() {
  if (process_ <= 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  process_ = -1;
}

}  // namespace argil::tests
