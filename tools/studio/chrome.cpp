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

void draw_hints(Desk& desk, const Layout& layout, const Perform& perform) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Rect& free = layout.free;
  const float middle = free.x + 0.5F * free.width;
  struct Hint {
    std::string strong, rest;
  };
  const auto pill = [&](const std::vector<Hint>& hints, float y) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const std::string between = "   ·   ";
    float width = ui.px(32);
    for (std::size_t i = 0; i < hints.size(); ++i)
      width += ui.width_of(ui.fonts().small_strong, hints[i].strong) +
               ui.width_of(ui.fonts().small, hints[i].rest) + (i > 0 ? ui.width_of(ui.fonts().small, between) : 0);
    const float height = ui.px(32);
    Rect at{middle - 0.5F * width, y - height, width, height};
    ui.box(draw, at, faded(t.panel, 0.9F));
    float x = at.x + ui.px(16);
    for (std::size_t i = 0; i < hints.size(); ++i) {
      const auto add = [&](ImFont* font, Ink colour, const std::string& line) {
        ui.text(draw, font, {x, at.y, 0, height}, colour, line);
        x += ui.width_of(font, line);
      };
      if (i > 0) add(ui.fonts().small, t.faint, between);
      add(ui.fonts().small_strong, t.text, hints[i].strong);
      add(ui.fonts().small, t.quiet, hints[i].rest);
    }
  };

  if (!desk.now->scene) {
    const float width = ui.px(360), height = ui.px(152);
    const Rect place{middle - 0.5F * width, free.y + 0.42F * free.height - 0.5F * height, width, height};
    ui.begin_panel("empty", place, t.panel, 8);
    ui.text(ui.list(), ui.fonts().strong, {place.x, place.y + ui.px(18), width, ui.px(24)}, t.text,
            "Nothing here yet", Side::centre);
    ui.text(ui.list(), ui.fonts().small, {place.x, place.y + ui.px(46), width, ui.px(22)}, t.quiet,
            "Begin with a block, or drop a file on the window", Side::centre);
    if (ui.text_button("Begin with a block", {place.x + ui.px(32), place.y + ui.px(88), ui.px(140), ui.px(36)},
                       "New block", true, desk.tooltip(Action::new_block)))
      perform(Action::new_block);
    if (ui.text_button("Open a file", {place.x + width - ui.px(172), place.y + ui.px(88), ui.px(140), ui.px(36)},
                       "Open…", false, desk.tooltip(Action::open)))
      perform(Action::open);
    ui.end_panel();
    return;
  }

  if (desk.card) {
    struct First {
      Icon icon;
      const char *strong, *rest;
    };
    static constexpr First k_first[] = {{icons::hand, "Drag on clay", "pulls it"},
                                        {icons::eye, "Drag beside it", "turns the view"},
                                        {icons::search, "Wheel", "comes nearer"},
                                        {icons::expand, "F", "sizes the brush"},
                                        {icons::deflate, "Ctrl", "inverts the tool"}};
    const float width = ui.px(560), height = ui.px(118);
    const Rect place{middle - 0.5F * width, layout.timeline.y - height - ui.px(16), width, height};
    ui.begin_panel("card", place, 0, 0);
    ImDrawList& draw = ui.list();
    draw.PushClipRectFullScreen();
    ui.shadow(draw, place, 8);
    draw.PopClipRect();
    ui.box(draw, place, t.raised, 8);
    const float column = (width - ui.px(24)) / 5;
    for (std::size_t i = 0; i < std::size(k_first); ++i) {
      const float x = place.x + ui.px(12) + column * static_cast<float>(i);
      ui.icon(draw, {x, place.y + ui.px(20), column, ui.px(26)}, t.accent, k_first[i].icon);
      ui.text(draw, ui.fonts().small_strong, {x, place.y + ui.px(54), column, ui.px(20)}, t.text, k_first[i].strong,
              Side::centre);
      ui.text(draw, ui.fonts().small, {x, place.y + ui.px(74), column, ui.px(20)}, t.quiet, k_first[i].rest,
              Side::centre);
    }
    if (ui.icon_button("Close the card", {place.right() - ui.px(28), place.y + ui.px(4), ui.px(24), ui.px(24)},
                       icons::cross, false, "Closes the card; Help has it again"))
      desk.card = false;
    ui.end_panel();
    return;
  }

  const ShelfTool& tool = desk.tool();
  std::vector<Hint> hints;
  const auto hint = [&](const std::string& strong, const std::string& rest) { hints.push_back({strong, rest}); };
  if (desk.pending.tool != nullptr) {
    hint("Click", " or Enter does it");
    hint("Esc", " drops it");
    hint("Shift", " finely");
  } else if (desk.settings.choosing) {
    hint("Click", std::string(" selects ") + sculpt::word(*desk.settings.choosing));
    hint("Ctrl", " adds");
    hint("Double click", *desk.settings.choosing == sculpt::ElementType::edges ? " a loop" : " a whole piece");
    hint("Right click", " what can be done");
    hint(desk.bindings.word_of(Action::select_next_type), " goes on");
  } else if (tool.kind == ToolKind::curve && desk.curve.finished) {
    hint("Drag a handle", " draws the clay");
    hint("Esc", " drops the curve");
  } else if (tool.kind == ToolKind::curve) {
    hint("Click", " on clay lays a point");
    hint(desk.bindings.word_of(Action::erase), " takes the last");
    hint(desk.bindings.word_of(Action::confirm), " finishes");
    hint("Esc", " drops it");
  }
  if (!hints.empty()) {
    if (desk.settings.peel > 0) hints.push_back({"Wheel", " peels"});
    pill(hints, layout.timeline.y - ui.px(16));
    return;
  }
  hints = {{"Drag", std::string(" on clay ") + tool.verb}, {"drag beside", " orbits"}};
  if (tool.kind != ToolKind::extrude) hints.push_back({desk.bindings.word_of(Action::brush_radius), " radius"});
  if (tool.kind != ToolKind::extrude && tool.kind != ToolKind::probe) hints.push_back({"Ctrl", " inverts"});
  if (tool.kind == ToolKind::force) hints.push_back({"Shift", " smooths"});
  if (desk.settings.peel > 0)
    hints.push_back({"Wheel", " peels"});
  else if (desk.settings.cut)
    hints.push_back({"Wheel", " moves the cut"});
  hints.push_back({desk.bindings.word_of(Action::select_next_type), " selects"});
  pill(hints, layout.timeline.y - ui.px(16));
}

}  // namespace argil::studio
