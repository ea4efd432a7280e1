// Of panels.h: what is shown, and what was done.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "sculpt/shown_fields.h"
#include "tools/studio/panels.h"

namespace argil::studio {

namespace {

std::string spaced(std::string word) {
  std::replace(word.begin(), word.end(), '_', ' ');
  if (!word.empty()) word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
  return word;
}

constexpr std::size_t k_readable = 160;  // characters of a line that may show at all

/// Numbers with as many digits as a hand meant.
std::string readable(const std::string& words) {
  std::string result;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    double number = 0;
    const auto read = std::from_chars(words.data() + at, words.data() + end, number);
    if (end > at + 6 && read.ec == std::errc{} && read.ptr == words.data() + end)
      result += fmt::format("{:.3g}", number);
    else
      result.append(words, at, end - at);
    if (end < words.size()) result += ' ';
    at = end + 1;
  }
  return result;
}

}  // namespace

void draw_fields_panel(Desk& desk, const Perform& perform) {
  Ui& ui = *desk.ui;
  Settings& s = desk.settings;
  ui.section("Colours");
  static const std::vector<std::string> words = [] {
    std::vector<std::string> all{""};
    for (const std::string& name : sculpt::shown_field_names())
      if (name != "error") all.push_back(name);
    return all;
  }();
  static const std::vector<std::string> labels = [] {
    std::vector<std::string> all;
    for (const std::string& name : words) all.push_back(name.empty() ? "clay" : spaced(name));
    return all;
  }();
  std::size_t field = std::min(
      static_cast<std::size_t>(std::find(words.begin(), words.end(), s.field) - words.begin()), words.size() - 1);
  if (ui.choice_row("Field", labels, field, desk.tooltip(Action::next_field))) {
    s.field = words[field];
    s.fixed_range = false;
    desk.show();
  }
  if (!s.field.empty() && desk.now->scene && desk.now->scene->legend) {
    const sculpt::SceneLegend& legend = *desk.now->scene->legend;
    const double factor = legend.unit == "%" ? 100 : 1;
    if (!s.fixed_range) {
      s.range_low = legend.low;
      s.range_high = legend.high;
    }
    if (ui.toggle_row("Fixed range", s.fixed_range, "Keeps the range of the colours as it is now")) desk.show();
    if (s.fixed_range) {
      double low = factor * s.range_low, high = factor * s.range_high;
      const NumberStyle style{
          .unit = legend.unit, .tooltip = "Of the colours", .low = -1e15, .high = 1e15, .reset = 0, .bar = false};
      if (ui.number_row("From", low, style) && low < high) {
        s.range_low = low / factor;
        desk.show();
      }
      if (ui.number_row("To", high, style) && low < high) {
        s.range_high = high / factor;
        desk.show();
      }
    }
  }
  ui.section("Lines");
  ui.toggle_row("Wires of cells", s.wireframe, desk.tooltip(Action::wireframe));
  if (ui.toggle_row("Finest cells", s.finest_wires,
                    "Wires of the refined cells too, not only of the control cells"))
    desk.show();
  if (ui.toggle_row("Control cage", s.cage, desk.tooltip(Action::cage))) desk.show();
  ui.section("Cut away");
  bool cut = s.cut;
  if (ui.toggle_row("Cut", cut, desk.tooltip(Action::cut_away))) perform(Action::cut_away);
  if (desk.now->scene && desk.now->layers > 0) {
    double peel = s.peel;
    if (ui.number_row(
            "Peel", peel,
            {.unit = "layers",
             .tooltip = "Of cells, taken away from the boundary inwards  ·  " + desk.bindings.word_of(Action::peel),
             .low = 0,
             .high = static_cast<double>(desk.now->layers),
             .reset = 0})) {
      s.peel = static_cast<int>(std::lround(peel));
      desk.show();
    }
  }
  if (s.cut) {
    double at[3] = {s.cut_point.x(), s.cut_point.y(), s.cut_point.z()};
    double normal[3] = {s.cut_normal.x(), s.cut_normal.y(), s.cut_normal.z()};
    if (ui.vector_row("Through", at, {.unit = "m", .tooltip = "A point of the plane", .low = -1e9, .high = 1e9})) {
      s.cut_point = Eigen::Vector3d(at[0], at[1], at[2]);
      desk.show();
    }
    if (ui.vector_row("Normal", normal,
                      {.unit = "", .tooltip = "Towards what is taken away", .low = -1, .high = 1})) {
      const Eigen::Vector3d turned(normal[0], normal[1], normal[2]);
      if (turned.norm() > 1e-6) s.cut_normal = turned.normalized();
      desk.show();
    }
  }
}

void draw_history_panel(Desk& desk, const Perform& perform, float x, float width) {
  Ui& ui = *desk.ui;
  const Tokens& t = ui.tokens();
  ui.section("What was done");
  const float half = 0.5F * (width - ui.px(8)), y = ui.cursor_y();
  if (ui.text_button("Undo", {x, y, half, ui.px(28)}, "Undo", false, desk.tooltip(Action::undo),
                     desk.now->undo_depth > 0))
    perform(Action::undo);
  if (ui.text_button("Redo", {x + half + ui.px(8), y, half, ui.px(28)}, "Redo", false, desk.tooltip(Action::redo),
                     desk.now->redo_depth > 0))
    perform(Action::redo);
  ui.skip(38);
  const auto& entries = *desk.now->history;
  if (entries.empty()) {
    ui.note("Every stroke and command will be listed here. Together they are the session that is saved.");
    return;
  }
  ImDrawList& draw = ui.list();
  const float top = ImGui::GetWindowPos().y, bottom = top + ImGui::GetWindowHeight();
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const HistoryEntry& entry = entries[entries.size() - 1 - k];
    const Rect row{x, ui.cursor_y(), width, ui.px(26)};
    ui.skip(26);
    if (row.bottom() < top || row.y > bottom) continue;  // scrolled away
    const bool present = !entry.undone && (k == 0 || entries[entries.size() - k].undone);
    if (present)
      draw.AddRectFilled({row.x - ui.px(6), row.y + ui.px(6)}, {row.x - ui.px(3), row.bottom() - ui.px(6)},
                         t.accent, ui.px(1));
    const std::size_t blank = std::min(entry.line.find(' '), entry.line.size());
    const std::string name = entry.line.substr(0, blank), rest = readable(entry.line.substr(blank, k_readable));
    const std::string times = entry.times > 1 ? fmt::format("×{}", entry.times) : "";
    ui.text(draw, ui.fonts().small_strong, row, entry.undone ? t.faint : t.text, name);
    const float shift = ui.width_of(ui.fonts().small_strong, name),
                room = width - shift - (times.empty() ? 0 : ui.px(36));
    ui.text(draw, ui.fonts().small, {row.x + shift, row.y, room, row.height},
            entry.undone ? faded(t.faint, 0.7F) : t.quiet, ui.fitted(ui.fonts().small, rest, room));
    ui.text(draw, ui.fonts().small, row, t.faint, times, Side::right);
    ui.note_control(ControlKind::reading, fmt::format("History {}", k),
                    ui.fitted(ui.fonts().small, entry.line, ui.px(1500)), "", row);
  }
}

}  // namespace argil::studio
