#include "tools/studio/file_dialogues.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "tools/studio/sheet.h"

namespace argil::studio {

namespace {

namespace fs = std::filesystem;

/// What the list beneath the field holds: names beneath what is typed, or files that were used lately.
struct Choice {
  std::string name, right;
  fs::path file;
  bool opens = false;  // at once
};

std::vector<Choice> choices(const Desk& desk) {
  std::vector<Choice> all;
  if (desk.typed.empty() && desk.now->recent)
    for (const fs::path& file : *desk.now->recent) {
      if (all.size() == 6) break;
      all.push_back({file.filename().string(), file.parent_path().string(), file, true});
    }
  if (desk.now->listing && desk.now->listing->typed == desk.typed)
    for (const std::string& name : desk.now->listing->names) {
      const fs::path& folder = desk.now->listing->folder;
      all.push_back({name, "", folder == "." ? fs::path(name) : folder / name});
    }
  return all;
}

void finish(Desk& desk, fs::path file, bool saves) {
  if (saves && file.extension() != ".argil") file += ".argil";
  desk.dialogue = Dialogue::none;
  desk.folder = file.has_parent_path() ? file.parent_path() : ".";
  desk.workshop->post([file, saves](Bench& bench) { saves ? bench.save(file) : bench.open(file); });
}

/// Whether a session that is saved as `typed` would take the place of another file, as far as the disk was asked.
bool would_replace(const Desk& desk) {
  if (!desk.now->listing || desk.now->listing->typed != desk.typed) return false;
  std::string name = fs::path(desk.typed).filename().string();
  if (!name.ends_with(".argil")) name += ".argil";
  const auto& names = desk.now->listing->names;
  const bool is_there = std::find(names.begin(), names.end(), name) != names.end();
  return is_there && desk.now->listing->folder / name != fs::path(desk.now->file);
}

/// As many of its last folders as have room.
std::string end_of_path(const Ui& ui, const fs::path& path, float width) {
  std::string text = path.string();
  while (ui.width_of(ui.fonts().small, text) > width) {
    const std::size_t slash = text.find('/', text.starts_with("…") ? std::string("…/").size() : 1);
    if (slash == text.npos) return ui.fitted(ui.fonts().small, text, width);
    text = "…" + text.substr(slash);
  }
  return text;
}

void draw_title(Desk& desk, const Rect& place, const char* title, const std::string& note) {
  Ui& ui = *desk.ui;
  const Rect line{place.x + ui.px(20), place.y + ui.px(10), place.width - ui.px(40), ui.px(28)};
  ui.text(ui.list(), ui.fonts().strong, line, ui.tokens().text, title);
  ui.text(ui.list(), ui.fonts().small, line, ui.tokens().faint, note, Side::right);
}

}  // namespace

void draw_file(Desk& desk, bool saves, int width, int height) {
  Ui& ui = *desk.ui;
  if (desk.listed != desk.typed || desk.dialogue != desk.shown_dialogue) {
    desk.listed = desk.typed;
    desk.workshop->post([typed = desk.typed](Bench& bench) { bench.filing().list(typed); });
  }
  const std::vector<Choice> shown = saves ? std::vector<Choice>{} : choices(desk);
  const float wide = ui.px(560), field = ui.px(48), row = ui.px(28);
  const float high = ui.px(44) + field + row * static_cast<float>(shown.size()) + ui.px(62);
  const Rect place{0.5F * (static_cast<float>(width) - wide), ui.px(90), wide, high};
  open_sheet(desk, "file", place, width, height);
  draw_title(desk, place, saves ? "Save the session" : "Open a session or a mesh",
             desk.now->listing ? end_of_path(ui, desk.now->listing->whole, wide - ui.px(230)) : "");
  const Rect box{place.x + ui.px(16), place.y + ui.px(46), wide - ui.px(32), ui.px(36)};
  ui.box(ui.list(), box, ui.tokens().well);
  ui.frame(ui.list(), box, ui.tokens().accent);
  bool entered = false;
  const bool focus = desk.dialogue != desk.shown_dialogue || std::exchange(desk.retake_focus, false);
  ui.text_field("File", {box.x + ui.px(4), box.y, box.width - ui.px(8), box.height}, desk.typed,
                saves ? "name.argil" : "a folder, .argil, or a volume mesh", focus, entered,
                saves ? "Where the session is written" : "What is opened");
  ui.set_cursor(place.x + ui.px(16), box.bottom() + ui.px(6), wide - ui.px(32));
  for (const Choice& choice : shown)
    if (ui.list_row(choice.name, choice.right, false, false, choice.opens ? "Opens it again" : "Takes this file")) {
      if (choice.opens) {
        finish(desk, choice.file, false);
      } else {
        desk.typed = choice.file.string();
        desk.retake_focus = true;
      }
    }
  const float y = place.bottom() - ui.px(48);
  const bool replaces = saves && would_replace(desk);
  if (replaces) {
    ui.text(ui.list(), ui.fonts().small_strong, {place.x + ui.px(20), y, wide, ui.px(32)}, ui.tokens().warning,
            "There is another file of this name");
    ui.note_control(ControlKind::reading, "Would replace", "Saving puts the session in its place", "",
                    {place.x + ui.px(20), y, ui.px(280), ui.px(32)});
  }
  const bool done =
      ui.text_button(saves ? "Save now" : "Open now", {place.right() - ui.px(116), y, ui.px(100), ui.px(32)},
                     replaces ? "Replace"
                     : saves  ? "Save"
                              : "Open",
                     true,
                     replaces ? "Writes the session in the place of the file that is there"
                     : saves  ? "Writes the session"
                              : "Opens the file");
  if (ui.text_button("Leave", {place.right() - ui.px(224), y, ui.px(100), ui.px(32)}, "Cancel", false,
                     "Leaves all as it is"))
    desk.dialogue = Dialogue::none;
  if ((done || entered) && !desk.typed.empty()) finish(desk, desk.typed, saves);
  ui.end_panel();
}

void draw_samples(Desk& desk, int width, int height) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  if (!desk.now->samples) desk.workshop->post([](Bench& bench) { bench.filing().look_for_samples(); });
  static const std::vector<Sample> k_none;
  const std::vector<Sample>& samples = desk.now->samples ? *desk.now->samples : k_none;
  // As many columns as fit, in cards of the pictures' shape.
  const float gap = ui.px(12), caption = ui.px(26);
  const auto count = static_cast<int>(std::max<std::size_t>(1, samples.size()));
  int columns = std::clamp(static_cast<int>((static_cast<float>(width) - ui.px(80)) / ui.px(188)), 3, 5);
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  const float room = static_cast<float>(height) - ui.px(140);
  const float card_height = std::min(ui.px(132), room / static_cast<float>(rows) - gap - caption);
  const float card_width = card_height * k_sample_width / k_sample_height;
  const float wide = std::max(ui.px(420), static_cast<float>(columns) * (card_width + gap) + gap + ui.px(16));
  const float high = ui.px(48) + static_cast<float>(rows) * (card_height + caption + gap) + gap;
  const Rect place{0.5F * (static_cast<float>(width) - wide), 0.5F * (static_cast<float>(height) - high), wide,
                   high};
  open_sheet(desk, "samples", place, width, height);
  draw_title(desk, place, "Samples", "a sample opens as a new session");
  if (desk.now->samples && samples.empty()) {
    ui.set_cursor(place.x + ui.px(20), place.y + ui.px(60), wide - ui.px(40));
    ui.note("The folder of samples is not there. It comes with the sources of Argil.");
  }
  ImDrawList& draw = ui.list();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto column = static_cast<float>(i % static_cast<std::size_t>(columns)),
               row = static_cast<float>(i / static_cast<std::size_t>(columns));
    const Rect card{place.x + ui.px(8) + gap + column * (card_width + gap),
                    place.y + ui.px(48) + row * (card_height + caption + gap), card_width, card_height};
    ImGui::SetCursorScreenPos({card.x, card.y});
    ImGui::PushID(static_cast<int>(i));
    const bool pressed = ImGui::InvisibleButton("##sample", {card.width, card.height + caption});
    const bool hovered = ImGui::IsItemHovered();
    ImGui::PopID();
    ui.box(draw, card, t.well);
    if (i < desk.sample_pictures.size())
      draw.AddImageRounded(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(desk.sample_pictures[i])),
                           {card.x, card.y}, {card.right(), card.bottom()}, {0, 0}, {1, 1}, 0xFFFFFFFFU,
                           ui.px(k_corner));
    if (hovered) ui.frame(draw, card, t.accent);
    ui.text(draw, ui.fonts().small, {card.x, card.bottom(), card.width, caption}, hovered ? t.text : t.quiet,
            samples[i].title, Side::centre);
    ui.note_control(ControlKind::button, samples[i].title, "Opens this sample as a new session", "",
                    {card.x, card.y, card.width, card.height + caption});
    if (pressed) {
      desk.dialogue = Dialogue::none;
      desk.workshop->post([file = samples[i].file](Bench& bench) { bench.open_sample(file); });
    }
  }
  ui.end_panel();
}

void draw_unsaved(Desk& desk, int width, int height) {
  Ui& ui = *desk.ui;
  const std::vector<UnsavedWork>& all = *desk.now->unsaved;
  const float wide = ui.px(560), row = ui.px(36);
  const std::size_t count = std::min<std::size_t>(all.size(), 8);
  const Rect place{0.5F * (static_cast<float>(width) - wide), ui.px(110), wide,
                   ui.px(60) + row * static_cast<float>(std::max<std::size_t>(1, count)) + ui.px(12)};
  open_sheet(desk, "unsaved", place, width, height);
  draw_title(desk, place, "Work that was not saved", "the latest first");
  if (all.empty()) {
    ui.set_cursor(place.x + ui.px(20), place.y + ui.px(56), wide - ui.px(40));
    ui.note("All that was done in earlier windows is saved.");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const UnsavedWork& work = all[i];
    const float y = place.y + ui.px(54) + row * static_cast<float>(i);
    const std::string name = work.file.empty() ? std::string("untitled") : work.file.filename().string();
    ui.text(ui.list(), ui.fonts().text, {place.x + ui.px(20), y, ui.px(200), ui.px(30)}, ui.tokens().text, name);
    ui.text(ui.list(), ui.fonts().small, {place.x + ui.px(220), y, ui.px(110), ui.px(30)}, ui.tokens().quiet,
            fmt::format("{} changes", work.changes));
    const std::string number = fmt::format(" {}", i + 1);
    if (ui.text_button(("Bring back" + number).c_str(), {place.right() - ui.px(226), y, ui.px(104), ui.px(30)},
                       "Bring back", true, "Makes it the session; it is still to be saved then")) {
      desk.dialogue = Dialogue::none;
      desk.workshop->post([work](Bench& bench) { bench.bring_back(work); });
    }
    if (ui.text_button(("Throw away" + number).c_str(), {place.right() - ui.px(114), y, ui.px(98), ui.px(30)},
                       "Throw away", false, "Removes it for good"))
      desk.workshop->post([work](Bench& bench) { bench.filing().forget(work); });
  }
  ui.end_panel();
}

}  // namespace argil::studio
