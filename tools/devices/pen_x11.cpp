// Of pen.h: pens by XInput 2. A connection of its own hears the raw events of all devices, which a window's grabs
// do not keep back and which take no events from the window; a thread of its own reads them, so that questions to
// the display, as after a pen was plugged in, hold no frame up.

#include <fmt/format.h>

#include "tools/devices/pen.h"

#ifdef ARGIL_HAS_XINPUT

#include <X11/Xlib.h>
#include <X11/extensions/XInput.h>
#include <X11/extensions/XInput2.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <map>
#include <set>
#include <thread>

#include "sculpt/haptics/latest_channel.h"

namespace argil::devices {

namespace {

struct CloseDisplay {
  void operator()(Display* display) const { XCloseDisplay(display); }
};
using DisplayHandle = std::unique_ptr<Display, CloseDisplay>;

/// Null where there is none with raw events that grabs let through.
DisplayHandle open_display(int& extension) {
  static const int threads = XInitThreads();  // before anything else of Xlib
  (void)threads;
  DisplayHandle display(XOpenDisplay(nullptr));
  int event = 0, error = 0, major = 2, minor = 2;
  if (!display || XQueryExtension(display.get(), "XInputExtension", &extension, &event, &error) == 0 ||
      XIQueryVersion(display.get(), &major, &minor) != Success || major * 100 + minor < 201)
    return nullptr;
  return display;
}

std::string name_of(Display* display, Atom atom) {
  char* const name = atom == None ? nullptr : XGetAtomName(display, atom);
  std::string result = name == nullptr ? "" : name;
  if (name != nullptr) XFree(name);
  return result;
}

// Both lists are asked for whole: a device that goes in between must not be asked for by its number, as the display
// answers that with an error.
std::vector<PointingDevice> list_pointing_devices(Display* display) {
  std::map<int, std::string> types;
  int count = 0;
  if (XDeviceInfo* const all = XListInputDevices(display, &count)) {
    for (int i = 0; i < count; ++i) types[static_cast<int>(all[i].id)] = name_of(display, all[i].type);
    XFreeDeviceList(all);
  }
  std::vector<PointingDevice> devices;
  XIDeviceInfo* const all = XIQueryDevice(display, XIAllDevices, &count);
  if (all == nullptr) return devices;
  for (int i = 0; i < count; ++i) {
    if (all[i].use != XISlavePointer) continue;
    PointingDevice device{all[i].deviceid, all[i].name, types[all[i].deviceid], {}};
    for (int c = 0; c < all[i].num_classes; ++c) {
      if (all[i].classes[c]->type != XIValuatorClass) continue;
      const auto& valuator = *reinterpret_cast<const XIValuatorClassInfo*>(all[i].classes[c]);
      device.valuators.push_back({valuator.number, name_of(display, valuator.label), valuator.min, valuator.max});
    }
    devices.push_back(std::move(device));
  }
  XIFreeDeviceInfo(all);
  return devices;
}

class X11Pens : public PenReader {
 public:
  X11Pens(DisplayHandle display, int extension) : display_(std::move(display)), extension_(extension) {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) return;
    // A display that goes away ends the window, not this thread the program.
    XSetIOErrorExitHandler(
        display_.get(), [](Display*, void*) {}, nullptr);
    thread_ = std::thread([this] { listen(); });
  }
  ~X11Pens() override {
    if (!thread_.joinable()) return;
    const char over = 0;
    while (write(ends_[1], &over, 1) < 0 && errno == EINTR) {
    }
    thread_.join();
    close(ends_[0]);
    close(ends_[1]);
    if (lost_) (void)display_.release();  // closing it would ask it
  }
  X11Pens(const X11Pens&) = delete;
  X11Pens& operator=(const X11Pens&) = delete;

  PenState state() override {
    const PenState* const newest = states_.latest();
    return newest != nullptr ? *newest : PenState{};
  }

 private:
  void listen() {
    select_events();
    look();
    for (;;) {
      while (XEventsQueued(display_.get(), QueuedAfterReading) > 0) take_event();
      states_.publish(decoder_.state());
      std::array<pollfd, 2> files{pollfd{ConnectionNumber(display_.get()), POLLIN, 0}, pollfd{ends_[0], POLLIN, 0}};
      if (poll(files.data(), files.size(), -1) < 0 && errno != EINTR) return;
      if (files[1].revents != 0) return;
      lost_ = (files[0].revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
      if (lost_) {
        states_.publish({});
        return;
      }
    }
  }

  void select_events() {
    std::array<unsigned char, XIMaskLen(XI_LASTEVENT)> bits{};
    for (const int event :
         {XI_RawMotion, XI_RawButtonPress, XI_RawButtonRelease, XI_HierarchyChanged, XI_DeviceChanged})
      XISetMask(bits.data(), event);
    XIEventMask mask{XIAllDevices, static_cast<int>(bits.size()), bits.data()};
    XISelectEvents(display_.get(), DefaultRootWindow(display_.get()), &mask, 1);
    XFlush(display_.get());
  }

  void look() {
    const std::vector<PointingDevice> devices = list_pointing_devices(display_.get());
    slaves_.clear();
    for (const PointingDevice& device : devices) slaves_.insert(device.id);
    decoder_.set_devices(devices);
  }

  void take_event() {
    XEvent event;
    XNextEvent(display_.get(), &event);
    XGenericEventCookie& cookie = event.xcookie;
    if (cookie.type != GenericEvent || cookie.extension != extension_ ||
        XGetEventData(display_.get(), &cookie) == 0)
      return;
    if (cookie.evtype == XI_HierarchyChanged ||
        (cookie.evtype == XI_DeviceChanged &&
         static_cast<const XIDeviceChangedEvent*>(cookie.data)->reason == XIDeviceChange))
      look();
    else if (cookie.evtype != XI_DeviceChanged)
      take_raw(*static_cast<const XIRawEvent*>(cookie.data));
    XFreeEventData(display_.get(), &cookie);
  }

  // Each is said twice: by the device, and by the master that it moves.
  void take_raw(const XIRawEvent& event) {
    if (!slaves_.contains(event.deviceid)) return;
    values_.clear();
    const double* value = event.raw_values;
    for (int i = 0; i < 8 * event.valuators.mask_len; ++i)
      if (XIMaskIsSet(event.valuators.mask, i)) values_.push_back({i, *value++});
    decoder_.take(event.deviceid, values_);
  }

  DisplayHandle display_;
  int extension_;
  std::array<int, 2> ends_{-1, -1};
  // Of the thread.
  PenDecoder decoder_;
  std::set<int> slaves_;
  std::vector<ValuatorNow> values_;
  bool lost_ = false;
  sculpt::LatestChannel<PenState> states_;
  std::thread thread_;
};

}  // namespace

bool pens_supported() {
  return true;
}

std::unique_ptr<PenReader> open_pens() {
  int extension = 0;
  DisplayHandle display = open_display(extension);
  return display ? std::make_unique<X11Pens>(std::move(display), extension) : nullptr;
}

PensFound find_pens() {
  int extension = 0;
  const DisplayHandle display = open_display(extension);
  if (!display) return {false, "no X display answers (DISPLAY); without, a pen is as a mouse"};
  PenDecoder decoder;
  decoder.set_devices(list_pointing_devices(display.get()));
  PensFound found{!decoder.pens().empty(), {}};
  for (const Pen& pen : decoder.pens())
    found.state += fmt::format("{}{}{}", found.state.empty() ? "" : ", ", pen.name, pen.eraser ? " (inverts)" : "");
  if (!found.present) found.state = "none is plugged in";
  return found;
}

}  // namespace argil::devices

#else

namespace argil::devices {

bool pens_supported() {
  return false;
}
std::unique_ptr<PenReader> open_pens() {
  return nullptr;
}
PensFound find_pens() {
  return {false, "not in this build; install libxi-dev and build again"};
}

}  // namespace argil::devices

#endif
