#pragma once
// The session on the work bench: runs lines, strokes and steps, keeps what the window shows of them, and makes
// snapshots. It belongs to one thread at a time, the simulation's; workshop.h is how frames talk to it.

#include <filesystem>
#include <functional>
#include <memory>

#include "sculpt/session.h"
#include "sculpt/stroke.h"
#include "tools/studio/file_browser.h"
#include "tools/studio/safekeeping.h"
#include "tools/studio/snapshot.h"

namespace argil::studio {

struct BenchOptions {
  std::filesystem::path out = "out/studio";  // journal and results; another beside it if a window has taken it
  sculpt::Renderer* renderer = nullptr;      // for the command `render`; may be null
  std::filesystem::path samples{};           // folder of the samples; empty: there are none
  std::filesystem::path settings{};          // folder of the sculptor's settings; empty: none are kept
  /// Makes a film of a session whose files are read beneath `read_root`: of its simulation, or of its last shape
  /// turning. Says where it is. Null: there are no films.
  std::function<std::string(const std::filesystem::path& session, const std::filesystem::path& read_root,
                            bool turntable)>
      film{};
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
  /// A session file begins a new journal; a volume mesh is opened by a line. Errors become messages.
  void open(const std::filesystem::path& file);
  /// Writes the journal there, whole or not at all.
  void save(const std::filesystem::path& file);
  /// A session as one opens it, but as a new one without a name.
  void open_sample(const std::filesystem::path& file);
  /// A new session with a block of clay, which is no loss if nothing is done to it.
  void begin_block();
  /// Work that was not saved becomes the session: every whole line that can run. It stays unsaved.
  void bring_back(const UnsavedWork& work);
  void throw_away(const UnsavedWork& work);
  void film(bool turntable);
  // What dialogues show.
  void list(const std::string& typed);
  void look_for_samples();
  void write_keys(const std::string& lines);
  void write_settings(const std::string& lines);

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
  /// What these lines would make is shown from the next snapshot on, until anything is done; empty: nothing more.
  void preview(std::vector<std::string> lines);
  const Shown& shown() const { return shown_; }
  void say(MessageKind kind, const std::string& text);
  void missed(long ticks) { missed_ticks_ += ticks; }

  sculpt::Session& session() { return *session_; }
  const sculpt::Session& session() const { return *session_; }
  bool has_changed() const { return changed_; }
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot();
  /// Called for each line that runs; for tests.
  std::function<void()> on_line;
  /// Called while a line or a file runs, on this thread; the share done is −1 where it is not known. False ends the
  /// line, which then changes nothing.
  std::function<bool(double share, const std::string& what)> on_progress;

 private:
  void keep(const std::string& file, const std::string& lines);
  void begin_session(const std::filesystem::path& read_root);
  void run_all(const std::vector<io::SessionLine>& lines);
  void mark_saved(const std::filesystem::path& file);
  void used(const std::filesystem::path& file);
  void go_on(double share, const std::string& what) const;
  bool run_one(const std::string& line);
  void mark_change(std::size_t depth_before, bool joins_last);
  void remember(const std::string& line, std::size_t depth_before, bool repeats);
  void draw_scene(Snapshot& next);
  [[nodiscard]] sculpt::PictureRequest request() const;
  void lay_curve(Snapshot& next);
  void mark_layers(Snapshot& next);
  void draw_ghost(Snapshot& next);
  void move_scene(Snapshot& next);
  void read_document(Snapshot& next);

  BenchOptions options_;
  Safekeeping keeping_;
  std::shared_ptr<const std::vector<UnsavedWork>> unsaved_;  // as the window sees it
  RecentFiles recent_;
  std::shared_ptr<const std::vector<std::filesystem::path>> shown_recent_;
  std::shared_ptr<const FolderListing> listing_;
  std::shared_ptr<const std::vector<Sample>> samples_;
  std::unique_ptr<sculpt::Session> session_;
  std::vector<std::size_t> marks_;  // depths of the undo stack at which an action of the user ended
  std::vector<HistoryEntry> history_;
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
  std::vector<std::string> preview_;
  bool preview_changed_ = false;
  std::filesystem::path file_;
  std::size_t lines_ = 0, saved_lines_ = 0;
  std::uint64_t solids_ = 0, tool_lines_ = 0;
  long missed_ticks_ = 0;
  bool changed_ = true, whole_ = true, history_changed_ = true, shade_again_ = true;
  std::shared_ptr<const Snapshot> last_;
};

}  // namespace argil::studio
