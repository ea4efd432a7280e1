#pragma once
// How numbers with a unit are written for people: in a prefix that keeps them short, with a true minus sign.

#include <string>

namespace argil::sculpt {

struct ShownUnit {
  double per_value = 1;  // what is written is the value times this
  std::string unit;      // "kPa"
};
/// For numbers up to `largest` in size: 12e3 "Pa" becomes 12 "kPa"; fractions with the unit "%" become per cent;
/// units that take no prefix (kg, m^3, …) stay.
[[nodiscard]] ShownUnit shown_unit(const std::string& unit, double largest);

/// With as many decimals as a step between ticks needs; beyond 1e6 and below 1e-4 with a power of ten.
[[nodiscard]] std::string tick_text(double value, double step);

}  // namespace argil::sculpt
