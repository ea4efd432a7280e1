#include "io/image.h"

#include <fmt/format.h>

#include <cassert>
#include <memory>
#include <string>

#include "io/file_bytes.h"
#include "io/number_type.h"
#include "subdiv/error.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 32768
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace argil::io {
namespace {

constexpr int k_channels = 4;

// stb_image allocates what a chunk counts before it looks whether the file holds so much.
void check_chunks(std::string_view bytes, std::string_view name) {
  constexpr std::size_t k_signature = 8, k_around = 12;  // length, type and checksum of a chunk
  for (std::size_t at = k_signature; at < bytes.size();) {
    const std::size_t left = bytes.size() - at;
    const std::uint64_t length = left < k_around ? 0 : decode_unsigned(bytes.data() + at, 4, true);
    if (left < k_around || length > left - k_around) {
      throw Error(
          ErrorCode::bad_input,
          fmt::format("expected a part of a PNG picture in the {} bytes left, found one of {}; was the file "
                      "cut short?",
                      left, length + k_around),
          fmt::format("{}: byte {}", name, at));
    }
    if (bytes.substr(at + 4, 4) == "IEND") return;
    at += k_around + length;
  }
}

void append(void* bytes, void* part, int size) {
  static_cast<std::string*>(bytes)->append(static_cast<const char*>(part), static_cast<std::size_t>(size));
}

}  // namespace

void write_png(const std::filesystem::path& path, int width, int height, const std::vector<std::uint8_t>& rgba) {
  assert(width > 0 && height > 0);
  assert(rgba.size() ==
         std::size_t{k_channels} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::string bytes;
  if (stbi_write_png_to_func(append, &bytes, width, height, k_channels, rgba.data(), k_channels * width) == 0) {
    throw Error(ErrorCode::bad_input, fmt::format("a picture of {} × {} could not be packed", width, height),
                path.string());
  }
  write_file(path, bytes);
}

Image read_png(const std::filesystem::path& path) {
  return read_png(read_file(path), path.string());
}

Image read_png(std::string_view bytes, std::string_view name) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(std::min<std::size_t>(bytes.size(), INT32_MAX));
  Image image;
  int channels = 0;
  // A bit a pixel, packed 1032 times, is the most that a file can hold.
  if (static_cast<std::size_t>(size) != bytes.size() ||
      stbi_info_from_memory(data, size, &image.width, &image.height, &channels) == 0 ||
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) / 8 / 1032 > bytes.size()) {
    throw Error(ErrorCode::bad_input, "expected a PNG picture, found something else or a damaged one",
                std::string(name));
  }
  check_chunks(bytes, name);
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &image.width, &image.height, &channels, k_channels), stbi_image_free);
  if (!pixels) {
    throw Error(ErrorCode::bad_input, fmt::format("the PNG picture is damaged: {}", stbi_failure_reason()),
                std::string(name));
  }
  const std::size_t count =
      std::size_t{k_channels} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.rgba.assign(pixels.get(), pixels.get() + count);
  return image;
}

}  // namespace argil::io
