#pragma once
// Text as coverage: Inter, glyphs that it lacks from DejaVu Sans. Where neither is installed there is no text, and
// the picture is drawn without it.

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace argil::view {

inline constexpr const char* k_font_files[] = {"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                                               "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
                                               "/usr/share/fonts/opentype/inter/Inter-Medium.otf",
                                               "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                               "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                               "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};

/// A line of text as coverage 0 … 1; `baseline` rows lie above the line that the letters stand on.
struct TextMask {
  int width = 0, height = 0, baseline = 0;
  std::vector<float> cover;
};

class Font {
 public:
  /// The files that are there and are fonts, in this order of preference for each glyph.
  explicit Font(std::span<const char* const> files = k_font_files);
  ~Font();
  Font(Font&&) noexcept;

  bool empty() const;
  /// Width in pixels of UTF-8 text; malformed bytes count as the replacement character.
  float width(std::string_view text, float size) const;
  /// `start` 0 … 1: where in its first pixel the text begins.
  TextMask draw(std::string_view text, float size, float start = 0) const;

 private:
  struct Face;
  struct Glyph;
  std::vector<Glyph> layout(std::string_view text, float size) const;
  std::vector<std::unique_ptr<Face>> faces_;
};

}  // namespace argil::view
