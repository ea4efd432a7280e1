#pragma once
// The session on the work bench: runs lines, strokes and steps, and makes snapshots of what the window shows of
// them. It belongs to one thread at a time, the simulation's; workshop.h is how frames talk to it. Beside it stand
// the darkroom, which makes films, the previewer, which makes ghosts, and the filing of what the disk holds.

#include <filesystem>
#include <functional>
#include <memory>

#include "sculpt/stroke.h"
#include "tools/studio/darkroom.h"
#include "tools/studio/filing.h"
#include "tools/studio/previewer.h"
#include "tools/studio/sitting.h"
#include "tools/studio/snapshot.h"

namespace argil::studio {

struct BenchOptions {
  std::filesystem::path out = "out/studio";  // journal and results; another beside it if a window has taken it
  sculpt::Renderer* renderer = nullptr;      // for the command `render`; may be null
  std::filesystem::path samples{};           // folder of the samples; empty: there are none
  std::filesystem::path settings{};          // folder of the sculptor's settings; empty: none are kept
  FilmMaker film{};                          // null: there are no films
  /// Not empty, for a script that nobody watches: sessions are saved beneath it alone, and relative names mean
  /// there.
  std::filesystem::path save_root{};
  sculpt::Limits limits;
  fem::Clock clock = nullptr;
};

struct StrokeStart {
  sculpt::StrokePose pose;  // where it takes hold
  sculpt::Tool tool;
  sculpt::StrokeOptions options;
};
/// The line that makes `wanted` of a tool that is `now`; empty if they are the same.
[[nodiscard]] std::string tool_line(const sculpt::Tool& now, const sculpt::Tool& wanted);

/// What a new window begins with: a block of clay on its foot, ready to pull.
[[nodiscard]] const std::vector<std::string>& block_lines();

class Bench {
 public:
  explicit Bench(BenchOptions options);
  ~Bench();

  /// Runs a line of the session. What it says, and an Error, become messages. Returns whether it ran.
  bool run(const std::string& line);
  /// Lines that are undone together; with `joins_last`, together with what was done last.
  bool run_together(const std::vector<std::string>& lines, bool joins_last = false);
  void undo();
  void redo();
  /// A session file begins a new journal; a volume mesh is opened by a line. Errors become messages; if it is
  /// cancelled, the session before goes on.
  void open(const std::filesystem::path& file);
  /// Writes the journal there, whole or not at all.
  void save(const std::filesystem::path& file);
  /// A session as one opens it, but as a new one without a name.
  void open_sample(const std::filesystem::path& file);
  /// A new session with a block of clay, which is no loss if nothing is done to it.
  void begin_block();
  /// Work that was not saved becomes the session: every whole line that can run. It stays unsaved.
  void bring_back(const UnsavedWork& work);
  /// Write the sculptor's own keys, and settings (settings_file.h). Errors become messages.
  void write_keys(const std::string& lines);
  void write_settings(const std::string& lines);
  /// Of the session as it is now, in the darkroom: of its simulation, or of its last shape turning.
  void film(bool turntable);

  /// The tool becomes the document's if it is not; that and the stroke are undone together.
  void begin_stroke(const StrokeStart& start);
  void tick_stroke(const sculpt::StrokePose& device);
  /// With `keep`, the new shape is the shape at rest from then on.
  void end_stroke(bool keep);
  void cancel_stroke();
  bool is_stroking() const { return stroke_ != nullptr; }
  /// What a device should feel until that tick: one that draws the stroke under way, or one that is at a place.
  [[nodiscard]] sculpt::ContactModel felt_by_stroke(sculpt::Tick valid_until) const {
    return stroke_->felt(valid_until);
  }
  [[nodiscard]] sculpt::ContactModel felt_at(const Eigen::Vector3d& at, sculpt::Tick valid_until) const;

  void set_playing(bool on);
  bool is_playing() const { return playing_; }
  void play_step();

  void show(const Shown& shown);
  /// What these lines would make is shown as soon as it is known, until anything is done; empty: nothing more.
  void preview(std::vector<std::string> lines) { previewer_.want(std::move(lines)); }
  const Shown& shown() const { return shown_; }
  void say(MessageKind kind, const std::string& text);
  void missed(long ticks) { missed_ticks_ += ticks; }

  sculpt::Session& session() { return *sitting_.session; }
  const sculpt::Session& session() const { return *sitting_.session; }
  Filing& filing() { return filing_; }
  Darkroom& darkroom() { return darkroom_; }
  const Darkroom& darkroom() const { return darkroom_; }
  const Previewer& previewer() const { return previewer_; }
  /// Real time: films and ghosts are made by threads of their own, until they are stopped.
  void start_beside();
  void stop_beside();
  [[nodiscard]] bool has_changed() const;
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot();
  /// Called for each line that runs; for tests.
  std::function<void()> on_line;
  /// Called while a line or a file runs, and while a snapshot is made, on this thread; the share done is −1 where
  /// it is not known. False ends the line, which then changes nothing.
  std::function<bool(double share, const std::string& what)> on_progress;
  /// Called by other threads when there is something new to show.
  std::function<void()> on_news;

 private:
  void keep(const std::string& file, const std::string& lines);
  /// A session after the present one, whose journal has this name.
  [[nodiscard]] Sitting new_sitting(const std::filesystem::path& read_root, const std::string& journal);
  /// Begins a session and fills it. Cancelled, the one before goes on; after any other Error the new one stays as
  /// far as it came.
  void load(const std::filesystem::path& read_root, const std::function<void()>& fill);
  void run_all(const std::vector<std::string>& lines);
  void mark_saved(const std::filesystem::path& file);
  void show_all_anew();
  void say(const Error& error);
  void go_on(double share, const std::string& what) const;
  void run_one(const std::string& line);
  void draw_scene(Snapshot& next);
  [[nodiscard]] sculpt::PictureRequest request() const;
  void lay_curve(Snapshot& next);
  void mark_layers(Snapshot& next);
  void draw_ghost(Snapshot& next);
  void tell_session(Snapshot& next);
  void move_scene(Snapshot& next);
  void read_document(Snapshot& next);

  BenchOptions options_;
  Filing filing_;
  Sitting sitting_;
  std::size_t file_line_ = 0, file_lines_ = 0;  // of the file that is being read, how many have run of how many
  std::shared_ptr<const std::vector<HistoryEntry>> shown_history_;
  std::vector<Message> messages_;
  std::uint64_t message_count_ = 0;
  void drop_stroke();
  [[nodiscard]] StrokeNow stroke_now() const;

  std::unique_ptr<sculpt::Stroke> stroke_;
  std::size_t stroke_depth_ = 0;  // of the undo stack before it
  long stroke_ticks_ = 0;
  std::optional<Eigen::Vector3d> stroke_from_;
  bool playing_ = false, played_last_ = false;
  Shown shown_;
  long missed_ticks_ = 0;
  bool changed_ = true, whole_ = true, history_changed_ = true, shade_again_ = true;
  std::shared_ptr<const Snapshot> last_;
  Previewer previewer_;
  Darkroom darkroom_;
};

}  // namespace argil::studio
