#include "tools/studio/fonts.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>

#include "tools/studio/theme.h"

#ifdef ARGIL_HAS_FREETYPE
#include <imgui_freetype.h>
#endif

namespace argil::studio {

namespace {

constexpr std::array k_regular{"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                               "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
                               "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                               "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};
constexpr std::array k_strong{"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf",
                              "/usr/share/fonts/truetype/inter/Inter-SemiBold.ttf",
                              "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf",
                              "/usr/share/fonts/truetype/liberation/LiberationSans-Bold.ttf"};
constexpr std::array k_icons{"/usr/share/fonts/truetype/font-awesome/fontawesome-webfont.ttf",
                             "/usr/share/fonts/opentype/font-awesome/FontAwesome.otf"};

// Latin, Greek, punctuation, raised digits, arrows, mathematical and geometric signs.
constexpr std::array<ImWchar, 19> k_letters{0x20,   0x17F,  0x300,  0x3FF,  0x2010, 0x205E, 0x2070,
                                            0x209F, 0x20AC, 0x20AC, 0x2190, 0x21FF, 0x2200, 0x22FF,
                                            0x2300, 0x23FF, 0x25A0, 0x25FF, 0};
constexpr std::array<ImWchar, 3> k_signs{0xF000, 0xF2E0, 0};

ImFont* load(std::span<const char* const> files, float size, const ImWchar* range) {
  std::error_code failure;
  const auto there = std::find_if(files.begin(), files.end(),
                                  [&](const char* file) { return std::filesystem::exists(file, failure); });
  if (there == files.end()) return nullptr;
  ImFontConfig config;
  config.OversampleH = config.OversampleV = 1;
#ifndef ARGIL_HAS_FREETYPE
  config.OversampleH = 2;
#endif
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(*there, size, &config, range);
}

}  // namespace

Fonts load_fonts(float scale) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.TexGlyphPadding = 1;
#ifdef ARGIL_HAS_FREETYPE
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
#endif
  Fonts fonts;
  // Sizes here are line heights; 1.2 gives the em that UX asks for.
  const float text = std::round(1.2F * 14 * scale), small = std::round(1.2F * 12.5F * scale);
  fonts.text = load(k_regular, text, k_letters.data());
  if (fonts.text == nullptr) fonts.text = atlas.AddFontDefault();
  const auto or_text = [&](ImFont* font) { return font != nullptr ? font : fonts.text; };
  fonts.strong = or_text(load(k_strong, text, k_letters.data()));
  fonts.small = or_text(load(k_regular, small, k_letters.data()));
  fonts.small_strong = or_text(load(k_strong, small, k_letters.data()));
  fonts.icons = load(k_icons, std::round(18 * scale), k_signs.data());
  fonts.small_icons = load(k_icons, std::round(14 * scale), k_signs.data());
  ImGui::GetIO().FontDefault = fonts.text;
  return fonts;
}

}  // namespace argil::studio
