#pragma once
// Named sets in formats that have only fields: an array of 0 and 1 named "set:NAME" at the points, faces or cells.

#include <cstdint>
#include <string>
#include <vector>

#include "io/volume_mesh.h"

namespace argil::io {

inline constexpr std::string_view k_set_prefix = "set:";

/// The set as 0 and 1 over `count` items.
[[nodiscard]] std::vector<std::uint8_t> membership(const NamedSet& set, std::size_t count);
/// The set that an array holds, named without the prefix.
[[nodiscard]] NamedSet set_of_membership(std::string_view array, SetKind kind, const std::vector<double>& values);
/// Whether an array of that name and these values is a set.
[[nodiscard]] bool is_membership(std::string_view array, int components, const std::vector<double>& values);

/// Turns the fields that are sets into sets.
void take_sets_from_fields(VolumeMesh& mesh);

}  // namespace argil::io
