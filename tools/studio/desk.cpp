#include "tools/studio/desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace argil::studio {

const std::vector<std::string>& cycled_fields() {
  static const std::vector<std::string> fields{"", "strain", "stress", "displacement", "young_modulus", "density"};
  return fields;
}

std::optional<sculpt::ElementType> Desk::pointing() const {
  if (settings.choosing || tool().kind != ToolKind::extrude) return settings.choosing;
  return sculpt::ElementType::faces;
}

const sculpt::Selection& Desk::selection() const {
  static const sculpt::Selection k_nothing;
  return now->state.selection ? *now->state.selection : k_nothing;
}

void Desk::choose(std::optional<sculpt::ElementType> type) {
  settings.choosing = type;
  pointed.reset();
  settings.panel = Panel::tool;
  show();
}

void Desk::drop_pending() {
  if (pending.tool == nullptr) return;
  pending = {};
  workshop->preview({});
}

void Desk::take_tool(std::size_t index) {
  if (index >= shelf_tools().size()) return;
  settings.tool = index;
  settings.panel = Panel::tool;
  // A tool of the shelf works on clay: selecting is over.
  drop_pending();
  settings.choosing.reset();
  show();
  if (*tool().name != '\0') brush.name = tool().name;
  // What is painted should be seen; clay comes back with the next tool.
  const bool paints = *tool().field != '\0';
  if (paints ? settings.field != tool().field : settings.field_of_tool) {
    settings.field = tool().field;
    settings.fixed_range = false;
    show();
  }
  settings.field_of_tool = paints;
}

namespace {

// A brush that does something sensible to a solid of which nothing else is known: a fifth of its size, and so
// strong that a radius of travel moves the clay by about half of it.
sculpt::Tool fitting_brush(const Snapshot& now) {
  sculpt::Tool brush = now.tool;
  const auto rounded = [](double value) {
    const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1);
    return std::round(value / digit) * digit;
  };
  const double size = (now.high - now.low).maxCoeff();
  const double modulus = now.materials[static_cast<std::size_t>(sculpt::FieldName::young_modulus)].mean;
  if (!(size > 0) || !(modulus > 0)) return brush;
  brush.radius = rounded(0.25 * size);
  brush.strength = rounded(0.7 * modulus * brush.radius);
  brush.largest_force = rounded(brush.strength * brush.radius);
  return brush;
}

}  // namespace

void Desk::follow_solid() {
  const bool another = now->solid_number != brush_solid, line = now->tool_number != brush_line;
  const bool is_usual = tool_line(sculpt::Tool{}, now->tool).empty();
  // As long as nobody touched the brush that was chosen here, it goes with the material.
  sculpt::Tool untouched = fitted_brush;
  untouched.name = brush.name;
  const bool refits = is_usual && now->scene && tool_line(untouched, brush).empty();
  if (!another && !line && !refits) return;
  brush_solid = now->solid_number;
  brush_line = now->tool_number;
  const std::string name = line ? now->tool.name : brush.name;
  brush = is_usual && now->scene ? fitting_brush(*now) : now->tool;
  if (is_usual) fitted_brush = brush;
  brush.name = name;
  for (std::size_t i = 0; line && i < shelf_tools().size(); ++i)
    if (shelf_tools()[i].name == name && i != settings.tool) take_tool(i);
}

void Desk::show() const {
  Shown shown;
  shown.field = settings.field;
  if (!settings.field.empty() && settings.fixed_range && settings.range_low < settings.range_high)
    shown.range = {settings.range_low, settings.range_high};
  if (settings.cut) shown.clip = sculpt::ClipPlane{settings.cut_point, settings.cut_normal};
  shown.cage = settings.cage;
  shown.finest_wires = settings.finest_wires;
  shown.peel = settings.peel;
  shown.energy = wants_energy;
  shown.selectable = pointing().has_value();
  shown.curve = curve.points;
  workshop->post([shown](Bench& bench) { bench.show(shown); });
}

void Desk::open_dialogue(Dialogue which, const std::string& text) {
  dialogue = which;
  typed = text;
  chosen = 0;
}

std::string Desk::tooltip(Action action) const {
  const std::string keys = bindings.word_of(action);
  return std::string(info(action).help) + (keys.empty() ? "" : "  ·  " + keys);
}

bool Desk::perform(Action action) {
  using enum Action;
  const auto post = [&](auto order) { workshop->post(order); };
  switch (action) {
    case new_block:
      workshop->run_together(block_lines());
      return true;
    case samples:
      open_dialogue(Dialogue::samples);
      return true;
    case devices:
      open_dialogue(Dialogue::devices);
      return true;
    case unsaved_work:
      open_dialogue(Dialogue::unsaved);
      return true;
    case open:
      open_dialogue(Dialogue::open, folder == "." ? "" : folder.string() + "/");
      return true;
    case save:
      if (!now->file.empty()) {
        post([file = std::filesystem::path(now->file)](Bench& bench) { bench.save(file); });
        return true;
      }
      [[fallthrough]];
    case save_as:
      open_dialogue(Dialogue::save, now->file.empty() ? (folder / "untitled.argil").string() : now->file);
      return true;
    case screenshot:
      takes_picture = true;
      return true;
    case film:
    case turntable:
      post([turns = action == turntable](Bench& bench) { bench.film(turns); });
      return true;
    case quit:
      quits = true;
      return true;
    case undo:
      post([](Bench& bench) { bench.undo(); });
      return true;
    case redo:
      post([](Bench& bench) { bench.redo(); });
      return true;
    case search:
      open_dialogue(dialogue == Dialogue::search ? Dialogue::none : Dialogue::search);
      return true;
    case sheet_of_keys:
      open_dialogue(dialogue == Dialogue::keys ? Dialogue::none : Dialogue::keys);
      return true;
    case forces_off:
      post([](Bench& bench) {
        bench.cancel_stroke();
        bench.set_playing(false);
        const sculpt::AppliedLoads& loads = *bench.session().document().state().loads;
        std::vector<std::string> lines;
        if (!loads.forces.empty()) lines.emplace_back("force clear");
        if (!loads.pressures.empty()) lines.emplace_back("pressure clear");
        if (!loads.gravity.isZero() || !loads.gravity_track.empty()) lines.emplace_back("gravity 0 0 0");
        if (!lines.empty()) bench.run_together(lines);
        bench.say(MessageKind::warning, "all force is off");
      });
      return true;
    case play:
      post([](Bench& bench) { bench.set_playing(!bench.is_playing()); });
      return true;
    case one_step:
      run("step 1");
      return true;
    case to_rest:
      run("solve");
      return true;
    case symmetry:
      brush.symmetry = brush.symmetry == 0 ? 'x' : '\0';
      return true;
    case keep_shape:
      settings.keep_shape = !settings.keep_shape;
      return true;
    case wireframe:
      settings.wireframe = !settings.wireframe;
      return true;
    case cage:
      settings.cage = !settings.cage;
      show();
      return true;
    case next_field: {
      const auto& fields = cycled_fields();
      const auto at = std::find(fields.begin(), fields.end(), settings.field);
      settings.field_of_tool = false;
      settings.field = at == fields.end() || at + 1 == fields.end() ? fields.front() : *(at + 1);
      settings.fixed_range = false;
      show();
      return true;
    }
    case finer:
    case coarser:
      if (now->scene) {
        const int level = now->state.level + (action == finer ? 1 : -1);
        if (level >= 0 && level <= 8) run(fmt::format("levels {}", level));
      }
      return true;
    case brush_smaller:
    case brush_larger:
      brush.radius *= action == brush_larger ? 1.1 : 1 / 1.1;
      return true;
    case panels:
      settings.panels = !settings.panels;
      return true;
    case theme:
      settings.light = !settings.light;
      return true;
    case first_minute:
      card = !card;
      return true;
    default:
      break;
  }
  if (action >= tool_1 && action <= tool_9) {
    take_tool(static_cast<std::size_t>(action) - static_cast<std::size_t>(tool_1));
    return true;
  }
  return false;
}

}  // namespace argil::studio
