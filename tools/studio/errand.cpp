#include "tools/studio/errand.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace argil::studio {

namespace {

constexpr double k_report = 0.05;  // [s], between two reports

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void Errand::start() {
  const std::lock_guard lock(mutex_);
  if (thread_.joinable()) return;
  ends_ = false;
  thread_ = std::thread([this] { loop(); });
}

void Errand::stop() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    next_ = nullptr;
    cancelled_ = true;
  }
  woken_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Errand::begin(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (ends_) return;
    if (thread_.joinable()) {
      next_ = std::move(job);
      cancelled_ = busy_;
      woken_.notify_all();
      return;
    }
  }
  try {
    job([](double, const char*) {});
  } catch (const Cancelled&) {  // nobody could have cancelled it, but a job may of itself
  }
}

void Errand::cancel() {
  const std::lock_guard lock(mutex_);
  next_ = nullptr;
  cancelled_ = busy_;
}

bool Errand::is_busy() const {
  const std::lock_guard lock(mutex_);
  return busy_ || next_ != nullptr;
}

void Errand::hear(double share, const char* what) {
  if (cancelled_) throw Cancelled();
  const double now = seconds();
  share_ = std::max(share_, std::min(share, 1.0));
  if (now - reported_ < k_report) return;
  reported_ = now;
  work_.store(std::make_shared<const Work>(Work{share_, what, now - since_}));
}

void Errand::loop() {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      woken_.wait(lock, [this] { return ends_ || next_ != nullptr; });
      if (ends_) return;
      job = std::exchange(next_, nullptr);
      busy_ = true;
      cancelled_ = false;
    }
    since_ = reported_ = seconds();
    share_ = -1;
    try {
      job([this](double share, const char* what) { hear(share, what); });
    } catch (const Cancelled&) {  // nothing of it is wanted
    }
    work_.store(nullptr);
    const std::lock_guard lock(mutex_);
    busy_ = false;
  }
}

}  // namespace argil::studio
