#include "tools/studio/hand.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "sculpt/haptics/clock.h"

namespace argil::studio {

namespace {

sculpt::ServoOptions options_for(const sculpt::Device& device) {
  sculpt::ServoOptions options;
  const double most = device.capabilities().max_force;
  if (most > 0) options.limits.max_force = std::min(options.limits.max_force, most);
  return options;
}

}  // namespace

Hand::Hand(std::string name, std::shared_ptr<sculpt::Device> device)
    : name_(std::move(name)), device_(std::move(device)), servo_(*device_, to_servo_, options_for(*device_)) {}

Hand::~Hand() {
  ends_.store(true);
  if (thread_.joinable()) thread_.join();
}

void Hand::serve(sculpt::Tick now) {
  if (const sculpt::WorldFromDevice* mapping = mappings_.latest()) {
    mapping_ = *mapping;
    servo_.set_mapping(mapping_);
  }
  // The newest model goes on once; its time is over if no other follows.
  if (const sculpt::ContactModel* model = models_.latest()) {
    to_servo_.publish(*model);
    if (device_->takes_models()) device_->publish(mapping_.device_model(*model), now);
  }
  const sculpt::ServoTick ticked = servo_.tick(now);
  HandSample sample;
  sample.pose.position = mapping_.position(ticked.sample.pose.position);
  sample.pose.orientation = mapping_.rotation * ticked.sample.pose.orientation;
  sample.pressure = ticked.sample.pressure;
  sample.buttons = ticked.sample.buttons;
  sample.mode = ticked.sample.mode;
  sample.now = now;
  sample.force = mapping_.rotation * ticked.safety.force;
  samples_.publish(sample);
  missed_.store(servo_.missed());
}

void Hand::tick() {
  serve(++now_);
}

void Hand::start() {
  if (thread_.joinable()) return;
  thread_ = std::thread([this] {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    sculpt::RealClock clock([] { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); });
    while (!ends_.load()) {
      const sculpt::Tick now = clock.now();
      if (now > now_) serve(now_ = now);
      std::this_thread::sleep_until(start + std::chrono::milliseconds(now_ + 1));
    }
  });
}

sculpt::WorldFromDevice mapping_over(const sculpt::DeviceCapabilities& device, const Eigen::Vector3d& middle,
                                     double radius, const Eigen::Vector3d& view) {
  // Seen from straight above there is no "away": any turn will do.
  const Eigen::Vector3d level(view.x(), view.y(), 0);
  const Eigen::Vector3d away = level.norm() > 1e-6 * view.norm() ? level.normalized() : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d axes;
  axes.col(0) = away.cross(Eigen::Vector3d::UnitZ());
  axes.col(1) = away;
  axes.col(2) = Eigen::Vector3d::UnitZ();
  sculpt::WorldFromDevice mapping;
  mapping.rotation = Eigen::Quaterniond(axes).normalized();
  const Eigen::Vector3d size = device.workspace_high - device.workspace_low;
  const double smallest = size.minCoeff();
  mapping.scale = std::isfinite(smallest) && smallest > 0 ? 2 * radius / smallest : 1;
  return mapping.clutched(0.5 * (device.workspace_low + device.workspace_high), middle);
}

}  // namespace argil::studio
