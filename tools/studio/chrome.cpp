#include "tools/studio/chrome.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tools/view/legend.h"

namespace argil::studio {

Layout lay_out(const Desk& desk, int width, int height) {
  const Ui& ui = *desk.ui;
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  const float gap = ui.px(k_gap), menu = ui.px(k_menu_height);
  Layout l;
  l.menu = {0, 0, w, menu};
  l.status = {0, h - ui.px(k_status_height), w, ui.px(k_status_height)};
  l.timeline = {0, l.status.y - ui.px(k_timeline_height), w, ui.px(k_timeline_height)};
  const float top = menu + gap, bottom = l.timeline.y - gap;
  if (!desk.settings.panels) {
    l.free = {0, menu, w, l.timeline.y - menu};
    l.shelf = l.panel = {0, 0, 0, 0};
    l.legend = {w - gap - ui.px(96), top, ui.px(96), ui.px(320)};
    return l;
  }
  l.shelf = {gap, top, ui.px(k_shelf_width), bottom - top};
  const float panel = ui.px(k_panel_width);
  l.panel = {w - gap - panel, top, panel, bottom - top};
  l.legend = {l.panel.x - gap - ui.px(96), top, ui.px(96), std::min(ui.px(320), bottom - top)};
  const float left = l.shelf.right() + gap;
  l.free = {left, menu, l.panel.x - gap - left, l.timeline.y - menu - ui.px(44)};
  return l;
}

namespace {

// A hairline of the shelf stands between forces, paint, and the rest.
bool parted(const ShelfTool& above, const ShelfTool& below) {
  const auto group = [](ToolKind kind) {
    return kind == ToolKind::pin || kind == ToolKind::mask ? ToolKind::paint
           : kind == ToolKind::curve                       ? ToolKind::extrude
                                                           : kind;
  };
  return group(above.kind) != group(below.kind);
}

}  // namespace

void draw_shelf(Desk& desk, const Layout& layout) {
  if (!desk.settings.panels) return;
  Ui& ui = *desk.ui;
  const float margin = ui.px(4), line = ui.px(9);
  const auto& tools = shelf_tools();
  // In a low window the tools stand closer.
  const float room = layout.shelf.height - 2 * margin - 4 * line;
  const float step = std::min(ui.px(40), room / static_cast<float>(tools.size()));
  const float cell = step - margin, width = ui.px(36);
  float height = 2 * margin;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (i > 0 && parted(tools[i - 1], tools[i])) height += line;
    height += i + 1 < tools.size() ? step : cell;
  }
  const Rect place{layout.shelf.x, layout.shelf.y, layout.shelf.width, std::min(height, layout.shelf.height)};
  ui.begin_panel("shelf", place, ui.tokens().panel, k_corner);
  float y = place.y + margin;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (i > 0 && parted(tools[i - 1], tools[i])) {
      ui.list().AddRectFilled({place.x + ui.px(9), y + ui.px(1)}, {place.right() - ui.px(9), y + ui.px(2)},
                              ui.tokens().outline);
      y += line;
    }
    std::string tooltip = std::string(tools[i].label) + ": " + tools[i].help;
    if (i < 9)
      tooltip += "  ·  " + desk.bindings.word_of(static_cast<Action>(static_cast<std::size_t>(Action::tool_1) + i));
    if (ui.icon_button(tools[i].label, {place.x + margin, y, width, cell}, tools[i].icon,
                       i == desk.settings.tool && !desk.settings.choosing, tooltip))
      desk.take_tool(i);
    y += step;
  }
  ui.set_cursor(place.x, place.y, place.width);
  ui.end_panel();
}

void draw_legend(Desk& desk, const Layout& layout) {
  if (!desk.now->scene || !desk.now->scene->legend || desk.now->scene->surface.values.empty()) return;
  const sculpt::SceneLegend& legend = *desk.now->scene->legend;
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const Rect& place = layout.legend;
  const float bar_width = ui.px(16), top = place.y + ui.px(34),
              height = std::min(ui.px(240), place.height - ui.px(60));
  const float left = place.right() - bar_width;
  ui.text(draw, ui.fonts().small, {place.x, place.y + ui.px(4), place.width, ui.px(22)}, t.quiet, legend.title,
          Side::right);
  const view::MapColours& map = view::map_colours(legend.map);
  constexpr int k_parts = 40;
  for (int i = 0; i < k_parts; ++i) {
    const auto colour = [&](int k) { return ink(view::field_colour(map, 1 - static_cast<double>(k) / k_parts)); };
    const float y0 = top + height * static_cast<float>(i) / k_parts,
                y1 = top + height * static_cast<float>(i + 1) / k_parts;
    draw.AddRectFilledMultiColor({left, y0}, {left + bar_width, y1}, colour(i), colour(i), colour(i + 1),
                                 colour(i + 1));
  }
  draw.AddRect({left - 1, top - 1}, {left + bar_width + 1, top + height + 1}, faded(t.panel, 0.9F), ui.px(3), 0,
               ui.px(2));
  for (const view::Tick& tick : view::legend_ticks(legend, 5)) {
    const double share = (tick.value - legend.low) / std::max(1e-300, legend.high - legend.low);
    const float y = top + height * static_cast<float>(1 - share);
    draw.AddLine({left - ui.px(4), y}, {left, y}, t.faint, ui.px(1));
    ui.text(draw, ui.fonts().small,
            {place.x - ui.px(40), y - ui.px(10), left - ui.px(8) - place.x + ui.px(40), ui.px(20)}, t.quiet,
            tick.text, Side::right);
  }
  ui.note_control(ControlKind::reading, "Legend", "What the colours mean: " + legend.title, legend.unit,
                  {left - ui.px(40), top, bar_width + ui.px(40), height});
}

}  // namespace argil::studio
