#pragma once
// Colours of pictures: the tokens of both themes and the maps of fields.

#include <array>
#include <cstddef>
#include <cstdint>

#include "sculpt/renderer.h"

namespace argil::view {

struct Colour {
  float red = 0, green = 0, blue = 0, alpha = 1;
};

constexpr Colour colour(std::uint32_t rgb, float alpha = 1) {
  return {static_cast<float>(rgb >> 16U & 255U) / 255.0F, static_cast<float>(rgb >> 8U & 255U) / 255.0F,
          static_cast<float>(rgb & 255U) / 255.0F, alpha};
}

struct Theme {
  Colour background_top, background_bottom;
  Colour text, quiet_text, halo;
  Colour cage, cage_point, cage_ring;
  Colour wire_on_clay, wire_on_field, wire_alone;
  Colour arrow, arrow_outline, pin, pin_outline;
  Colour overlay, axis_u, axis_v, axis_w, side, rest_side;
  Colour edge_spring, face_spring, inner_spring, material_line, curve, felt;
  float shadow;  // opacity
  Colour obstacle;
};

inline constexpr Theme k_dark_theme{
    colour(0x2B2F36),        colour(0x171A1E),        colour(0xE6E8EB),        colour(0xA9AEB6),
    colour(0x14171A, 0.85F), colour(0x8FB6E0, 0.62F), colour(0x93BDEB),        colour(0x1A1D21),
    colour(0x2A0F04, 0.50F), colour(0x0B1014, 0.38F), colour(0xE0B79A, 0.55F), colour(0xF0A93C),
    colour(0x2A1604, 0.85F), colour(0x5BD0CB),        colour(0x0E2A2A, 0.9F),  colour(0xF2EDE4, 0.70F),
    colour(0xF0655A),        colour(0x7CCB5B),        colour(0x5AA2F5),        colour(0xF0A93C),
    colour(0x5BD0CB),        colour(0xF2EDE4),        colour(0x4FB6E8),        colour(0xF0A93C),
    colour(0xFF7AB8),        colour(0xA6ECFF),        colour(0x2350D8),        0.85F,
    colour(0x9AA3AD, 0.46F)};
inline constexpr Theme k_light_theme{
    colour(0xF7F8FA),        colour(0xDCE0E5),        colour(0x1E2126),        colour(0x5A616B),
    colour(0xFFFFFF, 0.85F), colour(0x3F6FA6, 0.65F), colour(0x3F78B8),        colour(0xFFFFFF),
    colour(0x2A0F04, 0.50F), colour(0x0B1014, 0.38F), colour(0x7A4326, 0.60F), colour(0xE8961E),
    colour(0x3A1D02, 0.85F), colour(0x139A94),        colour(0xFFFFFF, 0.9F),  colour(0x1E2126, 0.70F),
    colour(0xC7352B),        colour(0x3C8A1F),        colour(0x2166C4),        colour(0xC9760A),
    colour(0x0B807B),        colour(0x2B2F36),        colour(0x1F7FB8),        colour(0xC9760A),
    colour(0xB8246F),        colour(0x0B5FA8),        colour(0x3D7BFF),        0.40F,
    colour(0x7D8791, 0.46F)};

constexpr Colour line_colour(sculpt::LineLook look, const Theme& theme) {
  switch (look) {
    case sculpt::LineLook::axis_u:
      return theme.axis_u;
    case sculpt::LineLook::axis_v:
      return theme.axis_v;
    case sculpt::LineLook::axis_w:
      return theme.axis_w;
    case sculpt::LineLook::side:
      return theme.side;
    case sculpt::LineLook::rest_side:
      return theme.rest_side;
    case sculpt::LineLook::edge_spring:
      return theme.edge_spring;
    case sculpt::LineLook::face_spring:
      return theme.face_spring;
    case sculpt::LineLook::inner_spring:
      return theme.inner_spring;
    case sculpt::LineLook::material_line:
      return theme.material_line;
    case sculpt::LineLook::curve:
      return theme.curve;
    case sculpt::LineLook::overlay:
      break;
  }
  return theme.overlay;
}

/// A map of field values: eleven colours, a tenth apart; those between are linear.
inline constexpr std::size_t k_map_size = 11;
using MapColours = std::array<std::array<float, 3>, k_map_size>;
inline constexpr MapColours k_viridis{
    {std::array{0.267004F, 0.004874F, 0.329415F}, std::array{0.282623F, 0.140926F, 0.457517F},
     std::array{0.253935F, 0.265254F, 0.529983F}, std::array{0.206756F, 0.371758F, 0.553117F},
     std::array{0.163625F, 0.471133F, 0.558148F}, std::array{0.127568F, 0.566949F, 0.550556F},
     std::array{0.134692F, 0.658636F, 0.517649F}, std::array{0.266941F, 0.748751F, 0.440573F},
     std::array{0.477504F, 0.821444F, 0.318195F}, std::array{0.741388F, 0.873449F, 0.149561F},
     std::array{0.993248F, 0.906157F, 0.143936F}}};
inline constexpr MapColours k_cividis{
    {std::array{0.000000F, 0.127412F, 0.318588F}, std::array{0.039278F, 0.195987F, 0.416401F},
     std::array{0.167889F, 0.266502F, 0.431220F}, std::array{0.300605F, 0.337961F, 0.429332F},
     std::array{0.410606F, 0.410393F, 0.438066F}, std::array{0.498920F, 0.484543F, 0.457445F},
     std::array{0.581668F, 0.561545F, 0.471831F}, std::array{0.677307F, 0.642612F, 0.461582F},
     std::array{0.793877F, 0.728716F, 0.414697F}, std::array{0.916240F, 0.820273F, 0.338470F},
     std::array{0.993333F, 0.916824F, 0.271137F}}};
/// Blue, white, red: made in OKLab with the same lightness and about the same chroma on both sides.
inline constexpr MapColours k_balanced{
    {std::array{0.000000F, 0.283091F, 0.677244F}, std::array{0.162638F, 0.433898F, 0.818300F},
     std::array{0.355468F, 0.582852F, 0.918120F}, std::array{0.555516F, 0.724674F, 0.974692F},
     std::array{0.761545F, 0.853253F, 0.988560F}, std::array{0.954047F, 0.954047F, 0.954047F},
     std::array{0.979488F, 0.795939F, 0.771613F}, std::array{0.947734F, 0.616437F, 0.577400F},
     std::array{0.870395F, 0.432287F, 0.391293F}, std::array{0.752522F, 0.246116F, 0.219703F},
     std::array{0.600493F, 0.001672F, 0.051721F}}};

/// From green by yellow to red, lightest in the middle, so that both ends are told apart without colour as well.
inline constexpr MapColours k_green_red{
    {std::array{0.055F, 0.480F, 0.210F}, std::array{0.160F, 0.560F, 0.230F}, std::array{0.290F, 0.640F, 0.250F},
     std::array{0.450F, 0.715F, 0.275F}, std::array{0.640F, 0.775F, 0.300F}, std::array{0.860F, 0.810F, 0.320F},
     std::array{0.930F, 0.700F, 0.270F}, std::array{0.940F, 0.570F, 0.225F}, std::array{0.915F, 0.425F, 0.190F},
     std::array{0.860F, 0.270F, 0.155F}, std::array{0.760F, 0.090F, 0.120F}}};
inline constexpr MapColours k_kinds{
    {std::array{0.310F, 0.608F, 0.910F}, std::array{0.910F, 0.690F, 0.310F}, std::array{0.878F, 0.341F, 0.290F},
     std::array{0.420F, 0.749F, 0.349F}, std::array{0.643F, 0.467F, 0.839F}, std::array{0.310F, 0.788F, 0.769F},
     std::array{0.910F, 0.537F, 0.722F}, std::array{0.690F, 0.627F, 0.541F}, std::array{0.788F, 0.820F, 0.310F},
     std::array{0.478F, 0.545F, 0.659F}, std::array{0.949F, 0.929F, 0.894F}}};

constexpr const MapColours& map_colours(sculpt::ColourMap map) {
  switch (map) {
    case sculpt::ColourMap::cividis:
      return k_cividis;
    case sculpt::ColourMap::balanced:
      return k_balanced;
    case sculpt::ColourMap::green_red:
      return k_green_red;
    case sculpt::ColourMap::kinds:
      return k_kinds;
    default:
      return k_viridis;
  }
}
/// t is clamped to 0 … 1.
constexpr Colour field_colour(const MapColours& map, double t) {
  const double s = (t > 0 ? t < 1 ? t : 1 : 0) * static_cast<double>(k_map_size - 1);
  const std::size_t i = s >= static_cast<double>(k_map_size - 1) ? k_map_size - 2 : static_cast<std::size_t>(s);
  const auto f = static_cast<float>(s - static_cast<double>(i));
  const auto &a = map[i], &b = map[i + 1];
  return {a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]), 1};
}

}  // namespace argil::view
