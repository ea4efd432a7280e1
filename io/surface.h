#pragma once
// What a surface file holds: polygons. Readers are as strict as those of volume meshes (volume_mesh.h): a malformed
// file is an Error with its place, what was expected, what was found and what to do. A reader promises corners that
// name vertices, at least three a face, and finite positions; whether the polygons close is asked of check_surface.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace argil::io {

/// A polygonal surface, counter-clockwise from outside.
struct SurfaceMesh {
  Eigen::Matrix3Xd positions;
  std::vector<std::size_t> offsets{0};  // face i has corners [offsets[i], offsets[i + 1])
  std::vector<std::uint32_t> corners;

  std::size_t face_count() const { return offsets.size() - 1; }
  std::span<const std::uint32_t> face(std::size_t i) const {
    return std::span(corners).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
};

/// How a surface is to look, for the formats that hold more than its shape (glTF).
struct SurfaceLook {
  double crease_angle = 50;              // [degrees]; normals split where faces bend by more
  std::vector<std::uint8_t> sharp;       // 1 a corner: they split along the edge from it to the next too; or empty
  std::vector<Eigen::Vector3f> colours;  // one a vertex, linear red green blue in [0, 1]; or empty
};

/// Whether the ending of the name is one that `write_surface` knows: .obj .ply .stl .off .glb .gltf.
[[nodiscard]] bool is_surface_format(const std::filesystem::path& path);

/// Reads by the ending of the name: .obj, .ply, .stl (equal vertices are one), .off.
/// @throws Error as above; (not_found) if there is no such file; (unsupported) for another ending, or for what is
/// not polygons (curves, strips, binary OFF), by name.
[[nodiscard]] SurfaceMesh read_surface(const std::filesystem::path& path);

/// Writes .obj, .ply (binary little endian, double), .off, .stl (binary), .glb or .gltf; the last three hold
/// triangles in single precision. @throws Error (unsupported) for what the format cannot hold; nothing is written
/// then.
void write_surface(const std::filesystem::path& path, const SurfaceMesh& mesh, const SurfaceLook& look = {});

/// Vertices closer than `tolerance` [m] become the one of lowest number, in chains as well; with 0, equal ones.
/// Corners that repeat go, and faces of which fewer than three are left; vertices stay in order of first use, those
/// without a face go. Cost O(n log n) where few vertices lie within the tolerance of each other.
[[nodiscard]] SurfaceMesh weld(const SurfaceMesh& mesh, double tolerance = 0);

/// What keeps a surface from bounding a solid. Everything ascending.
struct SurfaceReport {
  using Edge = std::array<std::uint32_t, 2>;         // vertices, the lower first
  std::vector<std::uint32_t> broken_faces;           // fewer than three corners, out of range, or a vertex twice
  std::vector<std::uint32_t> infinite_vertices;      // not finite
  std::vector<Edge> open_edges;                      // at one face
  std::vector<Edge> misoriented_edges;               // two faces run along it the same way
  std::vector<Edge> non_manifold_edges;              // at more than two faces
  std::vector<std::uint32_t> non_manifold_vertices;  // the faces around it make more than one fan
  std::size_t component_count = 0;                   // of faces connected through edges

  /// It can be looked at: what the following members say is only known then.
  bool sound() const { return broken_faces.empty() && infinite_vertices.empty(); }
  /// Every edge is at two faces that run along it in opposite ways, and every vertex has one fan of faces.
  bool closed_manifold() const {
    return sound() && open_edges.empty() && misoriented_edges.empty() && non_manifold_edges.empty() &&
           non_manifold_vertices.empty();
  }
  /// What is wrong and what to do, in words; empty if nothing is.
  [[nodiscard]] std::string findings() const;
};
/// Looks at any mesh, well formed or not (offsets must rise and end within the corners). Cost O(corners, log).
[[nodiscard]] SurfaceReport check_surface(const SurfaceMesh& mesh);

}  // namespace argil::io
