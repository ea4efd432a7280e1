// Of panels.h: what the solid is made of, and what acts on it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/document_loads.h"
#include "tools/studio/panels.h"
#include "tools/studio/plots.h"
#include "tools/studio/quantity.h"
#include "tools/studio/search.h"

namespace argil::studio {

namespace {

void reading(Ui& ui, const char* name, double value, const std::string& unit, const std::string& tooltip) {
  const Quantity words = shown(value, unit);
  ui.reading_row(name, words.number, words.unit, tooltip);
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

}  // namespace

void draw_material_panel(Desk& desk) {
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

void draw_physics_panel(Desk& desk, float x, float width) {
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
    desk.run(
        fmt::format("{}gravity {} {} {}", now.state.loads->gravity_track.empty() ? "" : "key ", g[0], g[1], g[2]));
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
  std::string space(fem::word(now.state.space)), model = now.state.model.name,
                                                 method(fem::method_kind(now.state.method).name);
  if (ui.choice_row("Space", spaces, space, "Which functions the solid may move by")) desk.run("space " + space);
  if (ui.choice_row("Model", models, model, "The law of force")) desk.run("model " + model);
  if (ui.choice_row("Integrator", methods, method, "How time is stepped")) desk.run("integrator " + method);
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

}  // namespace argil::studio
