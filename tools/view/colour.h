#pragma once
// Colours of pictures: the tokens of both themes and the map of fields.

#include <array>
#include <cstdint>

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
  float shadow;  // opacity
};

inline constexpr Theme k_dark_theme{
    colour(0x2B2F36),        colour(0x171A1E),        colour(0xE6E8EB),        colour(0xA9AEB6),
    colour(0x14171A, 0.85F), colour(0x8FB6E0, 0.62F), colour(0x93BDEB),        colour(0x1A1D21),
    colour(0x2A0F04, 0.50F), colour(0x0B1014, 0.38F), colour(0xE0B79A, 0.55F), colour(0xF0A93C),
    colour(0x2A1604, 0.85F), colour(0x5BD0CB),        colour(0x0E2A2A, 0.9F),  0.85F};
inline constexpr Theme k_light_theme{
    colour(0xF7F8FA),        colour(0xDCE0E5),        colour(0x1E2126),        colour(0x5A616B),
    colour(0xFFFFFF, 0.85F), colour(0x3F6FA6, 0.65F), colour(0x3F78B8),        colour(0xFFFFFF),
    colour(0x2A0F04, 0.50F), colour(0x0B1014, 0.38F), colour(0x7A4326, 0.60F), colour(0xE8961E),
    colour(0x3A1D02, 0.85F), colour(0x139A94),        colour(0xFFFFFF, 0.9F),  0.40F};

inline constexpr int k_viridis_size = 11;
/// Eleven samples of the map viridis, a tenth apart; colours between them are linear.
inline constexpr std::array<std::array<float, 3>, k_viridis_size> k_viridis{{{0.267004F, 0.004874F, 0.329415F},
                                                                             {0.282623F, 0.140926F, 0.457517F},
                                                                             {0.253935F, 0.265254F, 0.529983F},
                                                                             {0.206756F, 0.371758F, 0.553117F},
                                                                             {0.163625F, 0.471133F, 0.558148F},
                                                                             {0.127568F, 0.566949F, 0.550556F},
                                                                             {0.134692F, 0.658636F, 0.517649F},
                                                                             {0.266941F, 0.748751F, 0.440573F},
                                                                             {0.477504F, 0.821444F, 0.318195F},
                                                                             {0.741388F, 0.873449F, 0.149561F},
                                                                             {0.993248F, 0.906157F, 0.143936F}}};
/// t is clamped to 0 … 1.
constexpr Colour viridis(float t) {
  const float s = (t < 0 ? 0 : t > 1 ? 1 : t) * (k_viridis_size - 1);
  const int i = s >= k_viridis_size - 1 ? k_viridis_size - 2 : static_cast<int>(s);
  const float f = s - static_cast<float>(i);
  const auto& a = k_viridis[static_cast<std::size_t>(i)];
  const auto& b = k_viridis[static_cast<std::size_t>(i + 1)];
  return {a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]), 1};
}

}  // namespace argil::view
