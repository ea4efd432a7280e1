#pragma once
// PNG pictures.

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace argil::io {

/// Writes RGBA, 8 bits a channel, top row first. @throws Error (bad_input) naming the path if it cannot be written.
void write_png(const std::filesystem::path& path, int width, int height, const std::vector<std::uint8_t>& rgba);

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};
/// @throws Error (bad_input).
[[nodiscard]] Image read_png(const std::filesystem::path& path);
[[nodiscard]] Image read_png(std::string_view bytes, std::string_view name);

}  // namespace argil::io
