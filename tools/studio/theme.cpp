#include "tools/studio/theme.h"

#include <imgui.h>

#include <algorithm>

namespace argil::studio {

namespace {

constexpr Ink rgb(std::uint32_t value, std::uint32_t alpha = 255) {
  return (value >> 16U & 255U) | (value & 0xff00U) | (value & 255U) << 16U | alpha << 24U;
}

ImVec4 vector_of(Ink colour) {
  return ImGui::ColorConvertU32ToFloat4(colour);
}

}  // namespace

Ink ink(const view::Colour& c) {
  return ImGui::ColorConvertFloat4ToU32({c.red, c.green, c.blue, c.alpha});
}

Ink faded(Ink colour, float alpha) {
  const auto was = static_cast<float>(colour >> 24U);
  return (colour & 0xffffffU) | static_cast<Ink>(std::clamp(was * alpha, 0.0F, 255.0F)) << 24U;
}

view::Colour colour_of(Ink colour) {
  const ImVec4 v = vector_of(colour);
  return {v.x, v.y, v.z, v.w};
}

const Tokens& dark_tokens() {
  static const Tokens tokens{.light = false,
                             .panel = rgb(0x1E2126, 242),
                             .bar = rgb(0x1C1F23),
                             .status = rgb(0x15171A),
                             .well = rgb(0x14161A),
                             .well_hovered = rgb(0x191C21),
                             .fill = rgb(0xE8A33D, 44),
                             .raised = rgb(0x24282E, 252),
                             .outline = rgb(0x363B43),
                             .shade = rgb(0x0B0C0E, 130),
                             .text = rgb(0xE8EAED),
                             .quiet = rgb(0xA7ADB6),
                             .faint = rgb(0x6C737D),
                             .accent = rgb(0xE8A33D),
                             .on_accent = rgb(0x1B1204),
                             .warning = rgb(0xE4572E),
                             .good = rgb(0x74C17B),
                             .mark = rgb(0x5BD0CB)};
  return tokens;
}

const Tokens& light_tokens() {
  static const Tokens tokens{.light = true,
                             .panel = rgb(0xFCFCFD, 244),
                             .bar = rgb(0xF1F2F4),
                             .status = rgb(0xE7E9EC),
                             .well = rgb(0xEEF0F2),
                             .well_hovered = rgb(0xE6E8EC),
                             .fill = rgb(0xE8A33D, 78),
                             .raised = rgb(0xFFFFFF, 252),
                             .outline = rgb(0xCFD4DA),
                             .shade = rgb(0x50565F, 90),
                             .text = rgb(0x1E2126),
                             .quiet = rgb(0x5A616B),
                             .faint = rgb(0x8D949E),
                             .accent = rgb(0xD98A14),
                             .on_accent = rgb(0xFFFFFF),
                             .warning = rgb(0xD2401A),
                             .good = rgb(0x2F8F3A),
                             .mark = rgb(0x139A94)};
  return tokens;
}

void apply_style(const Tokens& t, float scale) {
  ImGuiStyle style;
  style.WindowPadding = {0, 0};
  style.WindowRounding = style.PopupRounding = style.FrameRounding = k_corner;
  style.WindowBorderSize = style.PopupBorderSize = style.FrameBorderSize = 0;
  style.WindowMinSize = {1, 1};
  style.FramePadding = {8, 5};
  style.ItemSpacing = {0, 0};
  style.ScrollbarSize = 6;
  style.ScrollbarRounding = 3;
  style.AntiAliasedLinesUseTex = false;
  style.CircleTessellationMaxError = 0.15F;
  style.ScaleAllSizes(scale);
  for (ImVec4& colour : style.Colors) colour = {0, 0, 0, 0};
  style.Colors[ImGuiCol_Text] = vector_of(t.text);
  style.Colors[ImGuiCol_TextDisabled] = vector_of(t.faint);
  style.Colors[ImGuiCol_TextSelectedBg] = vector_of(faded(t.accent, 0.35F));
  style.Colors[ImGuiCol_ScrollbarGrab] = vector_of(t.outline);
  style.Colors[ImGuiCol_ScrollbarGrabHovered] = vector_of(t.faint);
  style.Colors[ImGuiCol_ScrollbarGrabActive] = vector_of(t.accent);
  ImGui::GetStyle() = style;
}

}  // namespace argil::studio
