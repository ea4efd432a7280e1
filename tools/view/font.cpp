#include "tools/view/font.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

namespace argil::view {

struct Font::Face {
  std::vector<unsigned char> bytes;
  stbtt_fontinfo font{};
  /// Pixels a font unit, `size` being the em.
  float scale(float size) const { return stbtt_ScaleForMappingEmToPixels(&font, size); }
};

struct Font::Glyph {
  const Face* face;
  int index;
  float x;
};

namespace {

constexpr int k_replacement = 0xFFFD;

/// Takes one code point off the front.
int next_code_point(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  if (lead < 0x80) return lead;
  const int more = lead >= 0xF0 && lead < 0xF8 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC2 ? 1 : 0;
  if (more == 0 || lead >= 0xF8 || static_cast<int>(text.size()) < more) return k_replacement;
  int code = lead & (0x3F >> more);
  for (int i = 0; i < more; ++i) {
    const auto byte = static_cast<unsigned char>(text[static_cast<std::size_t>(i)]);
    if ((byte & 0xC0) != 0x80) return k_replacement;
    code = code << 6 | (byte & 0x3F);
  }
  text.remove_prefix(static_cast<std::size_t>(more));
  return code;
}

}  // namespace

Font::Font(std::span<const char* const> files) {
  for (const char* file : files) {
    std::ifstream in(file, std::ios::binary);
    if (!in) continue;
    auto face = std::make_unique<Face>();
    face->bytes.assign(std::istreambuf_iterator<char>(in), {});
    if (face->bytes.size() < 1024) continue;
    const int offset = stbtt_GetFontOffsetForIndex(face->bytes.data(), 0);
    if (offset < 0 || stbtt_InitFont(&face->font, face->bytes.data(), offset) == 0) continue;
    faces_.push_back(std::move(face));
  }
}

Font::~Font() = default;
Font::Font(Font&&) noexcept = default;

bool Font::empty() const {
  return faces_.empty();
}

std::vector<Font::Glyph> Font::layout(std::string_view text, float size) const {
  std::vector<Glyph> glyphs;
  float x = 0;
  while (!text.empty() && !faces_.empty()) {
    const int code = next_code_point(text);
    Glyph glyph{faces_.front().get(), 0, 0};
    for (const auto& face : faces_) {
      const int index = stbtt_FindGlyphIndex(&face->font, code);
      if (index == 0) continue;
      glyph = {face.get(), index, 0};
      break;
    }
    if (!glyphs.empty() && glyphs.back().face == glyph.face)
      x += static_cast<float>(stbtt_GetGlyphKernAdvance(&glyph.face->font, glyphs.back().index, glyph.index)) *
           glyph.face->scale(size);
    glyph.x = x;
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&glyph.face->font, glyph.index, &advance, &bearing);
    x += static_cast<float>(advance) * glyph.face->scale(size);
    glyphs.push_back(glyph);
  }
  glyphs.push_back({nullptr, 0, x});  // the end of the line
  return glyphs;
}

float Font::width(std::string_view text, float size) const {
  return layout(text, size).back().x;
}

TextMask Font::draw(std::string_view text, float size, float start) const {
  const std::vector<Glyph> glyphs = layout(text, size);
  TextMask mask;
  mask.baseline = static_cast<int>(std::ceil(size));
  mask.height = mask.baseline + static_cast<int>(std::ceil(0.35F * size));
  mask.width = static_cast<int>(std::ceil(glyphs.back().x + start)) + 2;
  mask.cover.assign(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height), 0.0F);
  std::vector<unsigned char> bitmap;
  for (const Glyph& glyph : glyphs) {
    if (glyph.face == nullptr) continue;
    const float scale = glyph.face->scale(size), pen = glyph.x + start, whole = std::floor(pen);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&glyph.face->font, glyph.index, scale, scale, pen - whole, 0, &x0, &y0, &x1,
                                    &y1);
    const int columns = x1 - x0, rows = y1 - y0;
    if (columns <= 0 || rows <= 0) continue;
    bitmap.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
    stbtt_MakeGlyphBitmapSubpixel(&glyph.face->font, bitmap.data(), columns, rows, columns, scale, scale,
                                  pen - whole, 0, glyph.index);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const int x = static_cast<int>(whole) + x0 + column, y = mask.baseline + y0 + row;
        if (x < 0 || x >= mask.width || y < 0 || y >= mask.height) continue;
        float& cover = mask.cover[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                                  static_cast<std::size_t>(x)];
        cover = std::min(
            1.0F, cover + static_cast<float>(bitmap[static_cast<std::size_t>(row * columns + column)]) / 255.0F);
      }
  }
  return mask;
}

}  // namespace argil::view
