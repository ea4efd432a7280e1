#include "sculpt/haptics/servo.h"

#include <algorithm>
#include <cassert>

namespace argil::sculpt {

Servo::Servo(Device& device, ContactChannel& channel, const ServoOptions& options)
    : device_(device), channel_(channel), options_(options), safety_(options.limits) {}

double Servo::next_share(const ContactModel* model, Tick now) const {
  if (model == nullptr) return 1;
  const Tick late = now - model->valid_until;
  const auto part = [](Tick ticks, Tick whole) { return static_cast<double>(ticks) / static_cast<double>(whole); };
  if (late > 0) return late < options_.fade ? std::min(share_, 1 - part(late, options_.fade)) : 0;
  return options_.comeback > 0 ? std::min(1.0, share_ + part(now - last_, options_.comeback)) : 1;
}

ServoTick Servo::tick(Tick now) {
  assert(!started_ || now > last_);
  if (started_) missed_ += now - last_ - 1;

  ServoTick result;
  const ContactModel* const model = channel_.latest();
  result.model_valid = model != nullptr && now <= model->valid_until;
  if (started_) {  // else no pose is known yet, and there is no force
    const bool senses = sample_.mode == DeviceMode::idle || sample_.mode == DeviceMode::force;
    share_ = next_share(model, now);
    const bool fresh = model != nullptr && share_ > 0 && senses && now - sample_.tick <= options_.max_sample_age;
    const WorldFromDevice& mapping = options_.world_from_device;
    const Eigen::Vector3d& position = sample_.pose.position;
    if (fresh) result.wanted = share_ * mapping.device_force(contact_force(*model, mapping.position(position)));
    result.safety = safety_.apply(result.wanted, position, fresh);
  }

  sample_ = device_.exchange({result.safety.force, now + options_.command_life}, now);
  result.sample = sample_;
  last_ = now;
  started_ = true;
  return result;
}

}  // namespace argil::sculpt
