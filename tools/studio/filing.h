#pragma once
// What the window knows of the disk: unsaved work of earlier windows, the files used lately, the folder that a
// dialogue shows, the samples, and the sculptor's keys. All of it waits for the disk, so the workshop asks for it,
// never a frame.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/studio/file_browser.h"
#include "tools/studio/safekeeping.h"
#include "tools/studio/snapshot.h"

namespace argil::studio {

class Filing {
 public:
  /// `out` as of Safekeeping; `settings` and `samples` are folders, and may be empty: there are none.
  Filing(const std::filesystem::path& out, std::filesystem::path settings, std::filesystem::path samples);

  [[nodiscard]] const std::filesystem::path& folder() const { return keeping_.folder(); }
  /// The journal is that of a session that is over: what of it was not saved is set aside.
  void set_aside();
  // As of Safekeeping.
  void begun(const std::filesystem::path& read_root);
  void kept(const std::filesystem::path& read_root, const std::filesystem::path& file);
  void forget(const UnsavedWork& work);
  /// A session was opened from there or saved to it.
  void used(const std::filesystem::path& file);

  // What dialogues show.
  void list(const std::string& typed);
  void look_for_samples();
  /// A file of the sculptor's settings. @throws Error, or std::filesystem::filesystem_error, if it cannot be
  /// written.
  void keep(const std::string& name, const std::string& lines) const;

  [[nodiscard]] bool has_changed() const { return changed_; }
  void show(Snapshot& next);

 private:
  void show_unsaved();

  std::filesystem::path settings_, samples_folder_;
  Safekeeping keeping_;
  RecentFiles recent_;
  std::shared_ptr<const std::vector<UnsavedWork>> unsaved_;
  std::shared_ptr<const std::vector<std::filesystem::path>> shown_recent_;
  std::shared_ptr<const FolderListing> listing_;
  std::shared_ptr<const std::vector<Sample>> samples_;
  bool changed_ = true;
};

}  // namespace argil::studio
