#include "tools/studio/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "subdiv/error.h"

namespace argil::studio {

namespace {

constexpr std::size_t k_messages = 40;
constexpr const char* k_journal = "journal.argil";

}  // namespace

Bench::Bench(BenchOptions options)
    : options_(std::move(options)),
      filing_(options_.out, options_.settings, options_.samples),
      previewer_([this] {
        if (on_news) on_news();
      }),
      darkroom_(options_.film, [this] {
        if (on_news) on_news();
      }) {
  sitting_ = new_sitting(".", k_journal);
  mark_saved({});
}

Bench::~Bench() = default;

void Bench::start_beside() {
  previewer_.start();
  darkroom_.start();
}

void Bench::stop_beside() {
  previewer_.stop();
  darkroom_.stop();
}

bool Bench::has_changed() const {
  return changed_ || filing_.has_changed() || previewer_.has_changed() || darkroom_.has_news();
}

void Bench::show_all_anew() {
  changed_ = whole_ = history_changed_ = shade_again_ = true;
}

Sitting Bench::new_sitting(const std::filesystem::path& read_root, const std::string& journal) {
  sculpt::SessionOptions session;
  session.read_root = read_root;
  session.out = filing_.folder();
  session.journal = journal;
  session.limits = options_.limits;
  session.renderer = options_.renderer;
  session.clock = options_.clock;
  session.print = [this](const std::string& text) {
    const bool guard = text.starts_with("guard") || text.starts_with("the body is frozen");
    say(guard ? MessageKind::warning : MessageKind::note, text);
  };
  session.progress = [this](double share, const std::string& what) {
    if (file_lines_ == 0) return go_on(share, what);
    go_on((static_cast<double>(file_line_) + std::max(0.0, share)) / static_cast<double>(file_lines_), what);
  };
  Sitting next;
  next.session = std::make_unique<sculpt::Session>(std::move(session));
  next.solids = sitting_.solids;
  next.tool_lines = sitting_.tool_lines;
  return next;
}

void Bench::load(const std::filesystem::path& read_root, const std::function<void()>& fill) {
  if (stroke_) end_stroke(false);
  preview({});
  set_playing(false);
  // Until all is there, the journal of the session before stays the journal.
  Sitting before = std::exchange(sitting_, new_sitting(read_root, "opening.argil"));
  const auto take_over = [&] {
    before.session.reset();  // closes its journal before the next one takes the name
    filing_.set_aside();
    session().rename_journal(k_journal);
    filing_.begun(read_root);
    played_last_ = false;
    missed_ticks_ = 0;
    show_all_anew();
  };
  try {
    fill();
  } catch (const Cancelled&) {
    std::error_code ignored;
    const std::filesystem::path half_read = session().journal_path();
    sitting_ = std::move(before);
    std::filesystem::remove(half_read, ignored);
    show_all_anew();
    throw;
  } catch (const Error&) {
    take_over();
    throw;
  }
  take_over();
}

void Bench::go_on(double share, const std::string& what) const {
  if (on_progress && !on_progress(share, what)) throw Cancelled();
}

void Bench::say(const Error& error) {
  say(MessageKind::error, error.where().empty() ? error.what() : error.where() + ": " + error.what());
}

void Bench::say(MessageKind kind, const std::string& text) {
  messages_.push_back({kind, text, ++message_count_});
  if (messages_.size() > k_messages) messages_.erase(messages_.begin());
  changed_ = true;
}

void Bench::run_one(const std::string& line) {
  if (on_line) on_line();
  sitting_.run(line);
  history_changed_ = true;
}

bool Bench::run(const std::string& line) {
  return run_together({line});
}

bool Bench::run_together(const std::vector<std::string>& lines, bool joins_last) {
  if (stroke_) end_stroke(false);
  preview({});
  const std::size_t depth = session().undo_depth();
  played_last_ = false;
  bool well = true;
  try {
    for (const std::string& line : lines) run_one(line);
  } catch (const Cancelled& cancelled) {
    if (session().undo_depth() > depth) run_one(fmt::format("undo {}", session().undo_depth() - depth));
    say(MessageKind::note, cancelled.what());
    well = false;
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
    well = false;
  }
  sitting_.mark_change(depth, joins_last);
  show_all_anew();
  return well;
}

void Bench::undo() {
  if (stroke_) {
    cancel_stroke();
    return;
  }
  const std::size_t changes = sitting_.changes_to_undo();
  if (changes == 0) {
    say(MessageKind::note, "there is nothing to undo");
    return;
  }
  set_playing(false);
  run(fmt::format("undo {}", changes));
}

void Bench::redo() {
  const std::size_t changes = sitting_.changes_to_redo();
  if (changes == 0) {
    say(MessageKind::note, "there is nothing to redo");
    return;
  }
  run(fmt::format("redo {}", changes));
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
  const std::size_t depth = session().undo_depth();
  try {
    session().run_line(std::string("step 1"));
    sitting_.remember("step 1", depth, played_last_);
    sitting_.mark_change(depth, played_last_);
    history_changed_ = true;
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

}  // namespace argil::studio
