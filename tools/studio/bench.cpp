#include "tools/studio/bench.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/error.h"

namespace argil::studio {

namespace {

constexpr std::size_t k_messages = 40;

}  // namespace

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

sculpt::ContactModel Bench::felt_at(const Eigen::Vector3d& at, sculpt::Tick valid_until) const {
  sculpt::ContactModel nothing;
  nothing.point = at;
  nothing.valid_until = valid_until;
  sculpt::add_obstacle_walls(nothing, session_->document(), session_->document().state().tool.radius);
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
