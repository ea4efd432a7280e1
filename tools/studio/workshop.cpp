#include "tools/studio/workshop.h"

#include <chrono>
#include <cmath>

namespace argil::studio {

namespace {

constexpr double k_tick = 1e-3;     // [s]
constexpr double k_follow = 0.008;  // [s], in which the device comes near the pointer: frames become a smooth way
constexpr long k_most_ticks = 60;   // at once; a slower simulation falls behind the clock instead of the hand
constexpr double k_longest_wait = 0.5;  // [s]

using Clock = std::chrono::steady_clock;

}  // namespace

Workshop::Workshop(BenchOptions options) : bench_(std::move(options)) {
  bench_.on_line = [this] {
    if (frame_thread_.load() == std::this_thread::get_id()) ++lines_in_frames_;
  };
  publish();
}

Workshop::~Workshop() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  woken_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Workshop::post(std::function<void(Bench&)> order) {
  {
    const std::lock_guard lock(mutex_);
    orders_.push_back(std::move(order));
  }
  woken_.notify_one();
}

void Workshop::run(std::string line) {
  post([line = std::move(line)](Bench& bench) { bench.run(line); });
}

void Workshop::run_together(std::vector<std::string> lines) {
  post([lines = std::move(lines)](Bench& bench) { bench.run_together(lines); });
}

void Workshop::move_device(const sculpt::StrokePose& pose) {
  post([this, pose](Bench&) { device_goal_ = pose; });
}

void Workshop::begin_stroke(const StrokeStart& start) {
  post([this, start](Bench& bench) {
    device_ = device_goal_ = start.pose;
    tick_rest_ = 0;
    bench.begin_stroke(start);
  });
}

void Workshop::end_stroke(bool keep) {
  post([keep](Bench& bench) { bench.end_stroke(keep); });
}

void Workshop::preview(std::vector<std::string> lines) {
  post([lines = std::move(lines)](Bench& bench) { bench.preview(lines); });
}

void Workshop::cancel_stroke() {
  post([](Bench& bench) { bench.cancel_stroke(); });
}

bool Workshop::do_orders() {
  std::vector<std::function<void(Bench&)>> orders;
  {
    const std::lock_guard lock(mutex_);
    orders.swap(orders_);
  }
  for (const auto& order : orders) order(bench_);
  return !orders.empty();
}

void Workshop::do_ticks(long ticks, long most) {
  if (!bench_.is_stroking()) return;
  const double share = 1 - std::exp(-k_tick / k_follow);
  for (long i = 0; i < std::min(ticks, most) && bench_.is_stroking(); ++i) {
    device_.position += share * (device_goal_.position - device_.position);
    device_.pressure += share * (device_goal_.pressure - device_.pressure);
    bench_.tick_stroke(device_);
  }
  if (ticks > most) bench_.missed(ticks - most);
}

void Workshop::do_play(double seconds, int most) {
  if (!bench_.is_playing() || bench_.is_stroking()) {
    play_rest_ = 0;
    return;
  }
  play_rest_ += seconds;
  const double step = bench_.session().document().state().time_step;
  for (int i = 0; i < most && play_rest_ >= step * (1 - 1e-9) && bench_.is_playing(); ++i) {
    play_rest_ -= step;
    bench_.play_step();
  }
  play_rest_ = std::min(play_rest_, step);
}

void Workshop::publish() {
  if (bench_.has_changed() || !latest_.load()) latest_.store(bench_.snapshot());
}

void Workshop::advance(double seconds) {
  do_orders();
  tick_rest_ += seconds / k_tick;
  const long ticks = static_cast<long>(std::floor(tick_rest_ + 1e-9));
  tick_rest_ -= static_cast<double>(ticks);
  do_ticks(ticks, ticks);
  do_play(seconds, 1000);
  publish();
}

void Workshop::start() {
  if (!thread_.joinable()) thread_ = std::thread([this] { loop(); });
}

void Workshop::loop() {
  Clock::time_point last = Clock::now();
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      const bool busy = bench_.is_stroking() || bench_.is_playing();
      if (orders_.empty() && !ends_)
        woken_.wait_for(lock, std::chrono::duration<double>(busy ? k_tick : k_longest_wait),
                        [this] { return ends_ || !orders_.empty(); });
      if (ends_) return;
    }
    const bool was_stroking = bench_.is_stroking(), was_playing = bench_.is_playing();
    do_orders();
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    if (was_stroking) {
      tick_rest_ += seconds / k_tick;
      const double whole = std::floor(tick_rest_);
      tick_rest_ -= whole;
      do_ticks(static_cast<long>(whole), k_most_ticks);
    }
    if (was_playing) do_play(seconds, 1);
    publish();
  }
}

}  // namespace argil::studio
