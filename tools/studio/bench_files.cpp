// Of bench.h: what a session is read from and written to.

#include <fmt/format.h>

#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tools/studio/bench.h"

namespace argil::studio {

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

void Bench::mark_saved(const std::filesystem::path& file) {
  sitting_.file = file;
  sitting_.saved_lines = sitting_.lines;
  filing_.kept(session().options().read_root, file);
}

void Bench::run_all(const std::vector<std::string>& lines) {
  // Counts the lines of the file for as long as this lives.
  struct Count {
    explicit Count(Bench& bench, std::size_t lines) : of(bench) { of.file_lines_ = lines; }
    ~Count() { of.file_line_ = of.file_lines_ = 0; }
    Count(const Count&) = delete;
    Count& operator=(const Count&) = delete;
    Bench& of;
  };
  const Count count(*this, lines.size());
  for (const std::string& line : lines) {
    const std::size_t depth = session().undo_depth();
    go_on(static_cast<double>(file_line_) / static_cast<double>(file_lines_), line);
    run_one(line);
    sitting_.mark_change(depth, false);
    ++file_line_;
  }
}

namespace {

std::vector<std::string> lines_of(const std::string& text, const std::filesystem::path& file) {
  std::vector<std::string> lines;
  for (const io::SessionLine& line : io::parse_session(text, file.filename().string()))
    lines.push_back(io::format_line(line.tokens));
  return lines;
}

}  // namespace

void Bench::open(const std::filesystem::path& wanted) {
  try {
    std::error_code failure;
    const std::filesystem::path saved = options_.save_root / wanted;
    const bool was_saved = !options_.save_root.empty() && std::filesystem::is_regular_file(saved, failure);
    const std::filesystem::path& file = was_saved ? saved : wanted;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    const bool is_session = file.extension() == ".argil";
    const std::vector<std::string> lines =
        is_session ? lines_of(io::read_file(file), file)
                   : std::vector<std::string>{fmt::format("open \"{}\"", file.filename().string()), "levels 1"};
    load(folder, [&] { run_all(lines); });
    mark_saved(is_session ? file : std::filesystem::path{});
    filing_.used(file);
    say(MessageKind::note, "opened " + file.filename().string());
  } catch (const Error& error) {
    say(error);
  } catch (const std::filesystem::filesystem_error& error) {
    say(MessageKind::error, error.what());
  }
}

void Bench::open_sample(const std::filesystem::path& file) {
  try {
    const auto lines = lines_of(io::read_file(file), file);
    load(file.parent_path(), [&] { run_all(lines); });
    mark_saved({});
    say(MessageKind::note, "opened a copy of the sample " + file.stem().string());
  } catch (const Error& error) {
    say(error);
  }
}

void Bench::begin_block() {
  try {
    load(".", [&] { run_all(block_lines()); });
    // The block is one action: there is nothing before it to go back to.
    sitting_.marks = {session().undo_depth()};
    mark_saved({});
  } catch (const Error& error) {
    say(error);
  }
}

void Bench::bring_back(const UnsavedWork& work) {
  try {
    const auto lines = lines_of(whole_lines(work.journal), work.journal);
    load(work.read_root, [&] { run_all(lines); });
    sitting_.file = work.file;
    filing_.forget(work);
    say(MessageKind::note, fmt::format("{} changes that were not saved are back", work.changes));
  } catch (const Error& error) {
    // Its files stay until all of it is back.
    say(error);
  }
}

void Bench::film(bool turntable) {
  if (stroke_) end_stroke(false);
  try {
    darkroom_.make(
        {io::read_file(session().journal_path()), session().options().read_root, filing_.folder(), turntable});
  } catch (const Error& error) {
    say(error);
  }
}

void Bench::write_keys(const std::string& lines) {
  keep("keys", lines);
}

void Bench::write_settings(const std::string& lines) {
  keep("window", lines);
}

void Bench::keep(const std::string& file, const std::string& lines) {
  try {
    filing_.keep(file, lines);
  } catch (const Error& error) {
    say(error);
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
    io::write_file(file, io::read_file(session().journal_path()));
    mark_saved(file);
    filing_.used(file);
    say(MessageKind::note, "saved as " + file.string());
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
  }
}

}  // namespace argil::studio
