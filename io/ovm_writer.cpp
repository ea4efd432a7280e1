#include <fmt/format.h>

#include <algorithm>

#include "io/ovm.h"
#include "io/set_fields.h"
#include "io/text_cursor.h"
#include "subdiv/build.h"

namespace argil::io {
namespace {

using namespace subdiv;

constexpr std::string_view k_types[] = {"", "double", "vec2d", "vec3d", "vec4d"};

class Writer {
 public:
  explicit Writer(const VolumeMesh& mesh) : mesh_(mesh), built_(build(mesh.cells)), solid_(built_.solid) {}

  std::string write() {
    const auto& positions = mesh_.cells.positions;
    text_ = "OVM ASCII\n";
    append_line(text_, "Vertices\n{}", positions.cols());
    for (Eigen::Index v = 0; v < positions.cols(); ++v)
      for (int axis = 0; axis < 3; ++axis) {
        append_number(text_, positions(axis, v));
        text_ += axis == 2 ? '\n' : ' ';
      }
    append_line(text_, "Edges\n{}", solid_.edge_count());
    for (const EdgeId e : solid_.edges()) {
      const auto& ends = solid_.edge_vertices(e);
      append_line(text_, "{} {}", built_.point_from_vertex[ends[0].index()],
                  built_.point_from_vertex[ends[1].index()]);
    }
    write_faces();
    write_cells();
    fields("VProp", mesh_.point_fields);
    sets("VProp", SetKind::points, static_cast<std::size_t>(positions.cols()));
    face_sets();
    fields("CProp", mesh_.cell_fields);
    sets("CProp", SetKind::cells, mesh_.cells.cell_count());
    return std::move(text_);
  }

 private:
  void number(std::size_t value) { fmt::format_to(std::back_inserter(text_), " {}", value); }

  void write_faces() {
    append_line(text_, "Faces\n{}", solid_.face_count());
    for (const FaceId f : solid_.faces()) {
      const auto vertices = solid_.face_vertices(f);
      const auto edges = solid_.face_edges(f);
      fmt::format_to(std::back_inserter(text_), "{}", vertices.size());
      for (std::size_t i = 0; i < vertices.size(); ++i)
        number(2 * edges[i].index() + (solid_.edge_vertices(edges[i])[0] == vertices[i] ? 0 : 1));
      text_ += '\n';
    }
  }

  void write_cells() {
    append_line(text_, "Polyhedra\n{}", solid_.cell_count());
    for (const CellId c : solid_.cells()) {
      const auto uses = solid_.cell_face_uses(c);
      fmt::format_to(std::back_inserter(text_), "{}", uses.size());
      for (const FaceUseId use : uses) number(other_side(use).index());
      text_ += '\n';
    }
  }

  void fields(std::string_view entity, const std::vector<NamedField>& list) {
    for (const NamedField& field : list) {
      const auto width = static_cast<std::size_t>(field.components);
      append_line(text_, "{} {} \"{}\"", entity, k_types[width], field.name);
      for (std::size_t i = 0; i < field.values.size(); ++i) {
        append_number(text_, field.values[i]);
        text_ += (i + 1) % width == 0 ? '\n' : ' ';
      }
    }
  }

  void members(std::string_view entity, const NamedSet& set, std::size_t count) {
    append_line(text_, "{} bool \"{}{}\"", entity, k_set_prefix, set.name);
    for (const std::uint8_t value : membership(set, count)) {
      text_ += static_cast<char>('0' + value);
      text_ += '\n';
    }
  }

  void sets(std::string_view entity, SetKind kind, std::size_t count) {
    for (const NamedSet& set : mesh_.sets)
      if (set.kind == kind) members(entity, set, count);
  }

  void face_sets() {
    if (mesh_.sets.empty()) return;
    std::vector<std::uint32_t> vertex_from_point(static_cast<std::size_t>(mesh_.cells.positions.cols()),
                                                 VertexId::k_invalid);
    for (std::size_t v = 0; v < built_.point_from_vertex.size(); ++v)
      vertex_from_point[built_.point_from_vertex[v]] = static_cast<std::uint32_t>(v);
    for (const NamedSet& set : mesh_.sets) {
      if (set.kind != SetKind::faces) continue;
      NamedSet named{set.name, set.kind, {}};
      for (const std::uint32_t face : set.ids) {
        std::vector<VertexId> loop;
        for (std::size_t i = mesh_.faces.offsets[face]; i < mesh_.faces.offsets[face + 1]; ++i)
          loop.push_back(VertexId{vertex_from_point[mesh_.faces.corners[i]]});
        const bool known = std::all_of(loop.begin(), loop.end(), [](VertexId v) { return v.valid(); });
        const auto found = known ? solid_.find_face(loop) : std::nullopt;
        if (!found)
          throw Error(
              ErrorCode::unsupported,
              fmt::format("a face of the set {} is not one of the cells'; remove the set", in_quotes(set.name)));
        named.ids.push_back(static_cast<std::uint32_t>(found->index()));
      }
      members("FProp", named, solid_.face_count());
    }
  }

  const VolumeMesh& mesh_;
  Built built_;
  const Solid& solid_;
  std::string text_;
};

}  // namespace

bool ovm_holds_field(const NamedField& field) {
  return field.components <= 4 && field.name.find_first_of("\"\n\r") == std::string::npos;
}

std::string ovm_text(const VolumeMesh& mesh, const WriteOptions&) {
  for (const auto* fields : {&mesh.point_fields, &mesh.cell_fields})
    for (const NamedField& field : *fields)
      if (!ovm_holds_field(field))
        throw Error(ErrorCode::unsupported,
                    fmt::format("OpenVolumeMesh cannot hold the field {} of {} components, only 1 to 4 and a name "
                                "without quotation marks; write .vtu, or leave the field out",
                                in_quotes(field.name), field.components));
  return Writer(mesh).write();
}

}  // namespace argil::io
