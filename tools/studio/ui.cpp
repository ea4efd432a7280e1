#include "tools/studio/ui.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace argil::studio {

namespace {

ImVec2 low(const Rect& r) {
  return {r.x, r.y};
}
ImVec2 high(const Rect& r) {
  return {r.right(), r.bottom()};
}

}  // namespace

const Control* Ui::find(std::string_view name) const {
  const auto found = std::find_if(controls_.begin(), controls_.end(),
                                  [&](const Control& control) { return control.name == name; });
  return found == controls_.end() ? nullptr : &*found;
}

ImDrawList& Ui::list() const {
  return *ImGui::GetWindowDrawList();
}

float Ui::width_of(ImFont* font, std::string_view line) const {
  return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, line.data(), line.data() + line.size()).x;
}

std::string Ui::fitted(ImFont* font, std::string_view line, float width) const {
  const char* const end = line.data() + line.size();
  const char* cut = end;
  font->CalcTextSizeA(font->FontSize, width, 0, line.data(), end, &cut);
  if (cut == end) return std::string(line);
  cut = line.data();
  font->CalcTextSizeA(font->FontSize, std::max(0.0F, width - width_of(font, "…")), 0, line.data(), end, &cut);
  return std::string(line.data(), cut) + "…";
}

void Ui::text(ImDrawList& draw, ImFont* font, const Rect& place, Ink colour, std::string_view line,
              Side side) const {
  const float width = width_of(font, line);
  float x = place.x;
  if (side == Side::centre) x += 0.5F * (place.width - width);
  if (side == Side::right) x += place.width - width;
  const float y = place.y + 0.5F * (place.height - font->FontSize);
  draw.AddText(font, font->FontSize, {std::round(x), std::round(y)}, colour, line.data(),
               line.data() + line.size());
}

void Ui::icon(ImDrawList& draw, const Rect& place, Ink colour, const Icon& sign, bool small) const {
  ImFont* font = small ? fonts_.small_icons : fonts_.icons;
  if (font == nullptr)
    text(draw, fonts_.strong, place, colour, sign.letter, Side::centre);
  else
    text(draw, font, place, colour, sign.sign, Side::centre);
}

void Ui::box(ImDrawList& draw, const Rect& place, Ink colour, float corner) const {
  draw.AddRectFilled(low(place), high(place), colour, px(corner));
}

void Ui::frame(ImDrawList& draw, const Rect& place, Ink colour, float corner) const {
  draw.AddRect(low(place), high(place), colour, px(corner), 0, std::max(1.0F, std::round(scale_)));
}

void Ui::shadow(ImDrawList& draw, const Rect& place, float corner) const {
  for (int i = 8; i > 0; --i) {
    const float grow = px(static_cast<float>(i) * 1.5F);
    draw.AddRectFilled({place.x - grow, place.y - grow + px(3)},
                       {place.right() + grow, place.bottom() + grow + px(3)},
                       IM_COL32(0, 0, 0, tokens_->light ? 4 : 9), px(corner) + grow);
  }
}

void Ui::note_control(ControlKind kind, std::string_view name, const std::string& tooltip, const std::string& unit,
                      const Rect& place) {
  controls_.push_back({kind, std::string(name), tooltip, unit, place});
}

bool Ui::press(const char* name, const Rect& place, bool& hovered, bool& held) {
  ImGui::SetCursorScreenPos(low(place));
  ImGui::PushID(name);
  const bool pressed =
      ImGui::InvisibleButton("##press", {std::max(1.0F, place.width), std::max(1.0F, place.height)});
  hovered = ImGui::IsItemHovered();
  held = ImGui::IsItemActive();
  ImGui::PopID();
  return pressed;
}

void Ui::end_frame() {
  const ImGuiIO& io = ImGui::GetIO();
  const Control* under = nullptr;
  const bool in_menu = popup_[1] > popup_[0];
  if (io.WantCaptureMouse && !ImGui::IsMouseDown(0))
    for (std::size_t i = in_menu ? popup_[0] : front_; i < (in_menu ? popup_[1] : controls_.size()); ++i)
      if (controls_[i].place.contains(io.MousePos.x, io.MousePos.y)) under = &controls_[i];
  if (under == nullptr || under->name != rest_on_) {
    rest_on_ = under != nullptr ? under->name : "";
    rested_ = 0;
    return;
  }
  rested_ += io.DeltaTime;
  if (rested_ < 0.45 || under->tooltip.empty()) return;
  draw_tip(under->place, under->tooltip, tokens_->text);
}

void Ui::draw_tip(const Rect& of, const std::string& words, Ink colour) const {
  const ImGuiIO& io = ImGui::GetIO();
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  const float most = px(300), margin = px(10);
  const ImVec2 size = fonts_.small->CalcTextSizeA(fonts_.small->FontSize, FLT_MAX, most, words.c_str());
  Rect place{of.x, of.bottom() + px(6), size.x + 2 * margin, size.y + 1.4F * margin};
  // Beside what is narrow and at a side, else below; within the window in any case.
  if (of.x < px(80)) place.x = of.right() + px(10), place.y = of.y;
  place.x = std::clamp(place.x, px(4), std::max(px(4), io.DisplaySize.x - place.width - px(6)));
  if (place.bottom() > io.DisplaySize.y - px(6)) place.y = of.y - place.height - px(6);
  shadow(draw, place, 4);
  box(draw, place, tokens_->raised, 4);
  frame(draw, place, tokens_->outline, 4);
  draw.AddText(fonts_.small, fonts_.small->FontSize, {place.x + margin, place.y + 0.7F * margin}, colour,
               words.c_str(), nullptr, most);
}

void Ui::begin_panel(const char* name, const Rect& place, Ink fill, float corner, bool scrolls) {
  ImGui::SetNextWindowPos(low(place));
  ImGui::SetNextWindowSize({place.width, place.height});
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                           ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                           ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav |
                           ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBackground;
  if (!scrolls) flags |= ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  ImGui::Begin(name, nullptr, flags);
  ImDrawList& draw = list();
  if ((fill >> 24U) != 0) draw.AddRectFilled(low(place), high(place), fill, px(corner));
  x_ = place.x;
  y_ = place.y - ImGui::GetScrollY();
  width_ = place.width;
}

void Ui::end_panel() {
  ImGui::SetCursorScreenPos({x_, y_});
  ImGui::Dummy({1, 1});
  ImGui::End();
}

bool Ui::begin_popup(const char* name, const Rect& place) {
  ImGui::SetNextWindowPos(low(place));
  ImGui::SetNextWindowSize({place.width, place.height});
  if (!ImGui::BeginPopup(name, ImGuiWindowFlags_NoMove)) return false;
  ImDrawList& draw = list();
  draw.PushClipRectFullScreen();
  shadow(draw, place, k_corner);
  draw.PopClipRect();
  box(draw, place, tokens_->raised);
  frame(draw, place, tokens_->outline);
  popup_ = {controls_.size(), controls_.size()};
  return true;
}

void Ui::end_popup() {
  popup_[1] = controls_.size();
  ImGui::EndPopup();
}

void Ui::set_cursor(float x, float y, float width) {
  x_ = x;
  y_ = y;
  width_ = width;
}

}  // namespace argil::studio
