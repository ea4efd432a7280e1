#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "io/ovm.h"
#include "io/set_fields.h"
#include "io/text_cursor.h"
#include "subdiv/build.h"

namespace argil::io {
namespace {

using subdiv::CellKind;

struct PropertyType {
  std::string_view name;
  std::size_t numbers;
};
constexpr std::array k_types{
    PropertyType{"int", 1},   PropertyType{"uint", 1},  PropertyType{"short", 1}, PropertyType{"long", 1},
    PropertyType{"ulong", 1}, PropertyType{"bool", 1},  PropertyType{"float", 1}, PropertyType{"double", 1},
    PropertyType{"vec2f", 2}, PropertyType{"vec2d", 2}, PropertyType{"vec2i", 2}, PropertyType{"vec2ui", 2},
    PropertyType{"vec3f", 3}, PropertyType{"vec3d", 3}, PropertyType{"vec3i", 3}, PropertyType{"vec3ui", 3},
    PropertyType{"vec4f", 4}, PropertyType{"vec4d", 4}, PropertyType{"vec4i", 4}, PropertyType{"vec4ui", 4}};

std::string lowered(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : cursor_(text, name, '#') {}

  VolumeMesh read() {
    expect_word("ovm", "a first line \"OVM ASCII\"");
    if (lowered(cursor_.word("ASCII")) == "binary")
      cursor_.fail("the binary form is not held; save the mesh as OVM ASCII", ErrorCode::unsupported);
    read_vertices();
    read_edges();
    read_faces();
    read_cells();
    while (!cursor_.at_end()) read_property();
    if (mesh_.cells.kinds.empty()) cursor_.fail("the file has no polyhedra; expected at least one");
    recognise_kinds();
    take_sets_from_fields(mesh_);
    std::stable_sort(mesh_.sets.begin(), mesh_.sets.end(),
                     [](const NamedSet& a, const NamedSet& b) { return a.kind < b.kind; });
    keep_named_faces();
    if (passed_over_ > 0)
      mesh_.notes.push_back(
          fmt::format("{} properties of edges, faces or the mesh were passed over", passed_over_));
    return std::move(mesh_);
  }

 private:
  void expect_word(std::string_view word, std::string_view expected) {
    if (lowered(cursor_.word(expected)) != word) cursor_.mismatch(expected);
  }

  void read_vertices() {
    expect_word("vertices", "Vertices");
    const std::size_t count = cursor_.count("a number of vertices", 6);
    if (count > std::numeric_limits<std::uint32_t>::max() - 1)
      cursor_.fail("more vertices than 32 bits can number; split the mesh", ErrorCode::limit_exceeded);
    mesh_.cells.positions.resize(3, static_cast<Eigen::Index>(count));
    for (Eigen::Index v = 0; v < mesh_.cells.positions.cols(); ++v)
      for (int axis = 0; axis < 3; ++axis) mesh_.cells.positions(axis, v) = cursor_.number("a coordinate");
  }

  void read_edges() {
    expect_word("edges", "Edges");
    edges_.resize(cursor_.count("a number of edges", 4));
    const std::int64_t last = mesh_.cells.positions.cols() - 1;
    for (auto& edge : edges_)
      for (std::uint32_t& end : edge) end = static_cast<std::uint32_t>(cursor_.integer("a vertex", 0, last));
  }

  // A face is the vertices at which its half-edges start; each must start where the one before ends.
  void read_faces() {
    expect_word("faces", "Faces");
    const std::size_t count = cursor_.count("a number of faces", 8);
    const auto last = static_cast<std::int64_t>(2 * edges_.size()) - 1;
    for (std::size_t f = 0; f < count; ++f) {
      const std::size_t corners = cursor_.count("a number of half-edges", 2);
      if (corners < 3) cursor_.mismatch("at least 3 half-edges of a face");
      std::uint32_t first = 0, end = 0;
      for (std::size_t i = 0; i < corners; ++i) {
        const auto half = static_cast<std::size_t>(cursor_.integer("a half-edge", 0, last));
        const auto& edge = edges_[half / 2];
        const std::uint32_t from = edge[half % 2], to = edge[1 - half % 2];
        if (i == 0) first = from;
        if (i > 0 && from != end)
          cursor_.fail(
              fmt::format("face {}: expected a half-edge that starts at vertex {}, where the one before "
                          "ends, found one from {}",
                          f, end, from));
        end = to;
        mesh_.faces.corners.push_back(from);
      }
      if (end != first)
        cursor_.fail(fmt::format("face {}: its half-edges do not close: they start at vertex {} and end at {}", f,
                                 first, end));
      mesh_.faces.offsets.push_back(mesh_.faces.corners.size());
    }
  }

  void read_cells() {
    expect_word("polyhedra", "Polyhedra");
    const std::size_t count = cursor_.count("a number of polyhedra", 10);
    const auto last = static_cast<std::int64_t>(2 * mesh_.faces.count()) - 1;
    auto& cells = mesh_.cells;
    std::vector<bool> taken(2 * mesh_.faces.count(), false);
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t faces = cursor_.count("a number of half-faces", 2);
      if (faces < 4) cursor_.mismatch("at least 4 half-faces of a polyhedron");
      cells.connectivity.push_back(static_cast<std::uint32_t>(faces));
      for (std::size_t i = 0; i < faces; ++i) {
        const auto half = static_cast<std::size_t>(cursor_.integer("a half-face", 0, last));
        // Else a long face in every cell would make much of a small file.
        if (taken[half]) cursor_.fail(fmt::format("the half-face {} belongs to a polyhedron already", half));
        taken[half] = true;
        append_loop(half);
      }
      cells.kinds.push_back(CellKind::polyhedron);
      cells.offsets.push_back(cells.connectivity.size());
    }
  }

  // Counter-clockwise from outside: half-face 2f has the loop of the file with its normal into the cell.
  void append_loop(std::size_t half) {
    const std::size_t begin = mesh_.faces.offsets[half / 2], end = mesh_.faces.offsets[half / 2 + 1];
    auto& numbers = mesh_.cells.connectivity;
    numbers.push_back(static_cast<std::uint32_t>(end - begin));
    for (std::size_t i = 0; i < end - begin; ++i)
      numbers.push_back(mesh_.faces.corners[half % 2 == 1 ? begin + i : end - 1 - i]);
  }

  void read_property() {
    const std::string entity = lowered(cursor_.word("a property"));
    struct Entity {
      std::string_view word;
      std::size_t items;
    };
    const std::array<Entity, 7> entities{{{"vprop", static_cast<std::size_t>(mesh_.cells.positions.cols())},
                                          {"eprop", edges_.size()},
                                          {"heprop", 2 * edges_.size()},
                                          {"fprop", mesh_.faces.count()},
                                          {"hfprop", 2 * mesh_.faces.count()},
                                          {"cprop", mesh_.cells.cell_count()},
                                          {"mprop", 1}}};
    const auto found =
        std::find_if(entities.begin(), entities.end(), [&](const Entity& e) { return e.word == entity; });
    if (found == entities.end())
      cursor_.mismatch("a property: VProp, EProp, HEProp, FProp, HFProp, CProp or MProp");
    const std::string type = lowered(cursor_.word("a type of property"));
    const auto known = std::find_if(k_types.begin(), k_types.end(), [&](const auto& t) { return t.name == type; });
    if (known == k_types.end() && type != "string")
      cursor_.fail(fmt::format("properties of {} are not held; remove the property", in_quotes(type)),
                   ErrorCode::unsupported);
    const std::string_view text = cursor_.rest_of_line();
    if (text.size() < 3 || text.front() != '"' || text.back() != '"')
      cursor_.mismatch("a name of the property in quotation marks");
    const std::string name(text.substr(1, text.size() - 2));
    if (!names_.emplace(entity, name).second)
      cursor_.fail(fmt::format("two properties have the name {}; rename one", in_quotes(name)));
    if (type == "string") {
      ++passed_over_;
      for (std::size_t i = 0; i < found->items && cursor_.remaining() > 0; ++i) cursor_.rest_of_line();
      return;
    }
    read_values(entity, name, known->numbers, found->items);
  }

  void read_values(const std::string& entity, const std::string& name, std::size_t width, std::size_t items) {
    if (items > (cursor_.remaining() + 1) / 2 / width)
      cursor_.fail(fmt::format("expected {} × {} values, but only {} bytes are left in the file; was it cut short?",
                               items, width, cursor_.remaining()));
    std::vector<double> values(items * width);
    for (double& value : values) value = cursor_.number("a number");
    if (entity == "vprop") {
      mesh_.point_fields.push_back({name, static_cast<int>(width), std::move(values)});
    } else if (entity == "cprop") {
      mesh_.cell_fields.push_back({name, static_cast<int>(width), std::move(values)});
    } else if (entity == "fprop" && is_membership(name, static_cast<int>(width), values)) {
      mesh_.sets.push_back(set_of_membership(name, SetKind::faces, values));
    } else {
      ++passed_over_;
    }
  }

  // The named kinds, where the cells make a solid; where they do not, `build` will say so.
  void recognise_kinds() {
    subdiv::Built built;
    try {
      built = subdiv::build(mesh_.cells);
    } catch (const Error&) {
      return;
    }
    subdiv::CellLists lists;
    for (const subdiv::CellId c : built.solid.cells()) {
      const CellKind kind = subdiv::cell_kind(built.solid, c);
      if (kind == CellKind::polyhedron) {
        const auto begin = mesh_.cells.connectivity.begin();
        lists.connectivity.insert(lists.connectivity.end(),
                                  begin + static_cast<std::ptrdiff_t>(mesh_.cells.offsets[c.index()]),
                                  begin + static_cast<std::ptrdiff_t>(mesh_.cells.offsets[c.index() + 1]));
      } else {
        for (const subdiv::VertexId v : subdiv::vtk_vertices(built.solid, c))
          lists.connectivity.push_back(built.point_from_vertex[v.index()]);
      }
      lists.kinds.push_back(kind);
      lists.offsets.push_back(lists.connectivity.size());
    }
    lists.positions = std::move(mesh_.cells.positions);
    mesh_.cells = std::move(lists);
  }

  // Of all faces only those that a set names.
  void keep_named_faces() {
    constexpr std::uint32_t k_dropped = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> kept_from_face(mesh_.faces.count(), k_dropped);
    for (const NamedSet& set : mesh_.sets)
      if (set.kind == SetKind::faces)
        for (const std::uint32_t face : set.ids) kept_from_face[face] = 0;
    FaceLoops kept;
    for (std::size_t f = 0; f < kept_from_face.size(); ++f) {
      if (kept_from_face[f] == k_dropped) continue;
      kept_from_face[f] = static_cast<std::uint32_t>(kept.count());
      for (std::size_t i = mesh_.faces.offsets[f]; i < mesh_.faces.offsets[f + 1]; ++i)
        kept.corners.push_back(mesh_.faces.corners[i]);
      kept.offsets.push_back(kept.corners.size());
    }
    for (NamedSet& set : mesh_.sets)
      if (set.kind == SetKind::faces)
        for (std::uint32_t& face : set.ids) face = kept_from_face[face];
    mesh_.faces = std::move(kept);
  }

  TextCursor cursor_;
  VolumeMesh mesh_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::set<std::pair<std::string, std::string>> names_;
  std::size_t passed_over_ = 0;
};

}  // namespace

VolumeMesh read_ovm(std::string_view text, std::string_view name) {
  return Reader(text, name).read();
}

}  // namespace argil::io
