#pragma once
// Flat drawing over a finished picture: what must be crisp at the picture's own size (legend, labels).

#include <functional>
#include <string_view>

#include "sculpt/renderer.h"
#include "tools/view/colour.h"
#include "tools/view/font.h"

namespace argil::view {

enum class Align { left, centre, right };

class Canvas {
 public:
  Canvas(sculpt::Picture& picture, const Font& font) : picture_(&picture), font_(&font) {}

  void disc(float x, float y, float radius, const Colour& fill);
  /// A rectangle with round corners; colour_at(y) gives the colour of a row, y from 0 at the top to 1.
  void bar(float x, float y, float width, float height, float corner,
           const std::function<Colour(float)>& colour_at);
  /// y is the line that the letters stand on. A halo of alpha > 0 is a soft rim behind them.
  void text(float x, float y, float size, std::string_view line, const Colour& fill, Align align = Align::left,
            const Colour& halo = {0, 0, 0, 0});
  const Font& font() const { return *font_; }

 private:
  void blend(int x, int y, const Colour& fill, float cover);
  sculpt::Picture* picture_;
  const Font* font_;
};

}  // namespace argil::view
