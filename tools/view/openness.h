#pragma once
// How much of the sky each vertex sees (ambient occlusion): the surface is drawn as depth from many directions at
// once spread over the sphere, and each vertex asks in which of these pictures it lies in front.

#include <memory>

#include "tools/view/gl_objects.h"
#include "tools/view/surface_mesh.h"

namespace argil::view {

inline constexpr std::array<Attribute, 4> k_surface_attributes{{{0, 3}, {1, 3}, {2, 2}, {3, 2, true}}};

/// Measures the cosine-weighted part of the sky above the ground that nothing hides from each vertex, with light
/// from below counting less: direction by direction, so that a window need not wait for it.
class OpennessMeasure {
 public:
  /// `depth_program` draws depth as bytes (shaders::k_depth_fragment). Both must outlive the measure, the context
  /// being current whenever a function is called.
  OpennessMeasure(const Gl& gl, const Program& depth_program) : gl_(&gl), program_(&depth_program), array_(gl) {}

  /// Takes a copy of the mesh, which must fit a ball of radius about 1, and forgets what was measured.
  void begin(const SurfaceMesh& mesh);
  /// Looks from as many of the directions that are left as cost about as much as a frame does. Binds other targets.
  void look_on();
  bool is_done() const { return looked_ == directions_.size(); }
  /// Once it is done: sets `openness` of the vertices of a mesh with as many of them.
  void write(SurfaceMesh& mesh) const;

 private:
  void look(const Eigen::Vector3f& light);

  const Gl* gl_;
  const Program* program_;
  VertexArray array_;
  std::unique_ptr<Target> target_;
  SurfaceMesh mesh_;
  std::vector<Eigen::Vector3f> directions_;  // up to 32, fewer for large meshes
  std::size_t looked_ = 0;
  std::vector<float> seen_, total_;  // of each vertex
  std::vector<std::uint8_t> bytes_;
};

}  // namespace argil::view
