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
        say(MessageKind::note, "opened " + file.filename().string());
      }
    } else {
      const auto lines = io::parse_session(io::read_file(file), file.filename().string());
      begin_session(folder);
      run_all(lines);
      mark_saved(file);
      used(file);
      say(MessageKind::note, "opened " + file.filename().string());
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
    say(MessageKind::note, "opened a copy of the sample " + file.stem().string());
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

void Bench::film(bool turntable) {
  if (stroke_) end_stroke(false);
  try {
    if (!options_.film) throw Error(ErrorCode::unsupported, "this program makes no films");
    say(MessageKind::note, options_.film(session_->journal_path(), session_->options().read_root, turntable));
  } catch (const Error& error) {
    say(MessageKind::error, error.what());
  }
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

}  // namespace argil::studio
