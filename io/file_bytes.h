#pragma once
// Whole files in and out. A file is written beside its place and then renamed, so that a failure leaves what was
// there.

#include <filesystem>
#include <string>
#include <string_view>

namespace argil::io {

/// @throws Error (not_found) if there is no such file, (bad_input) if it is not a readable regular file.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Replaces `path` by `bytes` at one stroke. @throws Error (bad_input) naming the path and the reason; the old
/// file, if any, is then untouched and nothing else is left.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace argil::io
