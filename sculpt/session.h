#pragma once
// A session: a document, its history, its journal, and the world outside that commands may reach (folders,
// printing, the renderer, progress). The same object runs a file, a line typed by hand, and a test.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sculpt/column_changes.h"
#include "sculpt/command.h"
#include "sculpt/document.h"
#include "sculpt/line_samples.h"
#include "sculpt/renderer.h"
#include "sculpt/step_trace.h"

namespace argil::sculpt {

class Recording;

/// What one simulation step cost and did.
struct StepRecord {
  fem::StepReport report;                               // over its substeps; no preconditioner: explicit, or frozen
  fem::GuardFinding finding = fem::GuardFinding::none;  // what the guard saw, and what helped
  fem::GuardRemedy remedy = fem::GuardRemedy::none;
  double share = 1;  // of the force out of balance that an eased step let through
  int substeps = 1;
  double ms = 0;
};

struct MeasureRecord {
  std::string name;
  double value = 0;
  int line = 0;
};

struct ToolForce {
  Eigen::Vector3d at, force;                     // where [m], and on the body [N]
  std::vector<Eigen::Vector3d> curve_handles{};  // of a curve, where they are then [m]
};

/// An `expect` that did not hold.
struct FailedExpectation {
  std::string message, where;
};

struct SessionOptions {
  std::filesystem::path read_root = ".";         // files are read beneath it
  std::filesystem::path out = "out";             // and written beneath this
  std::filesystem::path hash_trace;              // empty: none
  std::filesystem::path step_trace;              // a CSV row a step (step_trace.h); empty: none
  std::map<std::string, std::string> overrides;  // command → arguments, `--set space=cubic`
  long until_step = -1;                          // stop after so many simulation steps; −1: run all
  bool write_journal = true;
  std::string journal = "journal.argil";  // its name beneath `out`
  Limits limits;
  Renderer* renderer = nullptr;  // null: pictures are skipped, and said so
  fem::Clock clock = nullptr;
  std::function<void(const std::string&)> print;  // messages for the user
  /// Of a file, or of a line alone: 0 … 1 and never falling, or −1 where it is not known. What it throws ends the
  /// line, which then changes nothing.
  std::function<void(double fraction, const std::string& what)> progress;
  std::function<void(const Document&)> stepped;  // after every step of the simulation, as for a film
};

class Session {
 public:
  explicit Session(SessionOptions options);
  ~Session();

  /// Runs a whole file. Stops at the first Error, which is thrown on with its place; failed expectations are
  /// collected.
  void run_text(const std::string& text, const std::string& file_name);
  /// Runs one line. A command that throws leaves the document as it was.
  void run_line(const io::SessionLine& line);
  void run_line(const std::string& text);

  // For what changes the document outside of a line, as a stroke of the mouse does.
  /// What changes from here on is one change of the session; returns what is before it.
  const State& begin_change();
  /// Takes back what was assigned since, and its steps.
  void abandon_change(std::size_t step_count);
  /// Journals and traces a line whose change has been made, as if it had run now.
  /// @throws Error (bad_input, not_found) if the line is none that could run.
  void adopt_line(const std::string& text);

  Document& document() { return document_; }
  const Document& document() const { return document_; }
  /// The force of the last stroke where it held the body, or of a probe as deep as it pressed, until anything else
  /// changes: for pictures and measures, not part of the state.
  const std::optional<ToolForce>& tool_force() const { return tool_force_; }
  void show_tool_force(const ToolForce& force) { tool_force_ = force; }
  const SessionOptions& options() const { return options_; }

  // For commands.
  /// Takes the next state; `delta` is of a topology edit that has been applied, `columns` what is to be applied to
  /// the arrays that the next state shares with the present one.
  void change(State next, subdiv::Delta delta = {}, ColumnChanges columns = {});
  void undo(long count);
  void redo(long count);
  std::size_t undo_depth() const { return done_.size(); }
  std::size_t redo_depth() const { return undone_.size(); }
  std::filesystem::path path_to_read(const std::string& name) const;
  std::filesystem::path path_to_write(const std::string& name) const;
  void print(const std::string& message) const;
  /// Tells how much of the line that runs is done; −1 where that is not known. It never falls within a line, and
  /// once the line has changed the document, nothing more is told: what is done is done.
  void progress(double fraction, const std::string& what);
  /// For what takes long in the line that runs, of which each thing that begins counts as most of what is left.
  [[nodiscard]] Progress progress_of(const char* what) const { return Progress(stage_listener_, what); }
  /// To be asked before `count` steps are taken (as many as `until_step` lets through). @throws Error
  /// (limit_exceeded).
  void require_steps(double count);
  /// Called for every simulation step, with the loads of the tool that acted: counts and traces.
  void step_done(const StepRecord& record, const fem::Loads& tool = {});
  /// True once `until_step` is reached: long commands end early.
  bool stop_requested() const;
  void expectation_failed(const std::string& message);
  void measured(const std::string& name, double value);
  /// Keeps a table for plots; one of the same name before goes.
  void sampled(SampledLine line);
  /// Has what every step from now on gives written (recording.h). @throws Error (bad_input) if its name is one that
  /// is being recorded.
  void record(std::unique_ptr<Recording> recording);
  const std::vector<std::unique_ptr<Recording>>& recordings() const { return recordings_; }
  /// Ends those of this name, or all if it is empty, and says what they wrote; the end of run_text does so too.
  /// @throws Error (bad_input) if one cannot be written to its end; it is then gone.
  void end_recordings(const std::string& name = {});
  /// "file:line:column" of the line that runs.
  std::string place() const;

  // What happened.
  const std::vector<StepRecord>& steps() const { return steps_; }
  const std::vector<FailedExpectation>& failed() const { return failed_; }
  const std::vector<MeasureRecord>& measures() const { return measures_; }
  const std::vector<SampledLine>& samples() const { return samples_; }
  std::filesystem::path journal_path() const { return journal_path_; }
  /// Gives the journal another name beneath `out`, in place of any file that has it. @throws Error (bad_input).
  void rename_journal(const std::string& name);
  int expectations = 0;
  int skipped_pictures = 0;

 private:
  struct Done {
    State before, after;
    subdiv::Delta delta;
    ColumnChanges columns;
  };
  void drop_what_lost_its_points(State& next, bool topology_changed) const;
  void trace(const std::string& what);
  void journal(const std::string& line);
  void open_journal(std::ios::openmode how);
  void execute(const io::SessionLine& line);
  void hear_stage(double share, const char* what);

  SessionOptions options_;
  Document document_;
  State start_;  // before the command that runs
  std::vector<Done> done_, undone_;
  std::optional<ToolForce> tool_force_;
  std::vector<StepRecord> steps_;
  std::vector<FailedExpectation> failed_;
  std::vector<MeasureRecord> measures_;
  std::vector<SampledLine> samples_;
  std::vector<std::unique_ptr<Recording>> recordings_;
  io::SessionLine current_;
  std::filesystem::path journal_path_;
  std::ofstream journal_, trace_;
  StepTrace step_trace_;
  std::size_t lines_ = 0, line_count_ = 0;
  std::size_t first_step_ = 0;  // of the line that runs
  double wanted_steps_ = 0;     // of that line, as far as is known
  std::uint64_t columns_stamp_ = 0;
  // Progress of the line that runs (progress.h).
  Progress::Listener stage_listener_;
  bool runs_line_ = false;
  std::size_t first_depth_ = 0;  // of the undo stack before it
  double told_ = 0, stage_from_ = 0, stage_share_ = 0;
  std::string stage_;
};

}  // namespace argil::sculpt
