#include "tools/studio/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "io/file_bytes.h"
#include "io/volume_formats.h"
#include "subdiv/error.h"

namespace argil::studio {

namespace {

constexpr std::size_t k_messages = 40;

}  // namespace

const std::vector<std::string>& block_lines() {
  // Soft clay of 0.5 m: stiff enough to stand, soft enough that a hand's width of travel shows.
  static const std::vector<std::string> lines{"new box 3 3 3 size 0.5 0.5 0.5 at -0.25 -0.25 0",
                                              "levels 2",
                                              "set young_modulus 2e4",
                                              "set density 300",
                                              "set damping 4",
                                              "pin where z < 0.001",
                                              "tool pull radius 0.15 strength 2000 limit 250"};
  return lines;
}

Bench::Bench(BenchOptions options)
    : options_(std::move(options)),
      keeping_(options_.out),
      recent_(options_.settings.empty() ? options_.settings : options_.settings / "recent") {
  shown_recent_ = std::make_shared<const std::vector<std::filesystem::path>>(recent_.all());
  begin_session(".");
}

Bench::~Bench() = default;

void Bench::begin_session(const std::filesystem::path& read_root) {
  stroke_.reset();
  session_.reset();  // closes its journal before the next one takes the name
  keeping_.set_aside();
  sculpt::SessionOptions session;
  session.read_root = read_root;
  session.out = keeping_.folder();
  session.limits = options_.limits;
  session.renderer = options_.renderer;
  session.clock = options_.clock;
  session.print = [this](const std::string& text) {
    const bool guard = text.starts_with("guard") || text.starts_with("the body is frozen");
    say(guard ? MessageKind::warning : MessageKind::note, text);
  };
  session.progress = [this](double share, const std::string& what) { go_on(share, what); };
  session_ = std::make_unique<sculpt::Session>(std::move(session));
  preview({});
  marks_.clear();
  history_.clear();
  lines_ = 0;
  mark_saved({});
  playing_ = played_last_ = false;
  missed_ticks_ = 0;
  changed_ = whole_ = history_changed_ = shade_again_ = true;
}

void Bench::go_on(double share, const std::string& what) const {
  if (on_progress && !on_progress(share, what))
    throw Error(ErrorCode::refused, "it was cancelled, and has changed nothing");
}

void Bench::used(const std::filesystem::path& file) {
  recent_.add(file);
  shown_recent_ = std::make_shared<const std::vector<std::filesystem::path>>(recent_.all());
}

void Bench::mark_saved(const std::filesystem::path& file) {
  file_ = file;
  saved_lines_ = lines_;
  keeping_.kept(session_->options().read_root, file);
  unsaved_ = std::make_shared<const std::vector<UnsavedWork>>(keeping_.unsaved());
}

void Bench::say(MessageKind kind, const std::string& text) {
  messages_.push_back({kind, text, ++message_count_});
  if (messages_.size() > k_messages) messages_.erase(messages_.begin());
  changed_ = true;
}

// The undo stack before the line ran was `depth_before` deep; a change cuts off what had been undone.
void Bench::mark_change(std::size_t depth_before, bool joins_last) {
  const std::size_t depth = session_->undo_depth();
  if (depth <= depth_before) return;
  std::erase_if(marks_, [&](std::size_t mark) { return mark > depth_before; });
  if (joins_last && !marks_.empty() && marks_.back() == depth_before) marks_.pop_back();
  marks_.push_back(depth);
}

void Bench::remember(const std::string& line, std::size_t depth_before, bool repeats) {
  const std::size_t depth = session_->undo_depth();
  if (depth > depth_before) std::erase_if(history_, [&](const HistoryEntry& entry) { return entry.undone; });
  if (repeats && !history_.empty() && history_.back().line == line) {
    history_.back().depth = depth;
    ++history_.back().times;
  } else {
    history_.push_back({.line = line, .depth = depth});
  }
  history_changed_ = true;
  ++lines_;
}

bool Bench::run_one(const std::string& text) {
  if (on_line) on_line();
  const io::SessionLine line = io::parse_session_line(text, "input", 1);
  if (line.tokens.empty()) return true;
  const std::size_t depth = session_->undo_depth();
  session_->run_line(line);
  const std::string written = io::format_line(line.tokens);
  const std::string& name = line.tokens[0].text;
  if (name == "new" || name == "open" || name == "solidify") ++solids_;
  if (name == "tool") ++tool_lines_;
  const sculpt::Effect effect = sculpt::find_command(line).effect;
  if (effect == sculpt::Effect::history)
    ++lines_;
  else
    remember(written, depth, false);
  return true;
}

bool Bench::run(const std::string& line) {
  return run_together({line});
}

bool Bench::run_together(const std::vector<std::string>& lines, bool joins_last) {
  if (stroke_) end_stroke(false);
  preview({});
  const std::size_t depth = session_->undo_depth();
  played_last_ = false;
  bool well = true;
  try {
    for (const std::string& line : lines) run_one(line);
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
    well = false;
  }
  mark_change(depth, joins_last);
  changed_ = whole_ = history_changed_ = shade_again_ = true;
  return well;
}

void Bench::undo() {
  if (stroke_) {
    cancel_stroke();
    return;
  }
  const std::size_t depth = session_->undo_depth();
  if (depth == 0) {
    say(MessageKind::note, "there is nothing to undo");
    return;
  }
  std::size_t below = 0;
  for (const std::size_t mark : marks_)
    if (mark < depth) below = std::max(below, mark);
  set_playing(false);
  run(fmt::format("undo {}", depth - below));
}

void Bench::redo() {
  const std::size_t depth = session_->undo_depth(), top = depth + session_->redo_depth();
  if (top == depth) {
    say(MessageKind::note, "there is nothing to redo");
    return;
  }
  std::size_t above = top;
  for (const std::size_t mark : marks_)
    if (mark > depth) above = std::min(above, mark);
  run(fmt::format("redo {}", above - depth));
}

void Bench::run_all(const std::vector<io::SessionLine>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t depth = session_->undo_depth();
    const std::string line = io::format_line(lines[i].tokens);
    go_on(static_cast<double>(i) / static_cast<double>(lines.size()), line);
    run_one(line);
    mark_change(depth, false);
  }
}

void Bench::open(const std::filesystem::path& wanted) {
  try {
    std::error_code failure;
    const std::filesystem::path saved = options_.save_root / wanted;
    const bool was_saved = !options_.save_root.empty() && std::filesystem::is_regular_file(saved, failure);
    const std::filesystem::path& file = was_saved ? saved : wanted;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (file.extension() != ".argil") {
      begin_session(folder);
      if (run_together({fmt::format("open \"{}\"", file.filename().string()), "levels 1"})) {
        mark_saved({});
        used(file);
      }
    } else {
      const auto lines = io::parse_session(io::read_file(file), file.filename().string());
      begin_session(folder);
      run_all(lines);
      mark_saved(file);
      used(file);
    }
  } catch (const Error& error) {
    say(MessageKind::error, error.where().empty() ? error.what() : error.where() + ": " + error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    say(MessageKind::error, error.what());
  }
  changed_ = whole_ = history_changed_ = shade_again_ = true;
}

void Bench::open_sample(const std::filesystem::path& file) {
  try {
    const auto lines = io::parse_session(io::read_file(file), file.filename().string());
    begin_session(file.parent_path());
    run_all(lines);
    mark_saved({});
  } catch (const Error& error) {
    say(MessageKind::error, error.where().empty() ? error.what() : error.where() + ": " + error.what());
  }
  changed_ = whole_ = history_changed_ = shade_again_ = true;
}

void Bench::begin_block() {
  begin_session(".");
  if (run_together(block_lines())) mark_saved({});
}

void Bench::bring_back(const UnsavedWork& work) {
  try {
    const auto lines = io::parse_session(whole_lines(work.journal), work.journal.filename().string());
    begin_session(work.read_root);
    file_ = work.file;
    run_all(lines);
    keeping_.forget(work);
    say(MessageKind::note, fmt::format("{} changes that were not saved are back", work.changes));
  } catch (const Error& error) {
    // Its files stay until all of it is back.
    say(MessageKind::error, error.where().empty() ? error.what() : error.where() + ": " + error.what());
  }
  unsaved_ = std::make_shared<const std::vector<UnsavedWork>>(keeping_.unsaved());
  changed_ = whole_ = history_changed_ = shade_again_ = true;
}

void Bench::throw_away(const UnsavedWork& work) {
  keeping_.forget(work);
  unsaved_ = std::make_shared<const std::vector<UnsavedWork>>(keeping_.unsaved());
  changed_ = true;
}

void Bench::list(const std::string& typed) {
  listing_ = std::make_shared<const FolderListing>(list_folder(typed));
  changed_ = true;
}

void Bench::look_for_samples() {
  if (!samples_) samples_ = std::make_shared<const std::vector<Sample>>(find_samples(options_.samples));
  changed_ = true;
}

void Bench::write_keys(const std::string& lines) {
  if (options_.settings.empty()) return;
  try {
    std::filesystem::create_directories(options_.settings);
    io::write_file(options_.settings / "keys", lines);
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    say(MessageKind::error, error.what());
  }
}

void Bench::save(const std::filesystem::path& wanted) {
  if (stroke_) end_stroke(false);
  try {
    const std::filesystem::path file = options_.save_root.empty() ? wanted : options_.save_root / wanted;
    const std::filesystem::path way =
        file.lexically_normal().lexically_relative(options_.save_root.lexically_normal());
    if (!options_.save_root.empty() && (way.empty() || *way.begin() == ".."))
      throw Error(ErrorCode::refused, "a script saves beneath its --out folder alone; take a relative name");
    io::write_file(file, io::read_file(session_->journal_path()));
    mark_saved(file);
    used(file);
    say(MessageKind::note, "saved as " + file.string());
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
  }
}

std::string tool_line(const sculpt::Tool& now, const sculpt::Tool& wanted) {
  std::string line;
  if (wanted.radius != now.radius) line += fmt::format(" radius {}", wanted.radius);
  if (wanted.strength != now.strength) line += fmt::format(" strength {}", wanted.strength);
  if (wanted.largest_force != now.largest_force) line += fmt::format(" limit {}", wanted.largest_force);
  if (wanted.falloff != now.falloff) line += " falloff " + wanted.falloff;
  if (wanted.symmetry != now.symmetry)
    line += wanted.symmetry == 0 ? " symmetry none" : fmt::format(" symmetry {}", wanted.symmetry);
  if (wanted.amount != now.amount || wanted.scales != now.scales)
    line += fmt::format(" {} {}", wanted.scales ? "scale" : "value", wanted.amount);
  return line.empty() && wanted.name == now.name ? std::string{} : "tool " + wanted.name + line;
}

void Bench::begin_stroke(const StrokeStart& start) {
  if (stroke_) return;
  preview({});
  set_playing(false);
  played_last_ = false;
  stroke_depth_ = session_->undo_depth();
  stroke_from_.reset();
  stroke_ticks_ = 0;
  try {
    const std::string tool = tool_line(session_->document().state().tool, start.tool);
    if (!tool.empty()) {
      run_one(tool);
      --tool_lines_;
    }
    stroke_ = std::make_unique<sculpt::Stroke>(*session_, start.pose, start.options);
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
    drop_stroke();
  }
  changed_ = true;
}

// Of a stroke that is not to be nothing stays, its choice of tool included.
void Bench::drop_stroke() {
  stroke_.reset();
  const std::size_t depth = session_->undo_depth();
  if (depth > stroke_depth_) run_one(fmt::format("undo {}", depth - stroke_depth_));
  changed_ = whole_ = history_changed_ = shade_again_ = true;
}

void Bench::tick_stroke(const sculpt::StrokePose& device) {
  if (!stroke_) return;
  ++stroke_ticks_;
  try {
    if (!stroke_->tick(device)) return;
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
    cancel_stroke();
  }
  changed_ = true;
}

StrokeNow Bench::stroke_now() const {
  const sculpt::StrokeForce force = stroke_->force();
  const sculpt::Tool& tool = session_->document().state().tool;
  StrokeNow now{force.at, force.force};
  now.at_limit = force.force.norm() >= 0.999 * tool.largest_force;
  if (stroke_->reading()) {
    now.felt = stroke_->reading()->stiffness;
  } else if (stroke_from_) {
    const double way = (force.at - *stroke_from_).norm();
    if (way > 0.01 * tool.radius) now.felt = force.force.norm() / way;
  }
  return now;
}

sculpt::ContactModel Bench::felt(const Eigen::Vector3d& at, sculpt::Tick valid_until) const {
  if (stroke_) return stroke_->felt(valid_until);
  sculpt::ContactModel nothing;
  nothing.point = at;
  nothing.valid_until = valid_until;
  return nothing;
}

void Bench::end_stroke(bool keep) {
  if (!stroke_) return;
  try {
    if (on_line) on_line();
    const std::size_t depth = session_->undo_depth();
    if (stroke_ticks_ == 0) {  // pressed and let go at once
      stroke_->cancel();
      drop_stroke();
      return;
    }
    const std::string line = stroke_->finish();
    stroke_.reset();
    session_->adopt_line(line);
    const double time = session_->document().state().motion->time;
    remember(line, depth, false);
    history_.back().stroke_end = time;
    const bool moved =
        session_->undo_depth() > depth && session_->document().state().motion->velocities.squaredNorm() > 0;
    if (keep && moved) run_one("commit");
  } catch (const Error& error) {
    stroke_.reset();
    say(MessageKind::warning, error.what());
  }
  mark_change(stroke_depth_, false);
  changed_ = whole_ = history_changed_ = shade_again_ = true;
}

void Bench::cancel_stroke() {
  if (!stroke_) return;
  stroke_->cancel();
  drop_stroke();
  say(MessageKind::note, "the stroke was taken back");
}

void Bench::set_playing(bool on) {
  if (on == playing_) return;
  playing_ = on;
  played_last_ = false;
  if (!on) shade_again_ = whole_ = true;
  changed_ = true;
}

void Bench::play_step() {
  if (on_line) on_line();
  const std::size_t depth = session_->undo_depth();
  try {
    session_->run_line(std::string("step 1"));
    remember("step 1", depth, played_last_);
    mark_change(depth, played_last_);
    played_last_ = true;
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
    set_playing(false);
  }
  changed_ = true;
}

void Bench::show(const Shown& shown) {
  shown_ = shown;
  changed_ = whole_ = true;
}

void Bench::preview(std::vector<std::string> lines) {
  if (lines == preview_) return;
  preview_ = std::move(lines);
  preview_changed_ = changed_ = true;
}

}  // namespace argil::studio
