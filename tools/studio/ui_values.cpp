// Of ui.h: what values are typed, dragged and chosen in.

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "subdiv/error.h"
#include "tools/studio/quantity.h"
#include "tools/studio/ui.h"

namespace argil::studio {

namespace {

constexpr int k_focus_frames = 4;  // Dear ImGui gives the keyboard a frame or two after it is asked to

/// Where a value lies in its range, 0 … 1.
double share_of(double value, const NumberStyle& style) {
  if (!(style.high > style.low)) return 0;
  const double share = style.logarithmic && style.low > 0
                           ? std::log(std::max(value, style.low) / style.low) / std::log(style.high / style.low)
                           : (value - style.low) / (style.high - style.low);
  return std::clamp(share, 0.0, 1.0);
}

double value_at(double share, const NumberStyle& style) {
  share = std::clamp(share, 0.0, 1.0);
  if (style.logarithmic && style.low > 0) return style.low * std::pow(style.high / style.low, share);
  return style.low + share * (style.high - style.low);
}

/// Three digits: what is dragged should read like what is typed.
double rounded(double value) {
  if (value == 0) return 0;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  return std::round(value / step) * step;
}

}  // namespace

bool Ui::number_box(const char* name, const Rect& place, double& value, const NumberStyle& style,
                    const std::function<void(double)>& preview) {
  ImDrawList& draw = list();
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::PushID(name);
  const unsigned id = ImGui::GetID("number");
  bool changed = false;
  const float margin = px(10);
  if (editing_ == id) {
    box(draw, place, tokens_->well);
    frame(draw, place, edit_failed_ ? tokens_->warning : tokens_->accent);
    const float height = ImGui::GetFontSize() + 2 * px(5);
    ImGui::SetCursorScreenPos({place.x, place.y + 0.5F * (place.height - height)});
    ImGui::PushItemWidth(place.width);
    if (editing_waits_ == k_focus_frames) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##text", edited_, sizeof edited_,
                                          ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PopItemWidth();
    const bool twice = ImGui::GetTime() - editing_since_ < io.MouseDoubleClickTime && ImGui::IsMouseClicked(0) &&
                       place.contains(io.MousePos.x, io.MousePos.y);
    if (ImGui::IsItemActive()) editing_waits_ = 0;
    const bool left = editing_waits_ == 0 && !ImGui::IsItemActive();
    editing_waits_ = std::max(0, editing_waits_ - 1);
    if (twice) {
      value = style.reset;
      changed = true;
      editing_ = 0;
    } else if (entered || (left && !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))) {
      try {
        const double typed = parse_quantity(edited_, style.unit, shown(value, style.unit).unit);
        if (typed < style.low || typed > style.high) {
          const Quantity from = shown(style.low, style.unit), to = shown(style.high, style.unit);
          throw Error(ErrorCode::bad_input, "expected " + from.number + ' ' + from.unit + " to " + to.number + ' ' +
                                                to.unit + ", found " + std::string(edited_));
        }
        changed = typed != value;
        value = typed;
        editing_ = 0;
      } catch (const Error& error) {
        edit_failed_ = true;
        edit_error_ = error.what();
        // It stays, with what is wrong, until it is mended or left.
        if (entered)
          editing_waits_ = k_focus_frames;
        else
          editing_ = 0;
      }
    } else if (left) {
      editing_ = 0;
    }
    ImGui::PopID();
    const bool fails = editing_ == id && edit_failed_;
    if (fails) draw_tip(place, edit_error_, tokens_->warning);
    note_control(ControlKind::number, name, fails ? "" : style.tooltip, style.unit, place);
    return changed;
  }

  ImGui::SetCursorScreenPos({place.x, place.y});
  ImGui::InvisibleButton("##drag", {place.width, place.height});
  const bool hovered = ImGui::IsItemHovered();
  if (hovered || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActivated()) {
    drag_start_ = value;
    dragging_ = 0;
  }
  double now = value;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, px(3))) {
    dragging_ = id;
    const double way = ImGui::GetMouseDragDelta(0, 0).x / place.width * (io.KeyShift ? 0.1 : 1.0);
    now = std::clamp(rounded(value_at(share_of(drag_start_, style) + way, style)), style.low, style.high);
    if (preview) preview(now);
  }
  if (ImGui::IsItemDeactivated()) {
    if (dragging_ == id) {
      const double way = (io.MousePos.x - io.MouseClickedPos[0].x) / place.width * (io.KeyShift ? 0.1 : 1.0);
      now = std::clamp(rounded(value_at(share_of(drag_start_, style) + way, style)), style.low, style.high);
      changed = now != value;
      value = now;
      dragging_ = 0;
    } else if (hovered) {
      editing_ = id;
      editing_waits_ = k_focus_frames;
      edit_failed_ = false;
      editing_since_ = ImGui::GetTime();
      std::strncpy(edited_, editable(value, style.unit).c_str(), sizeof edited_ - 1);
    }
  }
  ImGui::PopID();

  box(draw, place, hovered || dragging_ == id ? tokens_->well_hovered : tokens_->well);
  if (style.bar) {
    const auto share = static_cast<float>(share_of(now, style));
    if (share > 0) {
      draw.PushClipRect({place.x, place.y}, {place.x + share * place.width, place.bottom()}, true);
      box(draw, place, dragging_ == id ? faded(tokens_->accent, 0.35F) : tokens_->fill);
      draw.PopClipRect();
    }
  }
  const Quantity words = shown(now, style.unit);
  const float unit_width = words.unit.empty() ? 0 : width_of(fonts_.text, words.unit) + px(5);
  const Rect inner{place.x + margin, place.y, place.width - 2 * margin, place.height};
  text(draw, fonts_.text, inner, tokens_->quiet, words.unit, Side::right);
  text(draw, fonts_.text, {inner.x, inner.y, inner.width - unit_width, inner.height}, tokens_->text, words.number,
       Side::right);
  note_control(ControlKind::number, name, style.tooltip, style.unit, place);
  return changed;
}

bool Ui::number_row(const char* name, double& value, const NumberStyle& style,
                    const std::function<void(double)>& preview) {
  const Row row = next_row();
  text(list(), fonts_.text, row.label, tokens_->text, name);
  return number_box(name, row.value, value, style, preview);
}

bool Ui::vector_row(const char* name, double (&values)[3], const NumberStyle& style) {
  text(list(), fonts_.text, {x_, y_, width_, px(k_row_height)}, tokens_->text, name);
  text(list(), fonts_.text, {x_, y_, width_, px(k_row_height)}, tokens_->quiet, style.unit, Side::right);
  y_ += px(k_row_height);
  const float gap = px(6), width = (width_ - 2 * gap) / 3;
  bool changed = false;
  static constexpr const char* k_axes[] = {" x", " y", " z"};
  for (int i = 0; i < 3; ++i) {
    NumberStyle one = style;
    one.bar = false;
    const std::string axis = std::string(name) + k_axes[i];
    const Rect place{x_ + static_cast<float>(i) * (width + gap), y_, width, px(k_row_height)};
    if (number_box(axis.c_str(), place, values[i], one, {})) changed = true;
  }
  y_ += px(k_row_height) + px(k_row_gap);
  return changed;
}

bool Ui::choice_row(const char* name, std::span<const std::string> options, std::size_t& chosen,
                    const std::string& tooltip) {
  const Row row = next_row();
  ImDrawList& draw = list();
  text(draw, fonts_.text, row.label, tokens_->text, name);
  bool hovered = false, held = false;
  const bool pressed = press(name, row.value, hovered, held);
  box(draw, row.value, hovered ? tokens_->well_hovered : tokens_->well);
  const float margin = px(10);
  const Rect sign{row.value.right() - px(22), row.value.y, px(16), row.value.height};
  icon(draw, sign, tokens_->faint, icons::caret, true);
  draw.PushClipRect({row.value.x + px(4), row.value.y}, {sign.x, row.value.bottom()}, true);
  text(draw, fonts_.text,
       {row.value.x + margin, row.value.y, sign.x - row.value.x - margin - px(4), row.value.height}, tokens_->text,
       chosen < options.size() ? options[chosen] : "", Side::right);
  draw.PopClipRect();
  note_control(ControlKind::choice, name, tooltip, "", {row.label.x, row.label.y, width_, row.label.height});

  ImGui::PushID(name);
  if (pressed) ImGui::OpenPopup("options");
  bool changed = false;
  const float height = px(28) * static_cast<float>(std::min<std::size_t>(options.size(), 14)) + px(12);
  float top = row.value.bottom() + px(2);
  if (top + height > ImGui::GetIO().DisplaySize.y) top = std::max(px(4), row.value.y - height - px(2));
  float widest = row.value.width;
  for (const std::string& option : options) widest = std::max(widest, width_of(fonts_.text, option) + px(48));
  const Rect place{row.value.right() - widest, top, widest, height};
  if (begin_popup("options", place)) {
    const float x = x_, y = y_, width = width_;
    set_cursor(place.x + px(4), place.y + px(6) - ImGui::GetScrollY(), place.width - px(8));
    for (std::size_t i = 0; i < options.size(); ++i)
      if (list_row(options[i], "", i == chosen, false, tooltip)) {
        changed = i != chosen;
        chosen = i;
        ImGui::CloseCurrentPopup();
      }
    set_cursor(x, y, width);
    end_popup();
  }
  ImGui::PopID();
  return changed;
}

bool Ui::choice_row(const char* name, std::span<const std::string> options, std::string& chosen,
                    const std::string& tooltip) {
  auto at = static_cast<std::size_t>(std::find(options.begin(), options.end(), chosen) - options.begin());
  if (!choice_row(name, options, at, tooltip)) return false;
  chosen = options[at];
  return true;
}

bool Ui::text_field(const char* name, const Rect& place, std::string& line, const char* hint, bool take_focus,
                    bool& entered, const std::string& tooltip) {
  ImGui::PushID(name);
  std::vector<char> buffer(std::max<std::size_t>(line.size() + 1, 1024), '\0');
  std::copy(line.begin(), line.end(), buffer.begin());
  const float height = ImGui::GetFontSize() + 2 * px(5);
  ImGui::SetCursorScreenPos({place.x, place.y + 0.5F * (place.height - height)});
  ImGui::PushItemWidth(place.width);
  // What is there already is gone on with, not written over: the caret goes to its end with the focus.
  int* const caret_frames = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("##caret"), 0);
  if (take_focus) {
    ImGui::SetKeyboardFocusHere();
    *caret_frames = 2;
  }
  const auto to_end = [](ImGuiInputTextCallbackData* text) {
    int& frames = *static_cast<int*>(text->UserData);
    if (frames > 0) {
      --frames;
      text->CursorPos = text->BufTextLen;
      text->ClearSelection();
    }
    return 0;
  };
  entered = ImGui::InputTextWithHint("##text", hint, buffer.data(), buffer.size(),
                                     ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackAlways,
                                     to_end, caret_frames);
  ImGui::PopItemWidth();
  ImGui::PopID();
  note_control(ControlKind::text, name, tooltip, "", place);
  const bool changed = line != buffer.data();
  line = buffer.data();
  return changed;
}

}  // namespace argil::studio
