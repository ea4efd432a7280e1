// Of chrome.h: what lies over the view to help: what to begin with, the card of the first minute, what the pointer
// and keys do now.

#include <imgui.h>

#include <algorithm>

#include "tools/studio/chrome.h"

namespace argil::studio {

namespace {

struct Hint {
  std::string strong, rest;
};

void draw_line(Desk& desk, const Layout& layout, std::vector<Hint> hints) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Rect& free = layout.free;
  const float y = layout.timeline.y - ui.px(16);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const std::string between = "   ·   ";
  const auto width_of = [&](const Hint& hint) {
    return ui.width_of(ui.fonts().small_strong, hint.strong) + ui.width_of(ui.fonts().small, hint.rest);
  };
  float width = ui.px(32) - ui.width_of(ui.fonts().small, between);
  for (const Hint& hint : hints) width += width_of(hint) + ui.width_of(ui.fonts().small, between);
  // Where there is less room, the first ones are said.
  for (; hints.size() > 1 && width > free.width; hints.pop_back())
    width -= width_of(hints.back()) + ui.width_of(ui.fonts().small, between);
  const float height = ui.px(32);
  Rect at{free.x + 0.5F * (free.width - width), y - height, width, height};
  ui.box(draw, at, faded(t.panel, 0.9F));
  ui.note_control(ControlKind::reading, "Hints", "What the pointer and keys do now", "", at);
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
}

void draw_empty(Desk& desk, const Layout& layout, const Perform& perform) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Rect& free = layout.free;
  const float width = ui.px(360), height = ui.px(152);
  const Rect place{free.x + 0.5F * (free.width - width), free.y + 0.42F * free.height - 0.5F * height, width,
                   height};
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
}

void draw_card(Desk& desk, const Layout& layout) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Rect& free = layout.free;
  struct First {
    Icon icon;
    const char *strong, *rest;
  };
  const std::string size_key = desk.bindings.word_of(Action::brush_radius);
  static constexpr First k_first[] = {{icons::hand, "Drag on clay", "pulls it"},
                                      {icons::eye, "Drag beside it", "turns the view"},
                                      {icons::search, "Wheel", "comes nearer"},
                                      {icons::expand, nullptr, "sizes the brush"},  // its key
                                      {icons::deflate, "Ctrl", "inverts the tool"}};
  // In a narrow window in more than one row.
  constexpr std::size_t k_gestures = std::size(k_first);
  const float width = std::min(ui.px(560), std::max(ui.px(220), free.width - ui.px(8))), row = ui.px(82);
  const auto columns =
      std::min(k_gestures, static_cast<std::size_t>(std::max(1.0F, (width - ui.px(24)) / ui.px(96))));
  const float rows = static_cast<float>((k_gestures + columns - 1) / columns), height = ui.px(36) + rows * row;
  const Rect place{free.x + 0.5F * (free.width - width), layout.timeline.y - height - ui.px(16), width, height};
  ui.begin_panel("card", place, 0, 0);
  ImDrawList& draw = ui.list();
  draw.PushClipRectFullScreen();
  ui.shadow(draw, place, 8);
  draw.PopClipRect();
  ui.box(draw, place, t.raised, 8);
  const float column = (width - ui.px(24)) / static_cast<float>(columns);
  for (std::size_t i = 0; i < k_gestures; ++i) {
    const float x = place.x + ui.px(12) + column * static_cast<float>(i % columns),
                y = place.y + row * static_cast<float>(i / columns);
    ui.icon(draw, {x, y + ui.px(20), column, ui.px(26)}, t.accent, k_first[i].icon);
    ui.text(draw, ui.fonts().small_strong, {x, y + ui.px(54), column, ui.px(20)}, t.text,
            k_first[i].strong != nullptr ? k_first[i].strong : size_key, Side::centre);
    ui.text(draw, ui.fonts().small, {x, y + ui.px(74), column, ui.px(20)}, t.quiet, k_first[i].rest, Side::centre);
  }
  ui.note_control(ControlKind::reading, "First minute", "The first gestures; Help has them again", "", place);
  if (ui.icon_button("Close the card", {place.right() - ui.px(28), place.y + ui.px(4), ui.px(24), ui.px(24)},
                     icons::cross, false, "Closes the card; Help has it again"))
    desk.card = false;
  ui.end_panel();
}

std::vector<Hint> hints_of(const Desk& desk) {
  const ShelfTool& tool = desk.tool();
  std::vector<Hint> hints;
  const auto hint = [&](const std::string& strong, const std::string& rest) {
    if (!strong.empty()) hints.push_back({strong, rest});  // an action may have no key
  };
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
    if (desk.settings.peel > 0) hint("Wheel", " peels");
    return hints;
  }
  hint("Drag", std::string(" on clay ") + tool.verb);
  hint("drag beside", " orbits");
  if (tool.kind != ToolKind::extrude) hint(desk.bindings.word_of(Action::brush_radius), " radius");
  if (tool.kind != ToolKind::extrude && tool.kind != ToolKind::probe) hint("Ctrl", " inverts");
  if (tool.kind == ToolKind::force) hint("Shift", " smooths");
  if (desk.settings.peel > 0)
    hint("Wheel", " peels");
  else if (desk.settings.cut)
    hint("Wheel", " moves the cut");
  hint(desk.bindings.word_of(Action::select_next_type), " selects");
  return hints;
}

}  // namespace

void draw_hints(Desk& desk, const Layout& layout, const Perform& perform) {
  if (!desk.now->scene)
    draw_empty(desk, layout, perform);
  else if (desk.card)
    draw_card(desk, layout);
  else
    draw_line(desk, layout, hints_of(desk));
}

}  // namespace argil::studio
