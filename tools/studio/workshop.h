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
#include "tools/studio/hand.h"

namespace argil::studio {

/// What a stroke of a device begins with where it begins: the brush that lies ready.
struct ReadyBrush {
  sculpt::Tool tool;
  bool keep = true;                            // the shape, at the end of the stroke
  bool pressed = true, scales_radius = false;  // whether pressure counts, and what it scales (sculpt/stroke.h)
  // Where its workspace lies: over this ball, seen along `view` from the eye.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), view = Eigen::Vector3d::UnitY();
  double radius = 1;  // [m]
};

/// The device other than the mouse, as a frame shows it.
struct DeviceNow {
  std::string name;
  HandSample sample;
  sculpt::Tick missed = 0;
};

class Workshop {
 public:
  explicit Workshop(BenchOptions options, DeviceShop shop = {});
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

  // Another device than the mouse. It sculpts while its first button is down; the mouse stays there beside it.
  /// Takes the device of this name, or none for "mouse". One that cannot be had, or that falls silent, is told and
  /// leaves the mouse.
  void use_device(const std::string& name);
  void use_device(std::string name, std::shared_ptr<sculpt::Device> device);
  void lay_ready(const ReadyBrush& brush);
  /// Null: there is none.
  [[nodiscard]] std::shared_ptr<const DeviceNow> device() const { return device_now_.load(); }
  void list_devices();
  /// As of the last list_devices; null before.
  [[nodiscard]] std::shared_ptr<const std::vector<DeviceChoice>> devices() const { return choices_.load(); }

  [[nodiscard]] std::shared_ptr<const Snapshot> latest() const { return latest_.load(); }

  /// What runs now, if it takes a while, which orders wait for; null: nothing. A frame may show it and cancel it.
  [[nodiscard]] std::shared_ptr<const Work> work() const { return work_.load(); }
  /// The line that runs ends as soon as it can and changes nothing.
  void cancel_work() { cancelled_.store(true); }
  /// A film, and a ghost, that are made beside it; null: none.
  [[nodiscard]] std::shared_ptr<const Work> film_work() const { return bench_.darkroom().work(); }
  void cancel_film() { bench_.darkroom().cancel(); }
  [[nodiscard]] std::shared_ptr<const Work> preview_work() const { return bench_.previewer().work(); }

  /// Real time: a thread that lives as long as this.
  void start();
  [[nodiscard]] bool is_running() const { return thread_.joinable(); }
  /// Virtual time: on the caller's thread, never between frame_begins and frame_ends.
  void advance(double seconds);

  /// The frame's thread says when it draws. Lines that run in a frame are counted: there must be none.
  void frame_begins() { frame_thread_.store(std::this_thread::get_id()); }
  void frame_ends() { frame_thread_.store(std::thread::id{}); }
  bool is_in_frame() const { return frame_thread_.load() == std::this_thread::get_id(); }
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
  bool report_work(double share, const std::string& what);
  // The hand: takes its newest sample, and gives it what it should feel.
  void follow_hand();
  void place_hand();
  void take_hand(std::unique_ptr<Hand> hand);
  void drop_hand(const std::string& reason);

  Bench bench_;
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<std::function<void(Bench&)>> orders_;
  std::atomic<bool> ends_{false};

  std::atomic<std::shared_ptr<const Snapshot>> latest_;
  std::atomic<std::shared_ptr<const Work>> work_;
  std::atomic<bool> cancelled_{false};
  // At an order, which can be cancelled, or at a snapshot; strokes and play are not to be waited for.
  bool works_ = false, publishes_ = false;
  double work_since_ = -1, work_reported_ = 0;  // [s]
  std::atomic<std::thread::id> frame_thread_{};
  std::atomic<long> lines_in_frames_{0};
  // Of the simulation.
  sculpt::StrokePose device_, device_goal_;
  double tick_rest_ = 0, play_rest_ = 0;
  // Of the device other than the mouse.
  DeviceShop shop_;
  std::unique_ptr<Hand> hand_;
  sculpt::StrokePose hand_pose_;
  ReadyBrush ready_;
  bool is_ready_ = false;  // a brush was laid ready
  bool hand_pressed_ = false, hand_strokes_ = false, real_time_ = false;
  sculpt::Tick hand_heard_ = 0;  // when it was last well
  std::atomic<std::shared_ptr<const DeviceNow>> device_now_;
  std::atomic<std::shared_ptr<const std::vector<DeviceChoice>>> choices_;
  std::thread thread_;
};

}  // namespace argil::studio
