#include "tools/studio/dialogues.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "tools/studio/device_dialogue.h"
#include "tools/studio/file_dialogues.h"
#include "tools/studio/key_editor.h"
#include "tools/studio/search.h"
#include "tools/studio/sheet.h"

namespace argil::studio {

namespace {

constexpr std::size_t k_shown = 9;

void take(Desk& desk, const Found& found, const Perform& perform) {
  if (found.action != nullptr) {
    desk.dialogue = Dialogue::none;
    perform(found.action->action);
    return;
  }
  const std::string& name = found.command->name;
  const bool begun = desk.typed == name || desk.typed.starts_with(name + ' ');
  if (begun ? can_run(desk.typed) : runs_alone(*found.command) && found.command->parameters.empty()) {
    desk.run(begun ? desk.typed : name);
    desk.dialogue = Dialogue::none;
  } else if (!begun) {
    desk.typed = name + ' ';
    desk.retake_focus = true;
  }
}

void draw_search(Desk& desk, const Layout& layout, const Perform& perform, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const auto found = search(desk.typed);
  desk.chosen = std::min(desk.chosen, found.empty() ? 0 : found.size() - 1);
  const std::size_t rows = std::min(found.size(), k_shown);
  const float wide = ui.px(600), field = ui.px(48), row = ui.px(28), foot = ui.px(74);
  const Rect place{0.5F * (static_cast<float>(width) - wide), layout.menu.bottom() + ui.px(40), wide,
                   field + row * static_cast<float>(std::max<std::size_t>(rows, 1)) + foot};
  open_sheet(desk, "search", place, width, height);
  ImDrawList& draw = ui.list();
  ui.icon(draw, {place.x + ui.px(8), place.y, ui.px(36), field}, t.quiet, icons::search, true);
  bool entered = false;
  const bool focus = desk.dialogue != desk.shown_dialogue || std::exchange(desk.retake_focus, false);
  if (ui.text_field("Command", {place.x + ui.px(40), place.y, wide - ui.px(56), field}, desk.typed,
                    "Name or meaning of a command; with its arguments it runs", focus, entered,
                    "Type to search; Enter runs, Up and Down choose"))
    desk.chosen = 0;
  draw.AddRectFilled({place.x, place.y + field - ui.px(1)}, {place.right(), place.y + field}, t.outline);
  ui.set_cursor(place.x + ui.px(6), place.y + field + ui.px(4), wide - ui.px(12));
  const std::size_t first = desk.chosen >= k_shown ? desk.chosen - k_shown + 1 : 0;
  if (found.empty()) {
    ui.set_cursor(place.x + ui.px(34), place.y + field + ui.px(10), wide);
    ui.note("Nothing is called that, and nothing does it. Try a shorter word.");
  }
  for (std::size_t i = first; i < std::min(found.size(), first + k_shown); ++i) {
    const Found& one = found[i];
    const std::string name = one.action != nullptr ? one.action->label : one.command->name;
    const std::string right =
        one.action != nullptr ? desk.bindings.word_of(one.action->action) : one.command->group;
    if (ui.list_row(name, right, false, i == desk.chosen,
                    one.action != nullptr ? one.action->help : one.command->summary))
      take(desk, one, perform);
  }
  if (entered && !found.empty()) {
    take(desk, found[desk.chosen], perform);
    if (desk.dialogue == Dialogue::search) desk.retake_focus = true;
  }
  // What it does, how it is written, and what is wrong with the line so far.
  if (!found.empty()) {
    const Found& one = found[std::min(desk.chosen, found.size() - 1)];
    const float y = place.bottom() - foot + ui.px(8);
    draw.AddRectFilled({place.x, y - ui.px(1)}, {place.right(), y}, t.outline);
    const Rect line{place.x + ui.px(16), y + ui.px(8), wide - ui.px(32), ui.px(20)};
    const auto fitted = [&](const std::string& words) { return ui.fitted(ui.fonts().small, words, line.width); };
    ui.text(draw, ui.fonts().small, line, t.text,
            fitted(one.action != nullptr ? one.action->help : one.command->summary));
    std::string below;
    Ink colour = t.quiet;
    if (one.command != nullptr) {
      below = sculpt::usage(*one.command);
      const bool begun =
          desk.typed.starts_with(one.command->name + ' ') && desk.typed.size() > one.command->name.size() + 1;
      if (const std::string fault = begun ? fault_of(desk.typed) : ""; !fault.empty()) {
        below = fault;
        colour = t.warning;
      } else if (begun) {
        below = "Enter runs:  " + desk.typed;
        colour = t.good;
      }
    }
    ui.text(draw, ui.fonts().small, {line.x, line.bottom() + ui.px(4), line.width, ui.px(20)}, colour,
            fitted(below));
  }
  ui.end_panel();
}

}  // namespace

bool search_key(Desk& desk, int pressed, const Perform&) {
  if (desk.dialogue != Dialogue::search) return false;
  if (pressed == key::down) ++desk.chosen;
  if (pressed == key::up && desk.chosen > 0) --desk.chosen;
  return pressed == key::down || pressed == key::up;
}

void draw_dialogues(Desk& desk, const Layout& layout, const Perform& perform, int width, int height) {
  const Dialogue which = desk.dialogue;
  switch (which) {
    case Dialogue::none:
      break;
    case Dialogue::search:
      draw_search(desk, layout, perform, width, height);
      break;
    case Dialogue::keys:
      draw_key_editor(desk, width, height);
      break;
    case Dialogue::open:
    case Dialogue::save:
      draw_file(desk, which == Dialogue::save, width, height);
      break;
    case Dialogue::samples:
      draw_samples(desk, width, height);
      break;
    case Dialogue::devices:
      draw_devices(desk, width, height);
      break;
    case Dialogue::unsaved:
      draw_unsaved(desk, width, height);
      break;
  }
  desk.shown_dialogue = which;
}

}  // namespace argil::studio
