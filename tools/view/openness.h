#pragma once
// How much of the sky each vertex sees (ambient occlusion): the surface is drawn as depth from many directions at
// once spread over the sphere, and each vertex asks in which of these pictures it lies in front.

#include "tools/view/gl_objects.h"
#include "tools/view/surface_mesh.h"

namespace argil::view {

inline constexpr std::array<Attribute, 4> k_surface_attributes{{{0, 3}, {1, 3}, {2, 2}, {3, 2, true}}};

/// Sets `openness` of the vertices: the cosine-weighted part of the sky above the ground that nothing hides, with
/// light from below counting less. The mesh must fit a ball of radius about 1. `depth_program` draws depth as bytes
/// (shaders::k_depth_fragment). Cost: up to 32 small pictures of the mesh, fewer for large ones.
void measure_openness(const Gl& gl, const Program& depth_program, SurfaceMesh& mesh);

}  // namespace argil::view
