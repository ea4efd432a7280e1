#include "sculpt/reference_shape.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

#include "fem/measure/cell_tetrahedra.h"
#include "fem/measure/tetrahedron_grid.h"
#include "fem/parallel.h"
#include "io/volume_mesh.h"
#include "sculpt/export.h"
#include "subdiv/error.h"
#include "subdiv/query/surface_tree.h"

namespace argil::sculpt {

namespace {

constexpr double k_slack = 2;  // of a tetrahedron's weights: about the height of one beyond its side

void check_size(std::size_t found, std::size_t most, const std::filesystem::path& path) {
  if (found > most)
    throw Error(
        ErrorCode::limit_exceeded,
        fmt::format("'{}' has {} cells or faces, more than {}; compare with a coarser mesh or raise --max-cells",
                    path.filename().string(), found, most));
}

Eigen::Matrix3Xd displacement_field(const io::VolumeMesh& mesh, const subdiv::Built& built) {
  for (const io::NamedField& field : mesh.point_fields) {
    if (field.name != "displacement" || field.components != 3) continue;
    Eigen::Matrix3Xd result(3, built.positions.cols());
    for (std::size_t v = 0; v < built.point_from_vertex.size(); ++v)
      for (std::size_t axis = 0; axis < 3; ++axis)
        result(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(v)) =
            field.values[3 * built.point_from_vertex[v] + axis];
    return result;
  }
  return {};
}

// Faces fanned about their middles, as pictures draw them.
subdiv::SurfaceTree tree_of(const io::SurfaceMesh& surface) {
  Eigen::Matrix3Xd points(3, surface.positions.cols() + static_cast<Eigen::Index>(surface.face_count()));
  points.leftCols(surface.positions.cols()) = surface.positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto face = surface.face(f);
    const Eigen::Index middle = surface.positions.cols() + static_cast<Eigen::Index>(f);
    points.col(middle).setZero();
    for (const std::uint32_t v : face)
      points.col(middle) += surface.positions.col(v) / static_cast<double>(face.size());
    for (std::size_t i = 0; i < face.size(); ++i)
      triangles.push_back({face[i], face[(i + 1) % face.size()], static_cast<std::uint32_t>(middle)});
  }
  return {points, triangles};
}

}  // namespace

ComparedMesh read_compared_mesh(const std::filesystem::path& path, std::size_t most) {
  ComparedMesh result;
  if (!io::is_volume_format(path)) {
    result.surface = io::read_surface(path);
    check_size(result.surface.face_count(), most, path);
    return result;
  }
  const io::VolumeMesh mesh = io::read_volume_mesh(path);
  result.volume = subdiv::build(mesh.cells);
  check_size(result.volume.solid.cell_count(), most, path);
  result.displacements = displacement_field(mesh, result.volume);
  result.surface = surface_mesh(result.volume.solid, result.volume.positions);
  return result;
}

struct ReferenceShape::Impl {
  // At common points:
  std::vector<std::array<std::uint32_t, 4>> corners;
  Eigen::Matrix3Xd present;
  std::optional<fem::TetrahedronGrid> rest;
  // Or nearest:
  std::optional<subdiv::SurfaceTree> surface;
};

ReferenceShape::ReferenceShape(const ComparedMesh& mesh) : impl_(std::make_unique<Impl>()) {
  if (mesh.displacements.cols() == 0) {
    impl_->surface = tree_of(mesh.surface);
    return;
  }
  const fem::CellTetrahedra cut = fem::cell_tetrahedra(mesh.volume.solid);
  impl_->present = subdiv::apply(cut.points, mesh.volume.positions);
  const Eigen::Matrix3Xd at_rest = mesh.volume.positions - mesh.displacements;
  impl_->rest.emplace(subdiv::apply(cut.points, at_rest), cut.corners);
  impl_->corners = cut.corners;
}

ReferenceShape::~ReferenceShape() = default;
ReferenceShape::ReferenceShape(ReferenceShape&&) noexcept = default;
ReferenceShape& ReferenceShape::operator=(ReferenceShape&&) noexcept = default;

bool ReferenceShape::at_common_points() const {
  return impl_->rest.has_value();
}

Eigen::VectorXd ReferenceShape::distances(const Eigen::Matrix3Xd& rest, const Eigen::Matrix3Xd& present) const {
  Eigen::VectorXd result(present.cols());
  if (!impl_->rest) {
    for (Eigen::Index i = 0; i < result.size(); ++i)
      result[i] = (present.col(i) - impl_->surface->nearest(present.col(i))).norm();
    return result;
  }
  const Eigen::Matrix3Xd there = positions(rest);
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = (present.col(i) - there.col(i)).norm();
  return result;
}

Eigen::Matrix3Xd ReferenceShape::positions(const Eigen::Matrix3Xd& rest) const {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, rest.cols());
  std::vector<std::uint8_t> found(static_cast<std::size_t>(rest.cols()), 0);
  fem::parallel_for(found.size(), 64, [&](std::size_t i) {
    const auto column = static_cast<Eigen::Index>(i);
    const auto at = impl_->rest->locate(rest.col(column), k_slack);
    if (!at) return;
    found[i] = 1;
    for (std::size_t k = 0; k < 4; ++k)
      result.col(column) += at->weights[k] * impl_->present.col(impl_->corners[at->tetrahedron][k]);
  });
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i] == 0) {
      const Eigen::Vector3d point = rest.col(static_cast<Eigen::Index>(i));
      throw Error(
          ErrorCode::bad_input,
          fmt::format("the reference does not reach the rest position ({:g}, {:g}, {:g}) of the solid; compare "
                      "with a solution of the same body, at the same place when at rest",
                      point.x(), point.y(), point.z()));
    }
  return result;
}

}  // namespace argil::sculpt
