#include "tools/studio/workshop.h"

#include <chrono>
#include <cmath>

namespace argil::studio {

namespace {

constexpr double k_tick = 1e-3;     // [s]
constexpr double k_follow = 0.008;  // [s], in which the device comes near the pointer: frames become a smooth way
constexpr long k_most_ticks = 60;   // at once; a slower simulation falls behind the clock instead of the hand
constexpr double k_longest_wait = 0.5;  // [s]
constexpr double k_report = 0.05;       // [s], between two reports of work

using Clock = std::chrono::steady_clock;

}  // namespace

Workshop::Workshop(BenchOptions options, DeviceShop shop) : bench_(std::move(options)), shop_(std::move(shop)) {
  bench_.on_line = [this] {
    if (frame_thread_.load() == std::this_thread::get_id()) ++lines_in_frames_;
  };
  bench_.on_progress = [this](double share, const std::string& what) { return report_work(share, what); };
  bench_.on_news = [this] {
    if (real_time_) post([](Bench&) {});
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
  bench_.stop_beside();
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
    hand_strokes_ = false;
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

// In virtual time work takes none, and nothing is to be shown.
bool Workshop::report_work(double share, const std::string& what) {
  if (!(works_ || publishes_) || thread_.get_id() != std::this_thread::get_id()) return true;
  const double now = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
  if (work_since_ < 0) work_since_ = work_reported_ = now;
  if (now - work_reported_ > k_report) {
    work_reported_ = now;
    work_.store(std::make_shared<const Work>(Work{share, what, now - work_since_, works_}));
  }
  return !ends_.load() && !(works_ && cancelled_.load());
}

bool Workshop::do_orders() {
  std::vector<std::function<void(Bench&)>> orders;
  {
    const std::lock_guard lock(mutex_);
    orders.swap(orders_);
  }
  for (const auto& order : orders) {
    cancelled_.store(false);
    work_since_ = -1;
    works_ = true;
    order(bench_);
    works_ = false;
  }
  work_.store(nullptr);
  return !orders.empty();
}

void Workshop::do_ticks(long ticks, long most) {
  const double share = 1 - std::exp(-k_tick / k_follow);
  for (long i = 0; i < std::min(ticks, most); ++i) {
    if (hand_ && (i == 0 || !real_time_)) follow_hand();
    if (!bench_.is_stroking()) {
      if (!hand_) break;
      continue;
    }
    if (hand_strokes_) {
      bench_.tick_stroke(hand_pose_);
      continue;
    }
    device_.position += share * (device_goal_.position - device_.position);
    device_.pressure += share * (device_goal_.pressure - device_.pressure);
    bench_.tick_stroke(device_);
  }
  if (ticks > most && bench_.is_stroking()) bench_.missed(ticks - most);
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
  if (!bench_.has_changed() && latest_.load()) return;
  work_since_ = -1;
  publishes_ = true;
  try {
    latest_.store(bench_.snapshot());
  } catch (const Cancelled&) {  // the window goes, and nobody looks
  }
  publishes_ = false;
  work_.store(nullptr);
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
  real_time_ = true;
  bench_.start_beside();
  if (!thread_.joinable()) thread_ = std::thread([this] { loop(); });
}

void Workshop::loop() {
  Clock::time_point last = Clock::now();
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      const bool busy = bench_.is_stroking() || bench_.is_playing() || hand_;
      if (orders_.empty() && !ends_)
        woken_.wait_for(lock, std::chrono::duration<double>(busy ? k_tick : k_longest_wait),
                        [this] { return ends_ || !orders_.empty(); });
      if (ends_) break;
    }
    const bool was_stroking = bench_.is_stroking() || hand_, was_playing = bench_.is_playing();
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
  do_orders();  // a file that was to be saved is saved; what takes long ends itself
}

}  // namespace argil::studio
