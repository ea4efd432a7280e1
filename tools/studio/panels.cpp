#include "tools/studio/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "sculpt/document_loads.h"
#include "tools/studio/plots.h"
#include "tools/studio/quantity.h"
#include "tools/studio/select_mode.h"

namespace argil::studio {

namespace {

void reading(Ui& ui, const char* name, double value, const std::string& unit, const std::string& tooltip) {
  const Quantity words = shown(value, unit);
  ui.reading_row(name, words.number, words.unit, tooltip);
}

/// The choices that a command gives for a word, from the one table.
std::vector<std::string> choices_of(const char* command, const char* parameter) {
  for (const sculpt::Command& c : sculpt::command_table())
    if (c.name == command)
      for (const sculpt::Parameter& p : c.parameters)
        if (p.name == parameter) return p.choices;
  return {};
}

double rounded(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return std::round(value / step) * step;
}

std::size_t index_of(const std::vector<std::string>& words, const std::string& word) {
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
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
    std::size_t falloff = index_of(falloffs, brush.falloff);
    if (ui.choice_row("Falloff", falloffs, falloff, "How the brush weakens towards its rim"))
      brush.falloff = falloffs[falloff];
    std::size_t axis = brush.symmetry == 0 ? 0 : index_of(axes, std::string(1, brush.symmetry));
    if (ui.choice_row(
            "Symmetry", axes, axis,
            "Its mirror image along this axis acts as well  ·  " + desk.bindings.word_of(Action::symmetry)))
      brush.symmetry = axis == 0 ? '\0' : axes[axis].front();
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

void material_panel(Desk& desk) {
  Ui& ui = *desk.ui;
  const Snapshot& now = *desk.now;
  if (!now.scene) {
    ui.section("Material");
    ui.note("Material belongs to a solid. Begin with a block, or open a file.");
    return;
  }
  struct Row {
    sculpt::FieldName field;
    const char *label, *unit, *help;
    double low, high;
    bool logarithmic;
  };
  using enum sculpt::FieldName;
  static constexpr Row k_rows[] = {
      {young_modulus, "Young's modulus", "Pa", "How stiff: rubber 1 MPa, clay 20 kPa", 1e2, 1e12, true},
      {poisson_ratio, "Poisson's ratio", "", "How much it grows thin when drawn out; 0.5 keeps its volume", -0.5,
       0.4999, false},
      {density, "Density", "kg/m^3", "Mass of a cubic metre; water has 1000", 1, 2e4, true},
      {damping, "Damping", "1/s", "How fast motion dies out", 0, 50, false},
      {stiffness_damping, "Damping of strain", "s", "How fast deformation dies out", 0, 1, false}};
  ui.section("Everywhere");
  for (const Row& row : k_rows) {
    const auto index = static_cast<std::size_t>(row.field);
    const Snapshot::Material& material = now.materials[index];
    const sculpt::FieldInfo& field = sculpt::field_table()[index];
    double value = material.mean;
    const std::string help = std::string(row.help) + (material.uniform ? "" : ". It varies; shown is the mean");
    if (ui.number_row(row.label, value,
                      {.unit = row.unit,
                       .tooltip = help,
                       .low = std::min(row.low, value),
                       .high = std::max(row.high, value),
                       .reset = field.initial,
                       .logarithmic = row.logarithmic}))
      desk.run(fmt::format("set {} {}", field.word, value));
  }
  ui.section("The solid");
  const Quantity mass = shown(now.mass, "");
  ui.reading_row("Mass", mass.number, "kg", "Of the whole solid");
  ui.reading_row("Volume", shown(1e3 * now.volume, "").number, "l", "Of the solid as it stands");
  ui.reading_row("Control cells", fmt::format("{}", now.control_cells), "", "Of the solid that is refined");
  ui.note("Paint stiffness or mass with the tools of the shelf to vary them.");
}

void flow_rows(Desk& desk) {
  Ui& ui = *desk.ui;
  const Snapshot& now = *desk.now;
  const sculpt::Plasticity& flow = now.state.plasticity;
  ui.section("Plastic flow");
  bool flows = flow.on;
  const double modulus = now.materials[static_cast<std::size_t>(sculpt::FieldName::young_modulus)].mean;
  if (ui.toggle_row("Flows", flows, "Beyond its yield stress the clay keeps the shape that it was given"))
    desk.run(flows ? fmt::format("plasticity yield {:.3g} creep 0.1", 0.05 * modulus) : "plasticity off");
  if (!flow.on) return;
  double yield = flow.law.yield, creep = flow.law.relaxation;
  const auto take = [&] { desk.run(fmt::format("plasticity yield {} creep {}", yield, creep)); };
  if (ui.number_row("Yield stress", yield,
                    {.unit = "Pa",
                     .tooltip = "Von Mises stress beyond which it flows; 0: it forgets all shape in time",
                     .low = 0,
                     .high = std::max(modulus, yield),
                     .reset = 0.05 * modulus}))
    take();
  if (ui.number_row("Creep", creep,
                    {.unit = "s",
                     .tooltip = "Time in which what is beyond fades; 0: at once",
                     .low = 0,
                     .high = std::max(10.0, creep),
                     .reset = 0.1}))
    take();
}

void physics_panel(Desk& desk, float x, float width) {
  Ui& ui = *desk.ui;
  const Snapshot& now = *desk.now;
  if (!now.scene) {
    ui.section("Physics");
    ui.note("Physics acts on a solid. Begin with a block, or open a file.");
    return;
  }
  ui.section("Loads");
  const Eigen::Vector3d gravity = sculpt::gravity_at(*now.state.loads, now.state.motion->time);
  double g[3] = {gravity.x(), gravity.y(), gravity.z()};
  if (ui.vector_row("Gravity", g,
                    {.unit = "m/s²", .tooltip = "Acceleration; on earth 0 0 -9.81", .low = -1e3, .high = 1e3}))
    desk.run(fmt::format("gravity {} {} {}", g[0], g[1], g[2]));
  ui.reading_row("Held points", fmt::format("{}", now.pinned), "",
                 "Control points that do not move; paint more with Pin");
  ui.section("Refinement");
  double level = now.state.level;
  if (ui.number_row("Level", level,
                    {.unit = "",
                     .tooltip = "How often the control solid is refined; each level is eight times dearer",
                     .low = 0,
                     .high = 5,
                     .reset = 2}) &&
      std::lround(level) != now.state.level)
    desk.run(fmt::format("levels {}", std::lround(level)));
  ui.section("Method");
  static const auto spaces = choices_of("space", "space"), models = choices_of("model", "model"),
                    methods = choices_of("integrator", "method");
  std::size_t space = index_of(spaces, std::string(fem::word(now.state.space)));
  if (ui.choice_row("Space", spaces, space, "Which functions the solid may move by"))
    desk.run("space " + spaces[space]);
  std::size_t model = index_of(models, now.state.model.name);
  if (ui.choice_row("Model", models, model, "The law of force")) desk.run("model " + models[model]);
  std::size_t method = index_of(methods, std::string(fem::method_kind(now.state.method).name));
  if (ui.choice_row("Integrator", methods, method, "How time is stepped"))
    desk.run("integrator " + methods[method]);
  bool guard = now.state.guard_on;
  if (ui.toggle_row("Guard", guard, "Notices what goes wrong in a step and mends it"))
    desk.run(guard ? "guard on" : "guard off");
  flow_rows(desk);
  ui.section("Cost");
  reading(ui, "Time step", now.state.time_step, "s", "Of the simulation");
  ui.reading_row("A step takes", desk.virtual_clock || now.steps == 0 ? "—" : fmt::format("{:.1f}", now.step_ms),
                 "ms", "Mean of the last thirty steps");
  ui.reading_row("Steps", fmt::format("{}", now.steps), "", "Taken since the session began");
  ui.section("Energy");
  draw_plot(desk,
            {"Energy over time", "Elastic and kinetic energy of the body, step by step", "J",
             "Let time run, or draw at the clay"},
            desk.energy_plot, x, width);
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
      material_panel(desk);
      break;
    case Panel::physics:
      physics_panel(desk, left, width);
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
