// Of ui.h: what is pressed and what is read: buttons, tabs, switches, readings, lines of menus.

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tools/studio/ui.h"

namespace argil::studio {

void Ui::section(std::string_view title) {
  std::string capitals(title);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  y_ += px(6);
  text(list(), fonts_.small_strong, {x_, y_, width_, px(22)}, tokens_->faint, capitals);
  y_ += px(22) + px(4);
}

Ui::Row Ui::next_row() {
  const float height = px(k_row_height), value_width = std::round(0.52F * width_);
  const Row row{{x_, y_, width_ - value_width - px(6), height},
                {x_ + width_ - value_width, y_, value_width, height}};
  y_ += height + px(k_row_gap);
  return row;
}

bool Ui::icon_button(const char* name, const Rect& place, const Icon& sign, bool active, const std::string& tooltip,
                     bool enabled) {
  bool hovered = false, held = false;
  const bool pressed = press(name, place, hovered, held) && enabled;
  ImDrawList& draw = list();
  if (active)
    box(draw, place, tokens_->accent);
  else if (hovered && enabled)
    box(draw, place, held ? tokens_->well : faded(tokens_->outline, 0.75F));
  icon(draw, place,
       active     ? tokens_->on_accent
       : !enabled ? tokens_->faint
       : hovered  ? tokens_->text
                  : tokens_->quiet,
       sign);
  note_control(ControlKind::button, name, tooltip, "", place);
  return pressed;
}

bool Ui::text_button(const char* name, const Rect& place, const std::string& label, bool primary,
                     const std::string& tooltip, bool enabled) {
  bool hovered = false, held = false;
  const bool pressed = press(name, place, hovered, held) && enabled;
  ImDrawList& draw = list();
  if (primary)
    box(draw, place, held ? faded(tokens_->accent, 0.8F) : tokens_->accent);
  else
    box(draw, place, hovered && enabled ? tokens_->outline : tokens_->well);
  text(draw, primary ? fonts_.strong : fonts_.text, place,
       !enabled  ? tokens_->faint
       : primary ? tokens_->on_accent
                 : tokens_->text,
       label, Side::centre);
  note_control(ControlKind::button, name, tooltip, "", place);
  return pressed;
}

bool Ui::tab(const char* name, const Rect& place, bool active, const std::string& tooltip) {
  bool hovered = false, held = false;
  const bool pressed = press(name, place, hovered, held);
  ImDrawList& draw = list();
  text(draw, active ? fonts_.small_strong : fonts_.small, place,
       active    ? tokens_->accent
       : hovered ? tokens_->text
                 : tokens_->quiet,
       name, Side::centre);
  if (active)
    draw.AddRectFilled({place.x + px(2), place.bottom() - px(2)}, {place.right() - px(2), place.bottom()},
                       tokens_->accent, px(1));
  note_control(ControlKind::button, name, tooltip, "", place);
  return pressed;
}

bool Ui::toggle_row(const char* name, bool& on, const std::string& tooltip) {
  const Row row = next_row();
  const Rect whole{row.label.x, row.label.y, row.value.right() - row.label.x, row.label.height};
  bool hovered = false, held = false;
  const bool pressed = press(name, whole, hovered, held);
  if (pressed) on = !on;
  ImDrawList& draw = list();
  text(draw, fonts_.text, row.label, tokens_->text, name);
  const float height = px(16), width = px(28);
  const Rect track{row.value.right() - width, row.value.y + 0.5F * (row.value.height - height), width, height};
  box(draw, track, on ? tokens_->accent : hovered ? tokens_->faint : tokens_->outline, 8);
  const float knob = px(6), middle = on ? track.right() - px(8) : track.x + px(8);
  draw.AddCircleFilled({middle, track.y + 0.5F * height}, knob,
                       on               ? tokens_->on_accent
                       : tokens_->light ? IM_COL32_WHITE
                                        : tokens_->text,
                       24);
  note_control(ControlKind::toggle, name, tooltip, "", whole);
  return pressed;
}

void Ui::reading_row(const char* name, const std::string& number, const std::string& unit,
                     const std::string& tooltip) {
  const Row row = next_row();
  ImDrawList& draw = list();
  text(draw, fonts_.text, row.label, tokens_->text, name);
  box(draw, row.value, tokens_->well);
  const float margin = px(10);
  const float unit_width = unit.empty() ? 0 : width_of(fonts_.text, unit) + px(5);
  const Rect inner{row.value.x + margin, row.value.y, row.value.width - 2 * margin, row.value.height};
  text(draw, fonts_.text, inner, tokens_->quiet, unit, Side::right);
  text(draw, fonts_.text, {inner.x, inner.y, inner.width - unit_width, inner.height}, tokens_->text, number,
       Side::right);
  note_control(ControlKind::reading, name, tooltip, unit, {row.label.x, row.label.y, width_, row.label.height});
}

void Ui::note(const std::string& line) {
  ImFont* font = fonts_.small;
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, FLT_MAX, width_, line.c_str());
  list().AddText(font, font->FontSize, {std::round(x_), std::round(y_)}, tokens_->quiet, line.c_str(), nullptr,
                 width_);
  y_ += size.y + px(k_row_gap);
}

bool Ui::list_row(const std::string& name, const std::string& shortcut, bool marked, bool chosen,
                  const std::string& tooltip, bool enabled) {
  const Rect place{x_, y_, width_, px(28)};
  y_ += px(28);
  bool hovered = false, held = false;
  const bool pressed = press(name.c_str(), place, hovered, held) && enabled;
  ImDrawList& draw = list();
  if (enabled && (hovered || chosen))
    box(draw, place, chosen ? faded(tokens_->accent, 0.22F) : tokens_->outline, 4);
  const float left = px(28), margin = px(12);
  if (marked) icon(draw, {place.x, place.y, left, place.height}, tokens_->accent, icons::check, true);
  const float room =
      place.width - left - margin - (shortcut.empty() ? 0 : width_of(fonts_.small, shortcut) + px(10));
  text(draw, fonts_.text, {place.x + left, place.y, room, place.height}, enabled ? tokens_->text : tokens_->faint,
       fitted(fonts_.text, name, room));
  text(draw, fonts_.small, {place.x, place.y, place.width - margin, place.height}, tokens_->faint, shortcut,
       Side::right);
  note_control(ControlKind::button, name, tooltip, "", place);
  return pressed;
}

}  // namespace argil::studio
