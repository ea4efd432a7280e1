#include "tools/studio/filing.h"

#include <utility>

#include "io/file_bytes.h"

namespace argil::studio {

Filing::Filing(const std::filesystem::path& out, std::filesystem::path settings, std::filesystem::path samples)
    : settings_(std::move(settings)),
      samples_folder_(std::move(samples)),
      keeping_(out),
      recent_(settings_.empty() ? settings_ : settings_ / "recent") {
  shown_recent_ = std::make_shared<const std::vector<std::filesystem::path>>(recent_.all());
  show_unsaved();
}

void Filing::show_unsaved() {
  unsaved_ = std::make_shared<const std::vector<UnsavedWork>>(keeping_.unsaved());
  changed_ = true;
}

void Filing::set_aside() {
  keeping_.set_aside();
  show_unsaved();
}

void Filing::begun(const std::filesystem::path& read_root) {
  keeping_.begun(read_root);
}

void Filing::kept(const std::filesystem::path& read_root, const std::filesystem::path& file) {
  keeping_.kept(read_root, file);
  show_unsaved();
}

void Filing::forget(const UnsavedWork& work) {
  keeping_.forget(work);
  show_unsaved();
}

void Filing::used(const std::filesystem::path& file) {
  recent_.add(file);
  shown_recent_ = std::make_shared<const std::vector<std::filesystem::path>>(recent_.all());
  changed_ = true;
}

void Filing::list(const std::string& typed) {
  listing_ = std::make_shared<const FolderListing>(list_folder(typed));
  changed_ = true;
}

void Filing::look_for_samples() {
  if (!samples_) samples_ = std::make_shared<const std::vector<Sample>>(find_samples(samples_folder_));
  changed_ = true;
}

void Filing::keep(const std::string& name, const std::string& lines) const {
  if (settings_.empty()) return;
  std::filesystem::create_directories(settings_);
  io::write_file(settings_ / name, lines);
}

void Filing::show(Snapshot& next) {
  next.unsaved = unsaved_;
  next.recent = shown_recent_;
  next.listing = listing_;
  next.samples = samples_;
  changed_ = false;
}

}  // namespace argil::studio
