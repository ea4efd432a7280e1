#include "tools/studio/safekeeping.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "io/file_bytes.h"
#include "subdiv/error.h"

namespace argil::studio {

namespace {

namespace fs = std::filesystem;

constexpr int k_windows = 64;          // that may run side by side
constexpr std::size_t k_unsaved = 20;  // that are kept
constexpr std::size_t k_header_lines = 1;

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

fs::path note_of(fs::path journal) {
  return journal.replace_extension(".json");
}

/// −1: not the name of unsaved work.
long number_of(const fs::path& file) {
  const std::string name = file.filename().string();
  constexpr std::string_view k_start = "unsaved-", k_end = ".argil";
  if (!name.starts_with(k_start) || !name.ends_with(k_end)) return -1;
  long number = -1;
  const char* last = name.data() + name.size() - k_end.size();
  const auto read = std::from_chars(name.data() + k_start.size(), last, number);
  return read.ec == std::errc{} && read.ptr == last ? number : -1;
}

fs::path whole(const fs::path& path) {
  std::error_code failure;
  return path.empty() ? path : fs::absolute(path, failure);
}

void note(const fs::path& journal, const fs::path& read_root, const fs::path& file, std::size_t kept_lines) {
  const nlohmann::json words{
      {"read_root", read_root.string()}, {"file", file.string()}, {"kept_lines", kept_lines}};
  io::write_file(note_of(journal), words.dump(1) + '\n');
}

/// A note that is missing or damaged says only that nothing was saved.
UnsavedWork read_work(const fs::path& journal) {
  UnsavedWork work{.journal = journal, .read_root = ".", .file = {}};
  std::size_t kept = k_header_lines;
  std::error_code failure;
  if (fs::is_regular_file(note_of(journal), failure)) {
    const auto words = nlohmann::json::parse(io::read_file(note_of(journal)), nullptr, false);
    if (words.is_object()) {
      const auto text = [&](const char* name) {
        return words.contains(name) && words[name].is_string() ? words[name].get<std::string>() : std::string{};
      };
      if (!text("read_root").empty()) work.read_root = text("read_root");
      work.file = text("file");
      if (words.contains("kept_lines") && words["kept_lines"].is_number_unsigned())
        kept = words["kept_lines"].get<std::size_t>();
    }
  }
  const std::size_t lines = line_count(io::read_file(journal));
  work.changes = lines > kept ? lines - kept : 0;
  return work;
}

}  // namespace

std::string whole_lines(const fs::path& journal) {
  std::string text = io::read_file(journal);
  text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  return text;
}

Safekeeping::Safekeeping(const fs::path& root) {
  for (int i = 1; i <= k_windows && lock_ < 0; ++i) {
    folder_ = i == 1 ? root : fs::path(root.string() + fmt::format("-{}", i));
    std::error_code failure;
    fs::create_directories(folder_, failure);
    const int file = failure ? -1 : open((folder_ / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (file < 0)
      throw Error(ErrorCode::bad_input,
                  fmt::format("the folder '{}' for the journal cannot be written; choose another with --out",
                              folder_.string()));
    if (flock(file, LOCK_EX | LOCK_NB) == 0)
      lock_ = file;
    else
      close(file);
  }
  if (lock_ < 0)
    throw Error(ErrorCode::bad_input,
                fmt::format("{} windows journal beneath '{}' already; choose another folder with --out", k_windows,
                            root.string()));
  set_aside();
}

Safekeeping::~Safekeeping() {
  close(lock_);
}

void Safekeeping::set_aside() {
  const fs::path journal = folder_ / "journal.argil";
  std::error_code failure;
  if (fs::is_regular_file(journal, failure) && read_work(journal).changes > 0) {
    list();
    const long last = unsaved_.empty() ? 0 : number_of(unsaved_.front().journal);
    const fs::path aside = folder_ / fmt::format("unsaved-{}.argil", last + 1);
    // The note goes first: a journal without one is offered whole, one that lost its journal is nothing.
    fs::rename(note_of(journal), note_of(aside), failure);
    fs::rename(journal, aside, failure);
  } else {
    // It is no loss, but it stays as long as nobody needs its place.
    fs::rename(journal, folder_ / "journal.previous.argil", failure);
    fs::remove(note_of(journal), failure);
  }
  list();
  while (unsaved_.size() > k_unsaved) forget(UnsavedWork(unsaved_.back()));
}

void Safekeeping::begun(const fs::path& read_root) const {
  note(folder_ / "journal.argil", whole(read_root), {}, k_header_lines);
}

void Safekeeping::kept(const fs::path& read_root, const fs::path& file) const {
  const fs::path journal = folder_ / "journal.argil";
  note(journal, whole(read_root), whole(file), line_count(io::read_file(journal)));
}

void Safekeeping::forget(const UnsavedWork& work) {
  std::error_code failure;
  if (number_of(work.journal) < 0) return;
  fs::remove(work.journal, failure);
  fs::remove(note_of(work.journal), failure);
  list();
}

void Safekeeping::list() {
  unsaved_.clear();
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder_, failure))
    if (number_of(entry.path()) > 0 && entry.is_regular_file(failure)) unsaved_.push_back(read_work(entry.path()));
  std::sort(unsaved_.begin(), unsaved_.end(),
            [](const UnsavedWork& a, const UnsavedWork& b) { return number_of(a.journal) > number_of(b.journal); });
}

}  // namespace argil::studio
