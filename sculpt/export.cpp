#include "sculpt/export.h"

#include <fmt/format.h>

#include "io/volume_formats.h"
#include "sculpt/measures.h"
#include "sculpt/surface_look.h"
#include "subdiv/boundary.h"
#include "subdiv/build.h"
#include "subdiv/error.h"

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

namespace {

using namespace subdiv;

std::string sharpness_note(const Solid& solid) {
  std::size_t edges = 0, vertices = 0, faces = 0;
  for (const EdgeId e : solid.edges()) edges += solid.edge_sharpness(e) > 0;
  for (const VertexId v : solid.vertices()) vertices += solid.vertex_sharpness(v) > 0;
  for (const FaceId f : solid.faces()) faces += solid.face_sharpness(f) > 0;
  if (edges + vertices + faces == 0) return {};
  return fmt::format(
      "the sharpness of {} edges, {} vertices and {} faces is left out: no file format holds it; sharpen again "
      "after "
      "opening",
      edges, vertices, faces);
}

// The named sets of a document at a level, and what of them has no place there.
class SetExport {
 public:
  SetExport(const Document& document, int level, io::VolumeMesh& mesh, std::vector<std::string>& notes)
      : document_(document),
        level_(level),
        solid_(document.refinement().levels[static_cast<std::size_t>(level)]),
        mesh_(mesh),
        notes_(notes) {
    points_.resize(solid_.vertex_capacity());
    std::uint32_t next = 0;
    for (const VertexId v : solid_.vertices()) points_[v] = next++;
    // Sets by kind, as files list them.
    for (const ElementType type :
         {ElementType::vertices, ElementType::nodes, ElementType::edges, ElementType::faces, ElementType::cells})
      for (const auto& [name, set] : *document.state().sets)
        if (set.type == type) add(name, set);
  }

 private:
  void add(const std::string& name, const Selection& set) {
    const bool finest = level_ == document_.state().level;
    if (set.type == ElementType::cells) {
      add_cells(name, set.ids);
    } else if ((set.type == ElementType::vertices && level_ == 0) || (set.type == ElementType::nodes && finest)) {
      io::NamedSet out{name, io::SetKind::points, {}};
      for (const std::uint32_t id : set.ids) out.ids.push_back(points_[VertexId{id}]);
      mesh_.sets.push_back(std::move(out));
    } else if (set.type == ElementType::faces && level_ == 0) {
      add_faces(name, set.ids);
    } else {
      notes_.push_back(fmt::format("the set '{}' of {} is left out: {}", name, word(set.type),
                                   set.type == ElementType::edges   ? "no file format holds sets of edges"
                                   : set.type == ElementType::nodes ? "nodes are those of the finest level"
                                                                    : "it is of the control solid; save level 0"));
    }
  }

  void add_cells(const std::string& name, const std::vector<std::uint32_t>& control_cells) {
    const auto& refinement = document_.refinement();
    CellData<std::uint8_t> chosen(refinement.levels[0].cell_capacity(), 0);
    for (const std::uint32_t id : control_cells) chosen[CellId{id}] = 1;
    for (std::size_t level = 1; level <= static_cast<std::size_t>(level_); ++level) {
      const Solid& fine = refinement.levels[level];
      CellData<std::uint8_t> next(fine.cell_capacity(), 0);
      for (const CellId c : fine.cells()) next[c] = chosen[refinement.parent[level][c]];
      chosen = std::move(next);
    }
    io::NamedSet out{name, io::SetKind::cells, {}};
    std::uint32_t number = 0;
    for (const CellId c : solid_.cells()) {
      if (chosen[c] != 0) out.ids.push_back(number);
      ++number;
    }
    mesh_.sets.push_back(std::move(out));
  }

  void add_faces(const std::string& name, const std::vector<std::uint32_t>& ids) {
    io::NamedSet out{name, io::SetKind::faces, {}};
    for (const std::uint32_t id : ids) {
      out.ids.push_back(static_cast<std::uint32_t>(mesh_.faces.count()));
      for (const VertexId v : solid_.face_vertices(FaceId{id})) mesh_.faces.corners.push_back(points_[v]);
      mesh_.faces.offsets.push_back(mesh_.faces.corners.size());
    }
    mesh_.sets.push_back(std::move(out));
  }

  const Document& document_;
  int level_;
  const Solid& solid_;
  io::VolumeMesh& mesh_;
  std::vector<std::string>& notes_;
  VertexData<std::uint32_t> points_;
};

}  // namespace

std::vector<std::string> save_document(const Document& document, const std::filesystem::path& path, int level,
                                       const io::WriteOptions& options, const ReferenceShape* reference) {
  const subdiv::Refinement& refined = document.refinement();
  const subdiv::Solid& solid = refined.levels[static_cast<std::size_t>(level)];
  const bool finest = level == document.state().level;
  const Eigen::Matrix3Xd positions =
      finest && level > 0 ? document.surface_nodes(document.positions())
                          : subdiv::apply(refined.stencils[static_cast<std::size_t>(level)], document.positions());
  std::vector<std::string> notes;
  if (is_surface_format(path)) {
    if (options.encoding != io::Encoding::usual || !options.version.empty())
      throw Error(ErrorCode::bad_input, "encoding and version are those of volume meshes; leave them out here");
    io::write_surface(path, surface_mesh(solid, positions), surface_look(solid));
    return notes;
  }
  io::VolumeMesh mesh;
  mesh.cells = subdiv::cell_lists(solid, positions);
  const io::VolumeFormat& format = io::volume_format_of(path);
  // Fields live on the nodes of the finest level; dead ids are squeezed out as cell_lists does.
  if (!finest) {
    notes.push_back(fmt::format("{} holds no fields: they belong to the finest level", path.filename().string()));
  } else {
    std::vector<std::string> names;
    for (const FieldInfo& info : field_table()) names.emplace_back(info.word);
    if (level > 0)
      names.insert(names.end(), {"strain", "strain_1", "strain_2", "strain_3", "stress", "stress_1", "stress_2",
                                 "stress_3", "pressure", "distortion", "speed", "plastic_strain"});
    if (level > 0 && !document.stress_is_known()) {
      std::erase_if(names,
                    [](const std::string& name) { return name.starts_with("stress") || name == "pressure"; });
      notes.emplace_back(
          "the stress of a body that has flowed is left out: it is known in the default space only; `commit` the "
          "shape, which leaves it without stress");
    }
    if (reference) names.emplace_back("error");
    const Progress gathering = document.progress.of("gathering fields");
    for (const std::string& name : names) {
      gathering.at(static_cast<double>(mesh.point_fields.size()) / static_cast<double>(names.size()));
      const ShownField field = shown_field(document, name, reference);
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
  SetExport(document, level, mesh, notes);
  for (std::string& note : io::leave_out_what_is_not_held(mesh, format)) notes.push_back(std::move(note));
  if (const std::string note = sharpness_note(solid); !note.empty()) notes.push_back(note);
  document.progress.of("writing").at(0);  // the last word: a file is there whole or not at all
  io::write_volume_mesh(path, mesh, options);
  return notes;
}

}  // namespace argil::sculpt
