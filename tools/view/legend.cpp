#include "tools/view/legend.h"

#include <algorithm>
#include <cmath>

#include "sculpt/scene.h"
#include "sculpt/shown_unit.h"

namespace argil::view {

namespace {

constexpr float k_title_size = 14, k_tick_size = 13, k_bar_width = 18, k_right = 26, k_gap = 9, k_top = 62;
constexpr float k_bar_height = 250;
constexpr float k_stroke = 30;  // of the key, long
constexpr float k_swatch = 16, k_row = 24;
constexpr float k_heading_size = 19;

float bar_height(float pixel, int height) {
  return std::min(k_bar_height * pixel, 0.55F * static_cast<float>(height));
}

float legend_height(const sculpt::SceneLegend& legend, float pixel, int height) {
  const auto rows =
      std::count_if(legend.names.begin(), legend.names.end(), [](const auto& n) { return !n.empty(); });
  return rows > 0 ? k_row * pixel * static_cast<float>(rows) : bar_height(pixel, height);
}

void draw_kinds(Canvas& canvas, const sculpt::SceneLegend& legend, const Theme& theme, float pixel, float right) {
  const float size = k_swatch * pixel;
  float y = k_top * pixel;
  for (std::size_t kind = 0; kind < std::min(legend.names.size(), k_map_size); ++kind) {
    if (legend.names[kind].empty()) continue;
    const auto& c = map_colours(legend.map)[kind];
    canvas.bar(right - size, y, size, size, 3 * pixel, [&](float) { return Colour{c[0], c[1], c[2], 1}; });
    canvas.text(right - size - k_gap * pixel, y + 0.5F * size + 0.36F * k_tick_size * pixel, k_tick_size * pixel,
                legend.names[kind], theme.text, Align::right);
    y += k_row * pixel;
  }
}

}  // namespace

std::vector<Tick> legend_ticks(const sculpt::SceneLegend& legend, int most) {
  const sculpt::ShownUnit shown =
      sculpt::shown_unit(legend.unit, std::max(std::abs(legend.low), std::abs(legend.high)));
  const double low = legend.low * shown.per_value, high = legend.high * shown.per_value;
  const std::string suffix = shown.unit.empty() ? "" : " " + shown.unit;
  if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high)))) {
    const double size = std::abs(high) > 0 ? std::pow(10.0, std::floor(std::log10(std::abs(high))) - 2) : 1.0;
    return {{legend.high, sculpt::tick_text(high, size) + suffix}};
  }
  const double step = sculpt::round_step(high - low, most);
  std::vector<Tick> ticks;
  for (double i = std::ceil(low / step - 1e-6); i * step <= high + 1e-6 * step; ++i)
    ticks.push_back({i * step / shown.per_value, sculpt::tick_text(i * step, step)});
  if (ticks.empty()) ticks.push_back({legend.high, sculpt::tick_text(high, step)});
  ticks.back().text += suffix;
  return ticks;
}

double legend_width(const sculpt::SceneLegend& legend, const Font& font, float pixel, int width) {
  float text = 0;
  for (const std::string& name : legend.names) text = std::max(text, font.width(name, k_tick_size * pixel));
  if (text > 0) return static_cast<double>(text + (k_right + k_swatch + k_gap + 20) * pixel) / width;
  for (const Tick& tick : legend_ticks(legend, sculpt::k_legend_parts))
    text = std::max(text, font.width(tick.text, k_tick_size * pixel));
  const float beside = text + (k_right + k_bar_width + k_gap + 20) * pixel;
  return static_cast<double>(beside) / width;
}

void draw_legend(Canvas& canvas, const sculpt::SceneLegend& legend, const Theme& theme, float pixel, int width,
                 int height) {
  const float tall = bar_height(pixel, height), bar_width = k_bar_width * pixel;
  const float top = std::round(k_top * pixel);
  const float right = std::round(static_cast<float>(width) - k_right * pixel), left = std::round(right - bar_width);
  if (!legend.names.empty()) {
    canvas.text(right, top - 14 * pixel, k_title_size * pixel, legend.title, theme.text, Align::right);
    draw_kinds(canvas, legend, theme, pixel, right);
    return;
  }
  canvas.bar(left, top, right - left, tall, 3 * pixel,
             [&](float y) { return field_colour(map_colours(legend.map), 1 - y); });
  canvas.text(right, top - 14 * pixel, k_title_size * pixel, legend.title, theme.text, Align::right);

  const int most = std::max(1, static_cast<int>(tall / (26 * pixel)));
  const double range = legend.high - legend.low;
  for (const Tick& tick : legend_ticks(legend, std::min(most, sculpt::k_legend_parts))) {
    const double part = range > 0 ? (tick.value - legend.low) / range : 0.5;
    const float y = top + tall * static_cast<float>(1 - part);
    canvas.text(left - k_gap * pixel, y + 0.36F * k_tick_size * pixel, k_tick_size * pixel, tick.text,
                theme.quiet_text, Align::right);
    if (part > 0.01 && part < 0.99)
      canvas.bar(left, y - 0.5F * pixel, 5 * pixel, pixel, 0, [](float) { return colour(0xFFFFFF, 0.45F); });
  }
}

void draw_title(Canvas& canvas, const std::string& title, const Theme& theme, float pixel) {
  canvas.text(k_right * pixel, 46 * pixel, k_heading_size * pixel, title, theme.text);
}

void draw_felt(Canvas& canvas, const sculpt::SceneFelt& felt, const Theme& theme, float pixel, int height) {
  canvas.text(k_right * pixel, static_cast<float>(height) - 28 * pixel, k_heading_size * pixel, felt.text,
              theme.text);
}

double key_width(const sculpt::Scene& scene, const Font& font, float pixel, int width) {
  float text = 0;
  for (const sculpt::SceneLines& lines : scene.lines)
    if (!lines.name.empty()) text = std::max(text, font.width(lines.name, k_tick_size * pixel));
  return text == 0 ? 0 : static_cast<double>(text + (k_right + k_stroke + k_gap + 20) * pixel) / width;
}

void draw_key(Canvas& canvas, const sculpt::Scene& scene, const Theme& theme, float pixel, int width, int height) {
  const float right = std::round(static_cast<float>(width) - k_right * pixel), left = right - k_stroke * pixel;
  float y = k_top * pixel;
  if (scene.legend) y += legend_height(*scene.legend, pixel, height) + 30 * pixel;
  for (const sculpt::SceneLines& lines : scene.lines) {
    if (lines.name.empty()) continue;
    const Colour tint = line_colour(lines.look, theme);
    const float thick = (lines.look == sculpt::LineLook::overlay ? 1.2F : 3) * pixel;
    canvas.bar(left, y - 0.5F * thick, right - left, thick, 0.5F * thick, [&](float) { return tint; });
    canvas.text(left - k_gap * pixel, y + 0.36F * k_tick_size * pixel, k_tick_size * pixel, lines.name, theme.text,
                Align::right);
    y += 24 * pixel;
  }
}

void draw_label(Canvas& canvas, const Eigen::Vector2f& at, const std::string& line, const Theme& theme, float pixel,
                int width, bool hidden) {
  const float size = 12.5F * pixel;
  Colour ink = theme.text, halo = theme.halo;
  if (hidden) {
    ink.alpha *= 0.35F;
    halo.alpha *= 0.25F;
  }
  canvas.disc(at.x(), at.y(), 3.4F * pixel, halo);
  canvas.disc(at.x(), at.y(), 2.2F * pixel, ink);
  const bool to_the_left =
      at.x() + 8 * pixel + canvas.font().width(line, size) > static_cast<float>(width) - 4 * pixel;
  canvas.text(at.x() + (to_the_left ? -7 : 7) * pixel, at.y() - 4 * pixel, size, line, ink,
              to_the_left ? Align::right : Align::left, halo);
}

}  // namespace argil::view
