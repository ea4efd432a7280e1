#include "tools/devices/pen.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

namespace argil::devices {

namespace {

bool contains(std::string_view text, std::string_view lower_case) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::search(text.begin(), text.end(), lower_case.begin(), lower_case.end(), same) != text.end();
}

}  // namespace

std::optional<Pen> pen_of(const PointingDevice& device) {
  const auto says = [&](std::string_view word) {
    return contains(device.name, word) || contains(device.type, word);
  };
  if (says("touchpad")) return std::nullopt;
  for (const Valuator& valuator : device.valuators)
    if (valuator.label == "Abs Pressure" && valuator.high > valuator.low)
      return Pen{device.id, valuator.number, valuator.low, valuator.high, says("eraser"), device.name};
  return std::nullopt;
}

void PenDecoder::set_devices(std::span<const PointingDevice> devices) {
  std::vector<Pen> pens;
  std::vector<double> pressures;
  for (const PointingDevice& device : devices) {
    const std::optional<Pen> pen = pen_of(device);
    if (!pen) continue;
    const auto before =
        std::find_if(pens_.begin(), pens_.end(), [&](const Pen& each) { return each.device == pen->device; });
    pens.push_back(*pen);
    pressures.push_back(before == pens_.end() ? 0 : pressures_[static_cast<std::size_t>(before - pens_.begin())]);
  }
  pens_ = std::move(pens);
  pressures_ = std::move(pressures);
  take(in_hand_, {});
}

void PenDecoder::take(int device, std::span<const ValuatorNow> values) {
  in_hand_ = device;
  state_ = {!pens_.empty(), 1, false};
  for (std::size_t i = 0; i < pens_.size(); ++i) {
    const Pen& pen = pens_[i];
    if (pen.device != device) continue;
    for (const ValuatorNow& each : values)
      if (each.number == pen.valuator && std::isfinite(each.value))
        pressures_[i] = std::clamp((each.value - pen.low) / (pen.high - pen.low), 0.0, 1.0);
    state_.pressure = pressures_[i];
    state_.eraser = pen.eraser;
  }
}

}  // namespace argil::devices
