#pragma once
// The boundary surface as an OpenMesh half-edge mesh, for algorithms that walk surfaces. The only header of the
// room that shows OpenMesh.

#include <Eigen/Core>
#include <vector>

// OpenMesh appends vectors that it has not filled yet, which g++ reports under sanitizers.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/Traits.hh>
#pragma GCC diagnostic pop

#include "subdiv/boundary.h"

namespace argil::subdiv {

using SurfaceMesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

struct BoundaryMesh {
  SurfaceMesh mesh;                        // vertex i is surface vertex i, face i is face i of the surface
  std::vector<VertexId> vertex_from_mesh;  // copies of a vertex name the same one
  std::vector<FaceUseId> face_from_mesh;
};

/// `positions`: 3 x vertex capacity of the solid [m].
/// @throws Error (bad_topology) naming an edge along which the boundary runs twice between the same two copies of
/// its vertices: half-edges cannot hold that. Cost O(corners).
[[nodiscard]] BoundaryMesh boundary_mesh(const BoundarySurface& surface, const Eigen::Matrix3Xd& positions);

}  // namespace argil::subdiv
