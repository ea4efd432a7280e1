#include "tools/view/canvas.h"

#include <algorithm>
#include <cmath>

namespace argil::view {

namespace {

/// Spreads coverage by a disc that fades out, padded by its radius on all sides.
TextMask spread(const TextMask& mask, float radius) {
  const int reach = static_cast<int>(std::ceil(radius));
  TextMask wide;
  wide.width = mask.width + 2 * reach;
  wide.height = mask.height + 2 * reach;
  wide.baseline = mask.baseline + reach;
  wide.cover.assign(static_cast<std::size_t>(wide.width) * static_cast<std::size_t>(wide.height), 0.0F);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      const float cover = mask.cover[static_cast<std::size_t>(y * mask.width + x)];
      if (cover == 0) continue;
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
          const float distance = std::hypot(static_cast<float>(dx), static_cast<float>(dy));
          const float part = cover * std::clamp(1.0F - distance / (radius + 0.5F), 0.0F, 1.0F);
          float& target = wide.cover[static_cast<std::size_t>((y + dy + reach) * wide.width + x + dx + reach)];
          target = std::max(target, std::min(1.0F, 1.6F * part));
        }
    }
  return wide;
}

}  // namespace

void Canvas::blend(int x, int y, const Colour& fill, float cover) {
  if (x < 0 || y < 0 || x >= picture_->width || y >= picture_->height) return;
  const float alpha = std::clamp(fill.alpha * cover, 0.0F, 1.0F);
  std::uint8_t* pixel =
      &picture_->rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_->width) +
                           static_cast<std::size_t>(x))];
  const float channels[3] = {fill.red, fill.green, fill.blue};
  for (int k = 0; k < 3; ++k)
    pixel[k] = static_cast<std::uint8_t>(
        std::lround(static_cast<float>(pixel[k]) * (1 - alpha) + 255.0F * channels[k] * alpha));
}

void Canvas::disc(float x, float y, float radius, const Colour& fill) {
  for (int row = static_cast<int>(y - radius - 1); row <= static_cast<int>(y + radius + 1); ++row)
    for (int column = static_cast<int>(x - radius - 1); column <= static_cast<int>(x + radius + 1); ++column) {
      const float distance = std::hypot(static_cast<float>(column) + 0.5F - x, static_cast<float>(row) + 0.5F - y);
      blend(column, row, fill, std::clamp(radius + 0.5F - distance, 0.0F, 1.0F));
    }
}

void Canvas::bar(float x, float y, float width, float height, float corner,
                 const std::function<Colour(float)>& colour_at) {
  for (int row = static_cast<int>(y) - 1; row <= static_cast<int>(y + height) + 1; ++row) {
    const float middle = static_cast<float>(row) + 0.5F;
    const Colour fill = colour_at(std::clamp((middle - y) / height, 0.0F, 1.0F));
    for (int column = static_cast<int>(x) - 1; column <= static_cast<int>(x + width) + 1; ++column) {
      const float u = std::abs(static_cast<float>(column) + 0.5F - x - 0.5F * width) - 0.5F * width + corner;
      const float v = std::abs(middle - y - 0.5F * height) - 0.5F * height + corner;
      const float distance =
          std::hypot(std::max(u, 0.0F), std::max(v, 0.0F)) + std::min(std::max(u, v), 0.0F) - corner;
      blend(column, row, fill, std::clamp(0.5F - distance, 0.0F, 1.0F));
    }
  }
}

void Canvas::text(float x, float y, float size, std::string_view line, const Colour& fill, Align align,
                  const Colour& halo) {
  if (font_->empty() || line.empty()) return;
  const float width = font_->width(line, size);
  if (align == Align::right) x -= width;
  if (align == Align::centre) x -= 0.5F * width;
  const int left = static_cast<int>(std::floor(x)), base = static_cast<int>(std::lround(y));
  const TextMask mask = font_->draw(line, size, x - static_cast<float>(left));
  const auto paint = [&](const TextMask& cover, int shift, const Colour& tint) {
    for (int row = 0; row < cover.height; ++row)
      for (int column = 0; column < cover.width; ++column)
        blend(left + column - shift, base - cover.baseline + row, tint,
              cover.cover[static_cast<std::size_t>(row * cover.width + column)]);
  };
  if (halo.alpha > 0) {
    const float radius = 0.2F * size;
    paint(spread(mask, radius), static_cast<int>(std::ceil(radius)), halo);
  }
  paint(mask, 0, fill);
}

}  // namespace argil::view
