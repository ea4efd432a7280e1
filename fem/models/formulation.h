#pragma once
// How a model takes the strain in trilinear hexahedra (METHODS §3). Other element kinds are always plain.

#include <array>
#include <string_view>

namespace argil::fem {

enum class Formulation { plain, b_bar, incompatible_modes };
inline constexpr std::array k_formulations{Formulation::plain, Formulation::b_bar, Formulation::incompatible_modes};
[[nodiscard]] std::string_view word(Formulation formulation);

}  // namespace argil::fem
