#include "io/gltf.h"

#include "io/gltf_asset.h"

namespace argil::io {
namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      bits = bits << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? k_digits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace

std::string glb_bytes(const SurfaceMesh& mesh, const SurfaceLook& look) {
  const GltfAsset asset = gltf_asset(mesh, look, split_at_creases(mesh, look));
  return glb_head(gltf_json(asset, asset.binary.size(), {}), asset.binary.size()) + asset.binary;
}

std::string gltf_text(const SurfaceMesh& mesh, const SurfaceLook& look) {
  const GltfAsset asset = gltf_asset(mesh, look, split_at_creases(mesh, look));
  return gltf_json(asset, asset.binary.size(),
                   ",\"uri\":\"data:application/octet-stream;base64," + base64(asset.binary) + "\"") +
         "\n";
}

}  // namespace argil::io
