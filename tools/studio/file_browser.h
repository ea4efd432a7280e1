#pragma once
// What the window shows of the disk: the files of a folder, those that were used lately, and the samples with their
// pictures. All of it waits for the disk, so the workshop does it, never a frame.

#include <filesystem>
#include <string>
#include <vector>

#include "sculpt/renderer.h"

namespace argil::studio {

/// Folders (with a slash) and files that can be opened, beneath what is typed and beginning with it; at most 10.
struct FolderListing {
  std::string typed;  // that it answers
  std::filesystem::path folder;
  std::vector<std::string> names;
  std::filesystem::path whole{};  // the folder as the disk has it, from its root
};
[[nodiscard]] FolderListing list_folder(const std::string& typed);

/// Whether the studio opens a file of this ending.
[[nodiscard]] bool can_open(const std::filesystem::path& file);

struct Sample {
  std::string title;
  std::filesystem::path file;
  sculpt::Picture picture;  // k_sample_width x k_sample_height
};
inline constexpr int k_sample_width = 208, k_sample_height = 156;
/// The models of `folder` and the figures of papers/004 that have a picture in `folder`/references; at most 15.
/// Faulty pictures are passed over.
[[nodiscard]] std::vector<Sample> find_samples(const std::filesystem::path& folder);

/// Files used lately, the latest first, kept as lines of a file; at most 12.
class RecentFiles {
 public:
  /// No file: they are remembered as long as the window is open.
  explicit RecentFiles(std::filesystem::path file);
  [[nodiscard]] const std::vector<std::filesystem::path>& all() const { return all_; }
  /// Takes it to the front. That the list cannot be written is no reason to stop anyone.
  void add(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  std::vector<std::filesystem::path> all_;
};

}  // namespace argil::studio
