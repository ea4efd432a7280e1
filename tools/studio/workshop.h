#pragma once
// Between the window and the session: frames send orders and read the latest snapshot; a thread of its own does the
// orders, moves the stroke under way a tick a millisecond, and lets time run. Off the screen there is no thread:
// `advance` does as much as would have been done in that time, so that a script gives the same bits each time.

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "tools/studio/bench.h"

namespace argil::studio {

class Workshop {
 public:
  explicit Workshop(BenchOptions options);
  ~Workshop();
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  /// Puts an order in the queue. It waits for no other order to be done.
  void post(std::function<void(Bench&)> order);
  void run(std::string line);
  void run_together(std::vector<std::string> lines);
  /// Where the device is; the stroke follows it within some milliseconds.
  void move_device(const sculpt::StrokePose& pose);
  void begin_stroke(const StrokeStart& start);
  void end_stroke(bool keep);
  /// As Bench::preview; of several in the queue only the last is made.
  void preview(std::vector<std::string> lines);
  void cancel_stroke();
  [[nodiscard]] std::shared_ptr<const Snapshot> latest() const { return latest_.load(); }

  /// Real time: a thread that lives as long as this.
  void start();
  /// Virtual time: on the caller's thread, never between frame_begins and frame_ends.
  void advance(double seconds);

  /// The frame's thread says when it draws. Lines that run in a frame are counted: there must be none.
  void frame_begins() { frame_thread_.store(std::this_thread::get_id()); }
  void frame_ends() { frame_thread_.store(std::thread::id{}); }
  long lines_run_in_frames() const { return lines_in_frames_.load(); }

  /// Of tests, while no thread runs.
  Bench& bench() { return bench_; }

 private:
  bool do_orders();
  /// At most so many ticks; the others are missed.
  void do_ticks(long ticks, long most);
  void do_play(double seconds, int most);
  void publish();
  void loop();

  Bench bench_;
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<std::function<void(Bench&)>> orders_;
  bool ends_ = false;
  std::atomic<std::shared_ptr<const Snapshot>> latest_;
  std::atomic<std::thread::id> frame_thread_{};
  std::atomic<long> lines_in_frames_{0};
  // Of the simulation.
  sculpt::StrokePose device_, device_goal_;
  double tick_rest_ = 0, play_rest_ = 0;
  std::thread thread_;
};

}  // namespace argil::studio
