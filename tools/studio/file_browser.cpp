#include "tools/studio/file_browser.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "io/file_bytes.h"
#include "io/image.h"
#include "subdiv/error.h"

namespace argil::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_listed = 10, k_recent = 12, k_samples = 15;

/// Cut to the shape of a card about its middle, each pixel the mean of those that it stands for.
sculpt::Picture card_of(const io::Image& image) {
  sculpt::Picture card;
  card.width = k_sample_width;
  card.height = k_sample_height;
  card.rgba.resize(4UL * k_sample_width * k_sample_height);
  const double scale = std::min(static_cast<double>(image.width) / k_sample_width,
                                static_cast<double>(image.height) / k_sample_height);
  const double left = 0.5 * (image.width - scale * k_sample_width),
               top = 0.5 * (image.height - scale * k_sample_height);
  for (int y = 0; y < k_sample_height; ++y)
    for (int x = 0; x < k_sample_width; ++x) {
      const auto place = [&](double from, int i, int end) {
        return std::clamp(static_cast<int>(from + scale * i), 0, end - 1);
      };
      const int x0 = place(left, x, image.width), x1 = std::max(x0 + 1, place(left, x + 1, image.width)),
                y0 = place(top, y, image.height), y1 = std::max(y0 + 1, place(top, y + 1, image.height));
      for (std::size_t c = 0; c < 4; ++c) {
        long sum = 0;
        for (int v = y0; v < y1; ++v)
          for (int u = x0; u < x1; ++u)
            sum += image.rgba[4 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                                   static_cast<std::size_t>(u)) +
                              c];
        card.rgba[4 * (static_cast<std::size_t>(y) * k_sample_width + static_cast<std::size_t>(x)) + c] =
            static_cast<std::uint8_t>(sum / ((x1 - x0) * (y1 - y0)));
      }
    }
  return card;
}

std::string title_of(const fs::path& session) {
  std::string title = session.stem().string();
  std::replace(title.begin(), title.end(), '_', ' ');
  if (!title.empty() && title.front() >= 'a' && title.front() <= 'z')
    title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return title;
}

std::vector<fs::path> sorted_files(const fs::path& folder, const char* ending) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure))
    if (entry.path().extension() == ending) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

bool can_open(const fs::path& file) {
  static constexpr std::array<const char*, 7> k_endings{".argil", ".vtk", ".vtu", ".mesh", ".msh", ".inp", ".ovm"};
  return std::find(k_endings.begin(), k_endings.end(), file.extension().string()) != k_endings.end();
}

FolderListing list_folder(const std::string& typed) {
  FolderListing listing{.typed = typed, .folder = ".", .names = {}};
  std::error_code failure;
  const fs::path path(typed);
  const bool whole = typed.empty() || fs::is_directory(path, failure);
  if (!typed.empty()) listing.folder = whole ? path : path.has_parent_path() ? path.parent_path() : fs::path(".");
  listing.whole = fs::weakly_canonical(fs::absolute(listing.folder, failure), failure);
  const std::string start = whole ? std::string{} : path.filename().string();
  for (const auto& entry : fs::directory_iterator(listing.folder, failure)) {
    const std::string name = entry.path().filename().string();
    const bool is_folder = entry.is_directory(failure);
    if (name.starts_with('.') || !name.starts_with(start) || !(is_folder || can_open(entry.path()))) continue;
    listing.names.push_back(is_folder ? name + "/" : name);
  }
  std::sort(listing.names.begin(), listing.names.end());
  if (listing.names.size() > k_listed) listing.names.resize(k_listed);
  return listing;
}

std::vector<Sample> find_samples(const fs::path& folder) {
  std::vector<Sample> samples;
  for (const char* part : {"models", "paper_004"})
    for (const fs::path& session : sorted_files(folder / part, ".argil")) {
      if (samples.size() == k_samples) return samples;
      // Of several pictures the one that bears the session's name, or a plain view, tells most.
      const auto pictures = sorted_files(folder / "references" / part / session.stem(), ".png");
      if (pictures.empty()) continue;
      const auto plain = std::find_if(pictures.begin(), pictures.end(), [](const fs::path& picture) {
        return picture.stem().string().ends_with("_plain");
      });
      try {
        samples.push_back({title_of(session), fs::weakly_canonical(session),
                           card_of(io::read_png(plain != pictures.end() ? *plain : pictures.front()))});
      } catch (const Error&) {
        continue;
      }
    }
  return samples;
}

RecentFiles::RecentFiles(fs::path file) : file_(std::move(file)) {
  std::error_code failure;
  if (file_.empty() || !fs::is_regular_file(file_, failure)) return;
  std::istringstream lines(io::read_file(file_));
  for (std::string line; std::getline(lines, line) && all_.size() < k_recent;)
    if (!line.empty()) all_.emplace_back(line);
}

void RecentFiles::add(const fs::path& file) {
  std::error_code failure;
  const fs::path whole = fs::absolute(file, failure).lexically_normal();
  std::erase(all_, whole);
  all_.insert(all_.begin(), whole);
  if (all_.size() > k_recent) all_.resize(k_recent);
  if (file_.empty()) return;
  std::string lines;
  for (const fs::path& one : all_)
    if (one.string().find('\n') == std::string::npos) lines += one.string() + '\n';
  fs::create_directories(file_.parent_path(), failure);
  try {
    io::write_file(file_, lines);
  } catch (const Error&) {
    return;
  }
}

}  // namespace argil::studio
