#include "sculpt/export.h"

#include <fmt/format.h>

#include "sculpt/measures.h"
#include "sculpt/surface_look.h"
#include "subdiv/boundary.h"
#include "subdiv/build.h"

namespace argil::sculpt {

bool is_surface_format(const std::filesystem::path& path) {
  return io::is_surface_format(path);
}

io::SurfaceMesh surface_mesh(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions) {
  subdiv::BoundarySurface surface = subdiv::boundary_surface(solid);
  io::SurfaceMesh mesh;
  mesh.positions.resize(3, static_cast<Eigen::Index>(surface.vertex_from_surface.size()));
  for (std::size_t v = 0; v < surface.vertex_from_surface.size(); ++v)
    mesh.positions.col(static_cast<Eigen::Index>(v)) =
        positions.col(static_cast<Eigen::Index>(surface.vertex_from_surface[v].index()));
  mesh.offsets = std::move(surface.offsets);
  mesh.corners = std::move(surface.corners);
  return mesh;
}

std::vector<std::string> save_document(const Document& document, const std::filesystem::path& path, int level) {
  const subdiv::Refinement& refined = document.refinement();
  const subdiv::Solid& solid = refined.levels[static_cast<std::size_t>(level)];
  const bool finest = level == document.state().level;
  const Eigen::Matrix3Xd positions =
      finest && level > 0 ? document.surface_nodes(document.positions())
                          : subdiv::apply(refined.stencils[static_cast<std::size_t>(level)], document.positions());
  std::vector<std::string> notes;
  if (is_surface_format(path)) {
    io::write_surface(path, surface_mesh(solid, positions), surface_look(solid));
    return notes;
  }
  io::VolumeMesh mesh;
  mesh.cells = subdiv::cell_lists(solid, positions);
  // Fields live on the nodes of the finest level; dead ids are squeezed out as cell_lists does.
  const bool holds_fields = path.extension() != ".mesh";
  if (!finest || !holds_fields) {
    notes.push_back(
        fmt::format("{} holds the shape alone: {}", path.filename().string(),
                    holds_fields ? "fields belong to the finest level" : "MEDIT has no place for fields"));
  } else {
    std::vector<std::string> names;
    for (const FieldInfo& info : field_table()) names.emplace_back(info.word);
    if (level > 0) names.insert(names.end(), {"strain", "stress", "speed"});
    for (const std::string& name : names) {
      const ShownField field = shown_field(document, name);
      io::NamedField out{.name = name, .components = 1, .values = {}};
      for (const subdiv::VertexId v : solid.vertices())
        out.values.push_back(field.values[static_cast<Eigen::Index>(v.index())]);
      mesh.point_fields.push_back(std::move(out));
    }
    const Eigen::Matrix3Xd moved =
        positions - (level > 0 ? document.surface_nodes(document.rest()) : Eigen::Matrix3Xd(document.rest()));
    io::NamedField displacement{.name = "displacement", .components = 3, .values = {}};
    for (const subdiv::VertexId v : solid.vertices())
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        displacement.values.push_back(moved(axis, static_cast<Eigen::Index>(v.index())));
    mesh.point_fields.push_back(std::move(displacement));
  }
  io::write_volume_mesh(path, mesh);
  return notes;
}

}  // namespace argil::sculpt
