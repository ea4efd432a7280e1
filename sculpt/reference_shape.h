#pragma once
// A solution to compare with, from a file: another mesh, another level, another program.

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>

#include "io/surface.h"
#include "subdiv/build.h"

namespace argil::sculpt {

/// The mesh of a file as a picture or a comparison takes it: a solid, or a surface alone.
struct ComparedMesh {
  subdiv::Built volume;            // without cells for a surface
  Eigen::Matrix3Xd displacements;  // of the volume's vertices [m]; without columns where the file has none
  io::SurfaceMesh surface;         // the boundary of a volume, or the surface
};
/// Any volume or surface format that can be read, by its ending.
/// @throws what the readers and subdiv::build throw, (limit_exceeded) for more cells or faces than `most`.
[[nodiscard]] ComparedMesh read_compared_mesh(const std::filesystem::path& path, std::size_t most);

/// How far a body is from the reference.
/// A volume mesh with a point field `displacement` of three components (as `save` writes .vtu and .vtk) is compared
/// at common material points: the reference at rest is its positions less that field, a rest position of the body
/// is found in its cells (cell_tetrahedra.h: the reference's field between its vertices is linear in each), and the
/// distance is between where both put it. A point just outside, where the facets of two boundaries differ, is
/// carried on linearly. Any other file gives the distance to the nearest point of its surface.
class ReferenceShape {
 public:
  explicit ReferenceShape(const ComparedMesh& mesh);
  ~ReferenceShape();
  ReferenceShape(ReferenceShape&&) noexcept;
  ReferenceShape& operator=(ReferenceShape&&) noexcept;

  bool at_common_points() const;

  /// `rest` and `present`, both 3 x points [m]; one distance a point [m]. In parallel.
  /// @throws Error (bad_input) naming a rest position that the reference's body does not reach.
  [[nodiscard]] Eigen::VectorXd distances(const Eigen::Matrix3Xd& rest, const Eigen::Matrix3Xd& present) const;
  /// Where the reference puts points by their rest positions, 3 x points [m]; only at_common_points().
  /// @throws as above.
  [[nodiscard]] Eigen::Matrix3Xd positions(const Eigen::Matrix3Xd& rest) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace argil::sculpt
