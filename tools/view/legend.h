#pragma once
// The bar of colours of a field, with title, unit and round ticks; the key of lines that have names; and the labels
// of places.

#include <string>
#include <vector>

#include "tools/view/camera.h"
#include "tools/view/canvas.h"

namespace argil::view {

struct Tick {
  double value;      // in the legend's own unit
  std::string text;  // the highest one with the unit
};

/// At most about `most` ticks at round numbers within [low, high], ascending, in a prefix of the unit that keeps
/// them short ("0", "50", "100 kPa"); at least one.
[[nodiscard]] std::vector<Tick> legend_ticks(const sculpt::SceneLegend& legend, int most);

/// Part of the picture's width that the legend takes on the right, at this size of a pixel (1 at 1280 x 800).
[[nodiscard]] double legend_width(const sculpt::SceneLegend& legend, const Font& font, float pixel, int width);

/// Of kinds a list instead.
void draw_legend(Canvas& canvas, const sculpt::SceneLegend& legend, const Theme& theme, float pixel, int width,
                 int height);

/// Above the picture, at the left.
void draw_title(Canvas& canvas, const std::string& title, const Theme& theme, float pixel);
/// At its foot, at the left.
void draw_felt(Canvas& canvas, const sculpt::SceneFelt& felt, const Theme& theme, float pixel, int height);

/// Part of the picture's width that the key takes on the right; 0 if no lines have a name.
[[nodiscard]] double key_width(const sculpt::Scene& scene, const Font& font, float pixel, int width);

/// A stroke and a name for each set of lines that has one, at the right; below the legend where there is one.
void draw_key(Canvas& canvas, const sculpt::Scene& scene, const Theme& theme, float pixel, int width, int height);

/// A dot at the place and the text beside it; near the right side of the picture the text stands left of its dot.
/// Of a hidden place only a shade is drawn.
void draw_label(Canvas& canvas, const Eigen::Vector2f& at, const std::string& line, const Theme& theme, float pixel,
                int width, bool hidden);

}  // namespace argil::view
