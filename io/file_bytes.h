#pragma once
// Whole files in and out. A file is written beside its place and then renamed, so that a failure leaves what was
// there.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace argil::io {

/// @throws Error (not_found) if there is no such file, (bad_input) if it is not a readable regular file.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Replaces `path` by `bytes` at one stroke. @throws Error (bad_input) naming the path and the reason; the old
/// file, if any, is then untouched and nothing else is left.
void write_file(const std::filesystem::path& path, std::string_view bytes);
/// The same of what comes in parts: `give` is called once, and calls its argument with each. What `give` throws
/// goes on, with the old file untouched.
void write_file(const std::filesystem::path& path,
                const std::function<void(const std::function<void(std::string_view)>& write)>& give);

}  // namespace argil::io
