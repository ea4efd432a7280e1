// Of workshop.h: strokes of a device other than the mouse.

#include <algorithm>

#include "subdiv/error.h"
#include "tools/studio/workshop.h"

namespace argil::studio {

namespace {

constexpr sculpt::Tick k_model_life = 50;  // ticks that a model of the force holds
constexpr sculpt::Tick k_silence = 2000;   // ticks after which a device that says nothing is given up
constexpr double k_usual_force = 4;        // [N] in the hand for the size that a tool's force has

bool is_well(sculpt::DeviceMode mode) {
  return mode == sculpt::DeviceMode::idle || mode == sculpt::DeviceMode::force;
}

}  // namespace

void Workshop::list_devices() {
  post([this](Bench&) {
    choices_.store(
        std::make_shared<const std::vector<DeviceChoice>>(shop_.list ? shop_.list() : std::vector<DeviceChoice>{}));
  });
}

void Workshop::take_hand(std::unique_ptr<Hand> hand) {
  if (hand_strokes_) bench_.end_stroke(ready_.keep);
  hand_ = std::move(hand);
  device_now_.store(nullptr);
  hand_pressed_ = hand_strokes_ = false;
  hand_heard_ = 0;
  place_hand();
  if (hand_ && real_time_) hand_->start();
}

void Workshop::use_device(const std::string& name) {
  post([this, name](Bench&) {
    take_hand(nullptr);
    if (name == "mouse" || !shop_.open) return;
    try {
      take_hand(std::make_unique<Hand>(name, shop_.open(name)));
    } catch (const Error& error) {
      drop_hand(error.what());
    }
  });
}

void Workshop::use_device(std::string name, std::shared_ptr<sculpt::Device> device) {
  post([this, name = std::move(name), device = std::move(device)](Bench&) {
    take_hand(std::make_unique<Hand>(name, device));
  });
}

void Workshop::lay_ready(const ReadyBrush& brush) {
  post([this, brush](Bench&) {
    ready_ = brush;
    is_ready_ = true;
    if (!hand_strokes_) place_hand();
  });
}

// While a stroke goes on the device stays where it is in the world, however the view turns.
void Workshop::place_hand() {
  if (!hand_) return;
  sculpt::WorldFromDevice mapping = mapping_over(hand_->capabilities(), ready_.middle, ready_.radius, ready_.view);
  const double usual = ready_.tool.strength * ready_.tool.radius;
  if (usual > 0) mapping.force_scale = std::min(1.0, k_usual_force / usual);
  hand_->place(mapping);
}

void Workshop::drop_hand(const std::string& reason) {
  take_hand(nullptr);
  bench_.say(MessageKind::warning, reason + "; the mouse sculpts");
}

void Workshop::follow_hand() {
  if (!real_time_) hand_->tick();
  const HandSample* sample = hand_->latest();
  if (sample == nullptr) return;
  if (is_well(sample->mode)) hand_heard_ = sample->now;
  if (sample->now - hand_heard_ > k_silence) {
    drop_hand("the device " + hand_->name() + " does not answer");
    return;
  }
  const bool pressed = is_well(sample->mode) && (sample->buttons & 1U) != 0;
  if (is_well(sample->mode)) {
    hand_pose_.position = sample->pose.position;
    hand_pose_.orientation = sample->pose.orientation;
    hand_pose_.pressure = ready_.pressed ? sample->pressure : 1;
  }
  // While the mouse draws, the device waits, and feels obstacles only.
  if (pressed && !hand_pressed_ && is_ready_ && !bench_.is_stroking()) {
    StrokeStart start;
    start.pose = hand_pose_;
    start.tool = ready_.tool;
    start.options.scales_radius = ready_.scales_radius;
    tick_rest_ = 0;
    bench_.begin_stroke(start);
    hand_strokes_ = bench_.is_stroking();
  } else if (!pressed && hand_strokes_) {
    bench_.end_stroke(ready_.keep);
    hand_strokes_ = false;
  }
  hand_strokes_ = hand_strokes_ && bench_.is_stroking();
  hand_pressed_ = pressed && is_ready_;
  const sculpt::Tick until = sample->now + k_model_life;
  hand_->publish(hand_strokes_ ? bench_.felt_by_stroke(until) : bench_.felt_at(hand_pose_.position, until));
  device_now_.store(std::make_shared<const DeviceNow>(DeviceNow{hand_->name(), *sample, hand_->missed()}));
}

}  // namespace argil::studio
