#include "sculpt/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/obstacles.h"
#include "sculpt/paths.h"
#include "sculpt/recording.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

constexpr double k_stage = 0.7;  // of what is left of a line, that a stage of it counts as

/// Says that a line runs, for as long as this lives.
class RunningLine {
 public:
  explicit RunningLine(bool& runs) : runs_(runs) { runs_ = true; }
  ~RunningLine() { runs_ = false; }
  RunningLine(const RunningLine&) = delete;
  RunningLine& operator=(const RunningLine&) = delete;

 private:
  bool& runs_;
};

}  // namespace

Session::Session(SessionOptions options) : options_(std::move(options)) {
  document_.limits = options_.limits;
  if (options_.progress) {
    stage_listener_ = [this](double share, const char* what) { hear_stage(share, what); };
    document_.progress = Progress(stage_listener_);
  }
  std::error_code failure;
  std::filesystem::create_directories(options_.out, failure);
  if (failure)
    throw Error(ErrorCode::bad_input,
                fmt::format("the folder '{}' for results cannot be made ({}); choose another with --out",
                            options_.out.string(), failure.message()));
  if (!options_.hash_trace.empty()) {
    trace_.open(options_.hash_trace, std::ios::trunc);
    if (!trace_)
      throw Error(ErrorCode::bad_input,
                  fmt::format("the hash trace '{}' cannot be written; choose another file with --hash-trace",
                              options_.hash_trace.string()));
  }
  if (!options_.step_trace.empty()) step_trace_.open(options_.step_trace);
  if (options_.write_journal) {
    journal_path_ = options_.out / options_.journal;
    // What an earlier program left here may be all that there is of someone's work.
    const std::string previous = journal_path_.stem().string() + ".previous.argil";
    std::filesystem::rename(journal_path_, options_.out / previous, failure);
    open_journal(std::ios::trunc);
    journal_ << io::k_session_header << std::endl;
  }
}

Session::~Session() {
  for (const auto& recording : recordings_) try {
      (void)recording->finish(document_);
    } catch (const std::exception&) {  // what a program that ends can no longer tell
    }
}

void Session::run_text(const std::string& text, const std::string& file_name) {
  const auto lines = io::parse_session(text, file_name);
  line_count_ = lines.size();
  lines_ = 0;
  for (const io::SessionLine& line : lines) {
    if (stop_requested()) break;
    told_ = 0;
    progress(0, line.text);
    run_line(line);
    ++lines_;
  }
  end_recordings();
  if (line_count_ > 0 && options_.progress) options_.progress(1, "");
  line_count_ = lines_ = 0;
}

void Session::run_line(const std::string& text) {
  run_line(io::parse_session_line(text, "input", 1));
}

void Session::run_line(const io::SessionLine& line) {
  if (line.tokens.empty()) return;
  const std::string& name = line.tokens[0].text;
  // `--set levels=1` stands in for the session's own line; what has no line of its own comes after the solid does.
  const auto replaced = options_.overrides.find(name);
  if (replaced != options_.overrides.end()) {
    execute(io::parse_session_line(name + " " + replaced->second, "--set " + name, 1));
    return;
  }
  execute(line);
  if (name != "new" && name != "open") return;
  for (const char* setting : {"space", "model", "integrator"}) {
    const auto found = options_.overrides.find(setting);
    if (found != options_.overrides.end())
      execute(
          io::parse_session_line(std::string(setting) + " " + found->second, std::string("--set ") + setting, 1));
  }
}

void Session::execute(const io::SessionLine& line) {
  current_ = line;
  const Command& command = find_command(line);
  const Arguments arguments = bind(command, line);
  start_ = document_.state();
  const std::size_t depth = done_.size(), steps = steps_.size();
  first_depth_ = depth;
  first_step_ = steps;
  wanted_steps_ = told_ = stage_from_ = stage_share_ = 0;
  stage_.clear();
  const RunningLine running(runs_line_);
  const auto take_back = [&] {  // a failed command changes nothing
    if (done_.size() != depth || command.effect != Effect::state) return;
    document_.assign(start_);
    steps_.resize(steps);
  };
  try {
    command.run(*this, arguments);
  } catch (const Cancelled&) {
    take_back();
    throw;
  } catch (const Error& error) {
    take_back();
    if (error.where().starts_with(current_.file + ":")) throw;
    // A fault within a file that a command reads has its own place; the line that reads it is named as well.
    if (error.where().find(':') != std::string::npos)
      throw Error(error.code(), std::string(error.what()) + " (" + command.name + " in " + place() + ")",
                  error.where());
    const std::string detail = error.where().empty() ? "" : " (" + error.where() + ")";
    throw Error(error.code(), command.name + ": " + error.what() + detail, place());
  } catch (...) {
    take_back();
    throw;
  }
  journal(io::format_line(line.tokens));
  trace(command.name);
}

const State& Session::begin_change() {
  start_ = document_.state();
  return start_;
}

void Session::abandon_change(std::size_t step_count) {
  document_.assign(start_);
  steps_.resize(std::min(step_count, steps_.size()));
}

void Session::adopt_line(const std::string& text) {
  const io::SessionLine line = io::parse_session_line(text, "input", 1);
  const Command& command = find_command(line);
  (void)bind(command, line);
  current_ = line;
  journal(io::format_line(line.tokens));
  trace(command.name);
}

std::string Session::place() const {
  return current_.tokens.empty() ? std::string{} : io::place_of(current_, current_.tokens[0]);
}

/// What belongs to points of the surface or of elements goes where these become others.
void Session::drop_what_lost_its_points(State& next, bool topology_changed) const {
  const bool same_points = !topology_changed && next.solid == start_.solid && next.level == start_.level &&
                           next.rules == start_.rules && next.space == start_.space && next.split == start_.split;
  const bool committed = next.rest != start_.rest && *next.rest == next.motion->positions;
  if (!same_points || (next.rest != start_.rest && !committed)) drop_grips(next);
  // In cubic space the fields decide which cells become one element.
  const bool same_elements =
      same_points && next.rest == start_.rest && (next.space != fem::Space::cubic || next.fields == start_.fields);
  if (!next.flow || same_elements) return;
  next.flow = nullptr;
  print(
      "the body is other than the one that flowed, so that it forgets its flow and draws back to its rest shape; "
      "`commit` before such a change keeps the shape");
}

void Session::change(State next, subdiv::Delta delta, ColumnChanges columns) {
  // Before the columns are applied: what is dropped here takes a copy of the motion, and leaves the one before
  // alone.
  drop_what_lost_its_points(next, !delta.empty() || !columns.empty());
  if (!columns.empty()) {
    apply(next, columns);
    next.columns_stamp = ++columns_stamp_;
  }
  done_.push_back({start_, next, std::move(delta), std::move(columns)});
  undone_.clear();
  tool_force_.reset();
  start_ = next;
  document_.assign(std::move(next));
}

void Session::undo(long count) {
  if (static_cast<std::size_t>(count) > done_.size())
    throw Error(
        ErrorCode::bad_input,
        fmt::format("there are {} commands to undo, not {}; `undo all` takes back every one", done_.size(), count));
  tool_force_.reset();
  for (long i = 0; i < count; ++i) {
    Done& last = done_.back();
    if (!last.delta.empty()) subdiv::undo(*last.after.solid, last.delta);
    if (!last.columns.empty()) take_back(last.after, last.columns);
    document_.assign(last.before);
    undone_.push_back(std::move(last));
    done_.pop_back();
  }
}

void Session::redo(long count) {
  if (static_cast<std::size_t>(count) > undone_.size())
    throw Error(ErrorCode::bad_input,
                fmt::format("there are {} commands to redo, not {}; `redo all` brings back every one",
                            undone_.size(), count));
  tool_force_.reset();
  for (long i = 0; i < count; ++i) {
    Done& next = undone_.back();
    if (!next.delta.empty()) subdiv::redo(*next.after.solid, next.delta);
    if (!next.columns.empty()) apply(next.after, next.columns);
    document_.assign(next.after);
    done_.push_back(std::move(next));
    undone_.pop_back();
  }
}

std::filesystem::path Session::path_to_read(const std::string& name) const {
  return path_beneath(options_.read_root, name, "the session's own folder");
}

std::filesystem::path Session::path_to_write(const std::string& name) const {
  const auto path = path_beneath(options_.out, name, "the folder given with --out");
  std::error_code failure;
  std::filesystem::create_directories(path.parent_path(), failure);
  if (failure)
    throw Error(ErrorCode::bad_input, fmt::format("the folder of '{}' cannot be made ({}); choose another name",
                                                  name, failure.message()));
  return path;
}

void Session::print(const std::string& message) const {
  if (options_.print) options_.print(message);
}

void Session::progress(double fraction, const std::string& what) {
  if (!options_.progress || (runs_line_ && done_.size() != first_depth_)) return;
  const bool is_known = fraction >= 0 || line_count_ > 0;
  told_ = std::clamp(fraction, told_, 1.0);
  const double share =
      line_count_ > 0 ? (static_cast<double>(lines_) + told_) / static_cast<double>(line_count_) : told_;
  options_.progress(is_known ? share : -1, what);
}

// How many things a line has to do is not known before; in a step it is the step that they are parts of.
void Session::hear_stage(double share, const char* what) {
  if (!runs_line_) {
    if (options_.progress) options_.progress(-1, what);
    return;
  }
  if (share == 0 || stage_ != what) {
    stage_ = what;
    stage_from_ = stage_share_;
  }
  stage_share_ = std::max(stage_share_, stage_from_ + k_stage * (1 - stage_from_) * std::min(share, 1.0));
  const double taken = static_cast<double>(steps_.size() - first_step_);
  progress(wanted_steps_ > 0 ? std::min(1.0, (taken + stage_share_) / wanted_steps_) : stage_share_, what);
}

void Session::step_done(const StepRecord& record, const fem::Loads& tool) {
  steps_.push_back(record);
  if (step_trace_.is_open())
    step_trace_.write(step_trace_row(document_, tool, record, steps_.size(), current_.number));
  trace("step");
  for (const auto& recording : recordings_) recording->step(document_);
  if (options_.stepped) options_.stepped(document_);
  stage_from_ = stage_share_ = 0;
  const double taken = static_cast<double>(steps_.size() - first_step_);
  const bool is_known = runs_line_ && wanted_steps_ > 0;
  progress(is_known ? std::min(1.0, taken / wanted_steps_) : -1, fmt::format("step {}", steps_.size()));
}

void Session::require_steps(double count) {
  const double taken = static_cast<double>(steps_.size());
  if (options_.until_step >= 0) count = std::min(count, static_cast<double>(options_.until_step) - taken);
  if (taken + count > static_cast<double>(options_.limits.steps))
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("{:.0f} steps after {:.0f} are more than {}; raise --max-steps", count, taken,
                            options_.limits.steps));
  wanted_steps_ = std::max(wanted_steps_, taken + count - static_cast<double>(first_step_));
}

bool Session::stop_requested() const {
  return options_.until_step >= 0 && steps_.size() >= static_cast<std::size_t>(options_.until_step);
}

void Session::expectation_failed(const std::string& message) {
  failed_.push_back({message, place()});
}

void Session::measured(const std::string& name, double value) {
  measures_.push_back({name, value, current_.number});
}

void Session::sampled(SampledLine line) {
  std::erase_if(samples_, [&](const SampledLine& before) { return before.name == line.name; });
  samples_.push_back(std::move(line));
}

void Session::record(std::unique_ptr<Recording> recording) {
  for (const auto& other : recordings_)
    if (other->name() == recording->name())
      throw Error(ErrorCode::bad_input,
                  fmt::format("'{0}' is being recorded; `record stop {0}` ends that first, or "
                              "choose another name",
                              recording->name()));
  recordings_.push_back(std::move(recording));
}

void Session::end_recordings(const std::string& name) {
  const auto chosen = std::stable_partition(recordings_.begin(), recordings_.end(), [&](const auto& recording) {
    return !name.empty() && recording->name() != name;
  });
  std::vector<std::unique_ptr<Recording>> ended(std::make_move_iterator(chosen),
                                                std::make_move_iterator(recordings_.end()));
  recordings_.erase(chosen, recordings_.end());
  for (const auto& recording : ended) print(recording->finish(document_));
}

void Session::trace(const std::string& what) {
  if (!trace_.is_open()) return;
  trace_ << current_.number << ' ' << what << ' ' << steps_.size() << ' '
         << fmt::format("{:016x}", document_.state_hash()) << '\n';
}

void Session::open_journal(std::ios::openmode how) {
  journal_.open(journal_path_, how);
  if (!journal_)
    throw Error(ErrorCode::bad_input,
                fmt::format("the journal '{}' cannot be written; choose another folder with --out",
                            journal_path_.string()));
}

void Session::rename_journal(const std::string& name) {
  if (!journal_.is_open()) return;
  journal_.close();
  std::error_code failure;
  const std::filesystem::path to = options_.out / name;
  std::filesystem::rename(journal_path_, to, failure);
  if (!failure) journal_path_ = to;
  open_journal(std::ios::app);
  if (failure)
    throw Error(ErrorCode::bad_input,
                fmt::format("the journal cannot be written as '{}' ({}); choose another folder "
                            "with --out",
                            to.string(), failure.message()));
}

void Session::journal(const std::string& line) {
  if (!journal_.is_open()) return;
  journal_ << line << std::endl;  // flushed, so that a killed program loses at most the command in progress
}

}  // namespace argil::sculpt
