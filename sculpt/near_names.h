#pragma once
// Which known names a mistyped one may mean, for messages about commands, fields and options.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace argil::sculpt {

/// Fewest insertions, removals, replacements and swaps of neighbours that turn one name into the other, in bytes.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// At most `limit` of `names` within a third of the length of `name` (at least one edit), nearest first, then in
/// the given order. Cost O(names · length²).
[[nodiscard]] std::vector<std::string> near_names(std::string_view name, std::span<const std::string> names,
                                                  std::size_t limit = 3);

/// "; did you mean `a` or `b`?", or nothing.
[[nodiscard]] std::string near_names_hint(std::string_view name, std::span<const std::string> names);

}  // namespace argil::sculpt
