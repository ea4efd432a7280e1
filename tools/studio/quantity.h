#pragma once
// Numbers with units as people write them: "2 mm", "1/3", "(3 + 0.5) kPa". Values are in SI units; a field of the
// window says which.

#include <string>

namespace argil::studio {

struct Quantity {
  std::string number, unit;
};

/// The value in the prefix of its unit that keeps it short, three digits: 2e5 "Pa" is "200", "kPa".
[[nodiscard]] Quantity shown(double value, const std::string& unit);
/// As an editor shows it: every digit that matters, in the same prefix.
[[nodiscard]] std::string editable(double value, const std::string& unit);

/// Sums, products, powers and parentheses of numbers; each may carry a unit that fits `unit`. Where none does, the
/// whole is in `default_unit`, the prefix that stood in the field.
/// @throws Error (bad_input) that says what was expected, where, and what to write.
[[nodiscard]] double parse_quantity(const std::string& text, const std::string& unit,
                                    const std::string& default_unit);

}  // namespace argil::studio
