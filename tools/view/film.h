#pragma once
// Pictures one after the other as a film: .mp4 (H.264) or .gif through the program ffmpeg, which takes them from a
// pipe and never from a shell, or numbered .png files, for which nothing else is needed. Used by `argil movie` and
// by the window.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sculpt/renderer.h"

namespace argil::view {

struct FilmOptions {
  double rate = 30;                // pictures a second
  std::string program = "ffmpeg";  // looked for in PATH, unless it has a slash
};

/// Whether .mp4 and .gif can be written.
[[nodiscard]] bool can_write_films(const FilmOptions& options = {});

class FilmWriter {
 public:
  /// `path` ends in .mp4, .gif or .png (NAME_0000.png, …). @throws Error (unsupported) for another ending, or where
  /// there is no ffmpeg, saying how it is installed.
  FilmWriter(std::filesystem::path path, const FilmOptions& options = {});
  /// A film that was not finished leaves nothing, and what was there before as it was.
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// All pictures are of one size; odd sizes are padded for .mp4. @throws Error (bad_input) with what ffmpeg says
  /// if it has given up.
  void add(const sculpt::Picture& picture);
  std::size_t count() const { return count_; }
  /// The file is there then, at one stroke. @throws Error (bad_input) as above, or if there was no picture.
  void finish();

 private:
  struct Encoder;
  [[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& folder, std::size_t picture) const;
  std::filesystem::path path_;
  FilmOptions options_;
  std::unique_ptr<Encoder> encoder_;  // from the first picture on; null for .png
  std::filesystem::path folder_;      // where numbered pictures are until all are there
  std::size_t count_ = 0;
  int width_ = 0, height_ = 0;
};

/// One turn of the eye about what the scene shows, upright, in `pictures` pictures, each given to `take`; the
/// distance is the same all round. What `take` or options.progress throws ends it.
void turntable(sculpt::Renderer& renderer, const sculpt::Scene& scene, sculpt::PictureOptions options, int pictures,
               const std::function<void(const sculpt::Picture&)>& take);

}  // namespace argil::view
