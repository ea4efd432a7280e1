#include "tools/studio/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "tools/studio/plots.h"
#include "tools/studio/quantity.h"
#include "tools/studio/search.h"
#include "tools/studio/select_mode.h"
#include "tools/studio/settings_file.h"

namespace argil::studio {

namespace {

double rounded(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return std::round(value / step) * step;
}

void pen_row(Desk& desk) {
  static const std::vector<std::string> words(k_pen_words.begin(), k_pen_words.end());
  auto pen = static_cast<std::size_t>(desk.settings.pen);
  if (!desk.ui->choice_row(
          "Pen", words, pen,
          "What its pressure scales: the strength, or the radius of brushes that go over the clay. "
          "Its eraser inverts. Off: as a mouse"))
    return;
  desk.settings.pen = static_cast<PenScales>(pen);
  desk.workshop->post([lines = settings_lines(desk.settings)](Bench& bench) { bench.write_settings(lines); });
}

void tool_panel(Desk& desk, float x, float width) {
  Ui& ui = *desk.ui;
  const Snapshot& now = *desk.now;
  const ShelfTool& tool = desk.tool();
  const double size = std::max(1e-6, 0.5 * (now.high - now.low).norm());
  ui.section(tool.label);
  if (!now.scene) {
    ui.note("A tool needs a solid. Begin with a block, or open a file.");
    return;
  }
  sculpt::Tool& brush = desk.brush;
  if (tool.kind == ToolKind::extrude) {
    ui.note(tool.help);
  } else {
    ui.number_row("Radius", brush.radius,
                  {.unit = "m",
                   .tooltip = "Of what the brush touches  ·  " + desk.bindings.word_of(Action::brush_radius),
                   .low = std::min(1e-3 * size, brush.radius),
                   .high = std::max(2 * size, brush.radius),
                   .reset = rounded(0.35 * size),
                   .logarithmic = true});
    if (tool.kind == ToolKind::force || tool.kind == ToolKind::curve) {
      ui.number_row(
          "Strength", brush.strength,
          {.unit = "N/m",
           .tooltip = "Of the springs that the tool draws by  ·  " + desk.bindings.word_of(Action::brush_strength),
           .low = std::min(1.0, brush.strength),
           .high = std::max(1e5, brush.strength),
           .reset = 2000,
           .logarithmic = true});
      ui.number_row("Force limit", brush.largest_force,
                    {.unit = "N",
                     .tooltip = "The tool never applies more than this",
                     .low = std::min(1e-2, brush.largest_force),
                     .high = std::max(1e6, brush.largest_force),
                     .reset = 250,
                     .logarithmic = true});
    }
    if (tool.kind == ToolKind::paint) {
      if (ui.number_row("Factor", brush.amount,
                        {.unit = "",
                         .tooltip = "What is painted is so many times as large; inverted, as small",
                         .low = 1.01,
                         .high = 1e3,
                         .reset = 2,
                         .logarithmic = true}))
        brush.scales = true;
    }
    static const std::vector<std::string> falloffs = choices_of("tool", "falloff");
    static const std::vector<std::string> axes{"none", "x", "y", "z"};
    ui.choice_row("Falloff", falloffs, brush.falloff, "How the brush weakens towards its rim");
    std::string axis = brush.symmetry == 0 ? axes.front() : std::string(1, brush.symmetry);
    if (ui.choice_row(
            "Symmetry", axes, axis,
            "Its mirror image along this axis acts as well  ·  " + desk.bindings.word_of(Action::symmetry)))
      brush.symmetry = axis == axes.front() ? '\0' : axis.front();
    if (desk.has_pen && tool.kind != ToolKind::probe) pen_row(desk);
    if (tool.kind == ToolKind::force || tool.kind == ToolKind::curve)
      ui.toggle_row("Keep the shape", desk.settings.keep_shape, desk.tooltip(Action::keep_shape));
  }
  ui.section("Under the brush");
  const Reading& under = desk.reading;
  const Quantity young = under.there ? shown(under.young_modulus, "Pa") : Quantity{"—", "Pa"};
  ui.reading_row("Young's modulus", young.number, young.unit, "How stiff the clay is there");
  ui.reading_row("Strain", under.there && under.strain >= 0 ? shown(100 * under.strain, "%").number : "—", "%",
                 "How far it is deformed there, as of the last rest");
  const Quantity felt = under.felt > 0 ? shown(under.felt, "N/m") : Quantity{"—", "N/m"};
  ui.reading_row("Felt stiffness", felt.number, felt.unit,
                 "Force of the last stroke over how far the clay went, or what the probe read");
  ui.section("Force");
  draw_plot(
      desk,
      {"Force over time", "The force of the tool during the last stroke", "N", "The force of a stroke shows here"},
      desk.force_plot, x, width);
}

}  // namespace

void draw_panels(Desk& desk, const Layout& layout, const Perform& perform) {
  if (!desk.settings.panels) return;
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Rect& place = layout.panel;
  const float margin = ui.px(16), tabs = ui.px(44);
  ui.begin_panel("panel", {place.x, place.y, place.width, tabs}, 0, 0);
  ui.list().AddRectFilled({place.x, place.y}, {place.right(), place.y + tabs}, t.panel, ui.px(k_corner),
                          ImDrawFlags_RoundCornersTop);
  float widths[5], sum = 0;
  for (std::size_t i = 0; i < 5; ++i)
    sum += widths[i] = ui.width_of(ui.fonts().small_strong, k_panel_names[i]) + ui.px(4);
  const float gap = (place.width - 2 * margin - sum) / 4;
  float x = place.x + margin;
  ui.list().AddRectFilled({place.x + margin, place.y + tabs - ui.px(6)},
                          {place.right() - margin, place.y + tabs - ui.px(5)}, t.outline);
  static constexpr const char* k_help[] = {"What the tool does, and what lies under it",
                                           "Stiffness, density, damping", "Loads, refinement, method",
                                           "Colours, lines, the cut", "Every line of the session"};
  for (std::size_t i = 0; i < 5; ++i) {
    const bool active = static_cast<std::size_t>(desk.settings.panel) == i;
    if (ui.tab(k_panel_names[i], {x, place.y + ui.px(8), widths[i], tabs - ui.px(13)}, active, k_help[i]))
      desk.settings.panel = static_cast<Panel>(i);
    x += widths[i] + gap;
  }
  ui.end_panel();

  // As high as what it holds, as of the last frame.
  const float high = std::min(place.height - tabs, desk.panel_height > 0 ? desk.panel_height : place.height - tabs);
  const Rect body{place.x, place.y + tabs, place.width, high};
  ui.begin_panel("panel body", body, 0, 0, true);
  ui.list().AddRectFilled({body.x, body.y}, {body.right(), body.bottom()}, t.panel, ui.px(k_corner),
                          ImDrawFlags_RoundCornersBottom);
  const float left = place.x + margin, width = place.width - 2 * margin;
  ui.set_cursor(left, body.y + ui.px(2) - ImGui::GetScrollY(), width);
  switch (desk.settings.panel) {
    case Panel::tool:
      if (desk.settings.choosing)
        draw_select_panel(desk, left, width, perform);
      else
        tool_panel(desk, left, width);
      break;
    case Panel::material:
      draw_material_panel(desk);
      break;
    case Panel::physics:
      draw_physics_panel(desk, left, width);
      break;
    case Panel::fields:
      draw_fields_panel(desk, perform);
      break;
    case Panel::history:
      draw_history_panel(desk, perform, left, width);
      break;
  }
  ui.skip(8);
  desk.panel_height = ui.cursor_y() + ImGui::GetScrollY() - body.y + ui.px(4);
  ui.end_panel();
}

}  // namespace argil::studio
