#pragma once
// The pen of a tablet: how hard it is pressed and which end is down. Where it points is the pointer's affair. What
// a driver says of its devices is decoded here, without asking anyone; pen_x11.cpp listens to it by XInput 2.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace argil::devices {

struct PenState {
  bool plugged = false;  // there is a pen, in the hand or not
  double pressure = 1;   // 0 … 1; 1 while something else moves the pointer
  bool eraser = false;   // the pen's other end
};

/// One number that a device says, as its driver labels it.
struct Valuator {
  int number = 0;
  std::string label;
  double low = 0, high = 0;
};
struct PointingDevice {
  int id = 0;
  std::string name, type;  // type: as the driver classes it, "STYLUS"; may be empty
  std::vector<Valuator> valuators;
};
struct ValuatorNow {
  int number = 0;
  double value = 0;
};

/// Where a device says its pressure.
struct Pen {
  int device = 0, valuator = 0;
  double low = 0, high = 1;
  bool eraser = false;
  std::string name;
};
/// Nothing for what has no "Abs Pressure" of some range, and for touchpads, whose fingers are no pens.
[[nodiscard]] std::optional<Pen> pen_of(const PointingDevice& device);

/// Whoever moved last is in the hand: a pen with its pressure, or something that has none.
class PenDecoder {
 public:
  /// The devices that there are from now on. A pen that stays keeps its pressure.
  void set_devices(std::span<const PointingDevice> devices);
  /// What a device says that has changed; a value out of its range is cut to it, one that is no number is none.
  void take(int device, std::span<const ValuatorNow> values);

  const std::vector<Pen>& pens() const { return pens_; }
  const PenState& state() const { return state_; }

 private:
  std::vector<Pen> pens_;
  std::vector<double> pressures_;  // of each pen, as it said last
  int in_hand_ = -1;               // device; −1: none that has said anything
  PenState state_;
};

/// Hears the pens of a display. It never waits: another thread listens.
class PenReader {
 public:
  virtual ~PenReader() = default;
  /// Of one thread.
  [[nodiscard]] virtual PenState state() = 0;
};

/// Whether this build can.
[[nodiscard]] bool pens_supported();
/// Null where there is no X display with XInput 2.1, or this build cannot; pens may come and go while it is open.
[[nodiscard]] std::unique_ptr<PenReader> open_pens();

/// What there is now: names of pens, or why there are none.
struct PensFound {
  bool present = false;
  std::string state;
};
/// Asks the display; takes as long as that takes to answer.
[[nodiscard]] PensFound find_pens();

}  // namespace argil::devices
