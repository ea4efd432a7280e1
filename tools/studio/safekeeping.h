#pragma once
// Work that a window leaves unsaved is kept: by a crash, by quitting, or by opening something else. Each window
// journals in a folder of its own; what of a journal was saved is noted beside it, so that the next window there
// can offer the rest. Files: journal.argil and journal.json of the window that runs or ran last, unsaved-N.argil
// and unsaved-N.json of earlier ones, lock.

#include <filesystem>
#include <string>
#include <vector>

namespace argil::studio {

/// A journal whose last lines no session file holds.
struct UnsavedWork {
  std::filesystem::path journal;
  std::filesystem::path read_root;  // that its lines read files beneath
  std::filesystem::path file;       // that it was opened from or saved to; empty: none
  std::size_t changes = 0;          // lines that were not saved
};

class Safekeeping {
 public:
  /// Takes `root`, or root-2, root-3, … where a window that still runs has taken it, and sets aside the unsaved
  /// work that the last window left there. @throws Error (bad_input) where no such folder can be made.
  explicit Safekeeping(const std::filesystem::path& root);
  ~Safekeeping();
  Safekeeping(const Safekeeping&) = delete;
  Safekeeping& operator=(const Safekeeping&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Unsaved work of earlier windows, the latest first; at most 20 are kept.
  [[nodiscard]] const std::vector<UnsavedWork>& unsaved() const { return unsaved_; }

  /// The session is over and another will begin: what of its journal was not saved is set aside.
  void set_aside();
  /// Another session has begun to journal, and nothing of it is saved.
  void begun(const std::filesystem::path& read_root) const;
  /// All that the journal holds by now is saved in `file`, or is no loss (`file` empty).
  void kept(const std::filesystem::path& read_root, const std::filesystem::path& file) const;
  /// The work is in the present journal, or is to be thrown away. Removes its files.
  void forget(const UnsavedWork& work);

 private:
  void list();

  std::filesystem::path folder_;
  int lock_ = -1;
  std::vector<UnsavedWork> unsaved_;
};

/// The whole lines of a journal: of one that a crash cut off, the last is left out. @throws Error (bad_input) if it
/// cannot be read.
[[nodiscard]] std::string whole_lines(const std::filesystem::path& journal);

}  // namespace argil::studio
