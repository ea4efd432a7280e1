#include "tools/studio/work_notes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace argil::studio {

namespace {

constexpr double k_patience = 0.1;  // [s], before work is worth a word

Rect begin_note(Desk& desk, const char* name, const Rect& place) {
  Ui& ui = *desk.ui;
  ui.begin_panel(name, place, 0, 0);
  ImDrawList& draw = ui.list();
  draw.PushClipRectFullScreen();
  ui.shadow(draw, place, 8);
  draw.PopClipRect();
  ui.box(draw, place, ui.tokens().raised, 8);
  return place;
}

}  // namespace

namespace {

/// What a note of work says and does; null `end`: it has no button.
struct WorkNote {
  std::shared_ptr<const Work> work;
  const char* title;  // before what is being done; may be empty
  const char* button;
  std::string tooltip;
  std::function<void()> end;
};

// Notes stand one above the other.
void draw_note(Desk& desk, const Layout& layout, const WorkNote& note, int above) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const Work& work = *note.work;
  const std::string name = note.title;
  const float wide = ui.px(420), high = ui.px(64);
  const float bottom = layout.timeline.y - ui.px(60) - static_cast<float>(above) * (high + ui.px(8));
  const Rect place = begin_note(desk, ("work " + name).c_str(),
                                {layout.free.x + 0.5F * (layout.free.width - wide), bottom - high, wide, high});
  std::string said = name.empty() ? work.what : name + ": " + work.what;
  if (!said.empty() && said[0] >= 'a' && said[0] <= 'z') said[0] = static_cast<char>(said[0] - 'a' + 'A');
  ImDrawList& draw = ui.list();
  const Rect line{place.x + ui.px(16), place.y + ui.px(8), wide - ui.px(note.end ? 132 : 32), ui.px(24)};
  draw.PushClipRect({line.x, line.y}, {line.right(), line.bottom()}, true);
  ui.text(draw, ui.fonts().small, line, t.text, said);
  draw.PopClipRect();
  const Rect bar{line.x, place.y + ui.px(40), line.width, ui.px(6)};
  ui.box(draw, bar, t.outline, 3);
  if (work.share >= 0) {
    ui.box(draw, {bar.x, bar.y, std::max(ui.px(6), bar.width * static_cast<float>(work.share)), bar.height},
           t.accent, 3);
  } else {
    // How much there is to do is not known: a part goes to and fro.
    const auto at = static_cast<float>(0.5 - 0.5 * std::cos(2.5 * work.seconds));
    ui.box(draw, {bar.x + 0.75F * bar.width * at, bar.y, 0.25F * bar.width, bar.height}, t.accent, 3);
  }
  ui.note_control(ControlKind::reading, name.empty() ? "Progress" : "Progress of the " + name,
                  work.share >= 0 ? fmt::format("{:.0f} % after {:.1f} s", 100 * work.share, work.seconds)
                                  : fmt::format("{:.1f} s so far", work.seconds),
                  "%", bar);
  if (note.end &&
      ui.text_button(note.button, {place.right() - ui.px(100), place.y + ui.px(16), ui.px(84), ui.px(32)}, "Cancel",
                     false, note.tooltip))
    note.end();
  ui.end_panel();
}

}  // namespace

void draw_work(Desk& desk, const Layout& layout) {
  Workshop& workshop = *desk.workshop;
  const std::string with_key = "Ends it; nothing of it stays  ·  " + desk.bindings.word_of(Action::cancel);
  WorkNote notes[] = {{workshop.work(), "", "Cancel work", with_key, [&] { workshop.cancel_work(); }},
                      {workshop.film_work(), "film", "Cancel film", "Ends it; nothing of it stays",
                       [&] { workshop.cancel_film(); }},
                      // It goes with the edit that it shows.
                      {workshop.preview_work(), "preview", "", "", {}}};
  if (notes[0].work && !notes[0].work->can_end) notes[0].end = {};
  int above = 0;
  for (const WorkNote& note : notes)
    if (note.work && note.work->seconds >= k_patience) draw_note(desk, layout, note, above++);
}

void draw_offer(Desk& desk, const Layout& layout) {
  const auto& unsaved = desk.now->unsaved;
  if (desk.unsaved_seen || !unsaved || unsaved->empty() || desk.dialogue != Dialogue::none) return;
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  const UnsavedWork& work = unsaved->front();
  const float wide = ui.px(520), high = ui.px(64);
  const Rect place =
      begin_note(desk, "offer",
                 {layout.free.x + 0.5F * (layout.free.width - wide), layout.menu.bottom() + ui.px(14), wide, high});
  const std::string name = work.file.empty() ? std::string("untitled") : work.file.filename().string();
  const float left = place.x + ui.px(16);
  ui.text(ui.list(), ui.fonts().small_strong, {left, place.y + ui.px(10), wide, ui.px(22)}, t.text,
          "An earlier window left work unsaved");
  ui.text(ui.list(), ui.fonts().small, {left, place.y + ui.px(32), wide, ui.px(22)}, t.quiet,
          fmt::format("{}, {} {}", name, work.changes, work.changes == 1 ? "change" : "changes"));
  if (ui.text_button("Bring back", {place.right() - ui.px(200), place.y + ui.px(16), ui.px(104), ui.px(32)},
                     "Bring back", true, "Makes it the session; it is still to be saved then")) {
    desk.unsaved_seen = true;
    desk.workshop->post([work](Bench& bench) { bench.bring_back(work); });
  }
  if (ui.text_button("Not now", {place.right() - ui.px(88), place.y + ui.px(16), ui.px(72), ui.px(32)}, "Not now",
                     false, "It stays in File, Unsaved work"))
    desk.unsaved_seen = true;
  ui.end_panel();
}

}  // namespace argil::studio
