#pragma once
// The parts of a glTF asset of one mesh, shared by a surface that stands and one that moves; private to io/gltf*.

#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_points.h"

namespace argil::io {

inline constexpr int k_gltf_vertices = 34962, k_gltf_indices = 34963, k_gltf_plain = 0;

struct GltfAsset {
  std::string binary;            // of the surface itself
  std::string views, accessors;  // JSON, comma separated
  std::size_t count = 0;         // of both
  bool coloured = false;

  /// A view and its accessor, whose JSON lacks the view; returns their number. `target` is one of k_gltf_….
  std::size_t add(std::size_t offset, std::size_t length, int target, std::string_view accessor);
};

void append_word(std::string& bytes, std::uint32_t word);
void append_vector(std::string& bytes, const Eigen::Vector3f& vector);
/// Of an accessor of `count` vectors, and with its bounds.
[[nodiscard]] std::string gltf_vectors(std::size_t count);
[[nodiscard]] std::string gltf_bounds(const Eigen::Vector3f& low, const Eigen::Vector3f& high);

/// Positions, normals, colours and triangles. Throws as check_gltf_range.
[[nodiscard]] GltfAsset gltf_asset(const SurfaceMesh& mesh, const SurfaceLook& look, const GltfPoints& points);

/// The document; `of_primitive`, `of_mesh` and `of_document` are further members of those, each after a comma.
[[nodiscard]] std::string gltf_json(const GltfAsset& asset, std::size_t buffer_length, std::string_view uri,
                                    std::string_view of_primitive = {}, std::string_view of_mesh = {},
                                    std::string_view of_document = {});

/// The head of a .glb with its JSON chunk and the head of a binary chunk of `binary` bytes, all but those bytes.
/// @throws Error (unsupported) where it would be larger than 32 bits count.
[[nodiscard]] std::string glb_head(std::string json, std::size_t binary);

}  // namespace argil::io
