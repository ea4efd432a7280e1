#pragma once
// One piece of work at a time beside the simulation: on a thread of its own, so that strokes and other orders go on
// meanwhile; in virtual time, where nobody waits, at once. A newer piece takes the place of the one under way.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "subdiv/progress.h"

namespace argil::studio {

/// What takes a while, as frames show it.
struct Work {
  double share = -1;  // 0 … 1; −1: not known
  std::string what;
  double seconds = 0;   // that it has gone on
  bool can_end = true;  // before it is done, and then nothing of it stays
};

class Errand {
 public:
  /// Tells the listener now and then; that throws Cancelled once nobody wants the work any more, which then ends.
  /// Nothing else may be thrown.
  using Job = std::function<void(const Progress::Listener& progress)>;

  Errand() = default;
  /// Ends what is under way, and waits for that.
  ~Errand() { stop(); }
  Errand(const Errand&) = delete;
  Errand& operator=(const Errand&) = delete;

  /// Real time: work is done by a thread from here on.
  void start();
  /// Ends what is under way, and waits for that; there is no thread any more.
  void stop();
  /// What is under way ends early, then this is done. Without a thread it is done before this returns.
  void begin(Job job);
  void cancel();
  [[nodiscard]] bool is_busy() const;
  /// For frames: waits for nothing. Null: nothing is under way, or it has not told anything yet.
  [[nodiscard]] std::shared_ptr<const Work> work() const { return work_.load(); }

 private:
  void loop();
  void hear(double share, const char* what);

  mutable std::mutex mutex_;
  std::condition_variable woken_;
  Job next_;
  bool busy_ = false, ends_ = false;
  std::atomic<bool> cancelled_{false};
  std::atomic<std::shared_ptr<const Work>> work_;
  double since_ = 0, reported_ = 0, share_ = -1;  // of the job, on its thread
  std::thread thread_;
};

}  // namespace argil::studio
