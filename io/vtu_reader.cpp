#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "io/set_fields.h"
#include "io/vtk_cells.h"
#include "io/vtu.h"
#include "io/vtu_document.h"

namespace argil::io {
namespace {

using pugi::xml_node;
using Integers = VtuDocument::Integers;
constexpr int k_polyhedron = 42;

class Reader {
 public:
  Reader(std::string_view bytes, std::string_view name) : document_(bytes, name) {}

  VolumeMesh read() {
    const xml_node file = document_.root();
    const xml_node grid = document_.only_child(file, "UnstructuredGrid");
    const xml_node piece = document_.only_child(grid, "Piece");
    const std::size_t points = document_.size_attribute(piece, "NumberOfPoints");
    const std::size_t cells = document_.size_attribute(piece, "NumberOfCells");
    for (const xml_node node : piece.children()) {
      const std::string_view name = node.name();
      if (name != "Points" && name != "Cells" && name != "PointData" && name != "CellData" && name != "FieldData") {
        document_.fail(node, fmt::format("expected Points, Cells, PointData or CellData in a Piece, found {}",
                                         in_quotes(name)));
      }
    }
    read_points(document_.only_child(piece, "Points"), points);
    read_cells(document_.only_child(piece, "Cells"), cells);
    read_fields(piece, "PointData", points, mesh_.point_fields);
    read_fields(piece, "CellData", cells, mesh_.cell_fields);
    // FieldData, which is passed over, may have its own share of the appended data.
    if (!file.child("FieldData") && !grid.child("FieldData") && !piece.child("FieldData")) {
      document_.finish_appended_data();
    }
    if (cells == 0) document_.fail(piece, "the file has no cells; expected at least one");
    take_sets_from_fields(mesh_);
    return std::move(mesh_);
  }

 private:
  void read_points(xml_node points, std::size_t count) {
    const xml_node array = document_.only_child(points, "DataArray");
    if (document_.components_of(array) != 3) document_.fail(array, "expected points with NumberOfComponents=\"3\"");
    const std::vector<double> values = document_.doubles(array, count, 3);
    mesh_.cells.positions = Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, static_cast<Eigen::Index>(count));
  }

  xml_node needed_array(xml_node parent, std::string_view name) const {
    const xml_node found = document_.named_array(parent, name);
    if (!found) document_.fail(parent, fmt::format("expected an array named {}, found none", name));
    return found;
  }

  void check_offset(const Integers& offsets, std::size_t cell, std::int64_t least) const {
    if (offsets.values[cell] >= least) return;
    throw Error(
        ErrorCode::bad_input,
        fmt::format("cell {}: expected an offset of at least {}, found {}", cell, least, offsets.values[cell]),
        offsets.where(cell));
  }

  void read_cells(xml_node node, std::size_t count) {
    constexpr std::array<std::string_view, 5> k_names{"connectivity", "offsets", "types", "faces", "faceoffsets"};
    for (const xml_node array : node.children()) {
      const std::string_view name = array.attribute("Name").value();
      if (std::find(k_names.begin(), k_names.end(), name) != k_names.end()) continue;
      document_.fail(
          array,
          fmt::format(
              "the array {} of Cells is not held; expected connectivity, offsets, types, faces or faceoffsets",
              in_quotes(name)),
          ErrorCode::unsupported);
    }
    Integers types = document_.integers(needed_array(node, "types"), count);
    const Integers offsets = document_.integers(needed_array(node, "offsets"), count);
    for (std::size_t c = 0; c < count; ++c) check_offset(offsets, c, c == 0 ? 0 : offsets.values[c - 1]);
    const auto size = static_cast<std::size_t>(count == 0 ? 0 : offsets.values.back());
    const Integers connectivity = document_.integers(needed_array(node, "connectivity"), size);

    // Other programs list them for grids without polyhedra too.
    const bool polyhedra = document_.named_array(node, "faceoffsets") || document_.named_array(node, "faces") ||
                           std::count(types.values.begin(), types.values.end(), k_polyhedron) > 0;
    Integers face_offsets, faces;
    if (polyhedra) {
      face_offsets = document_.integers(needed_array(node, "faceoffsets"), count);
      std::int64_t end = 0;
      for (std::size_t c = 0; c < count; ++c) {
        if (types.values[c] != k_polyhedron) continue;
        check_offset(face_offsets, c, end);
        end = face_offsets.values[c];
      }
      faces = document_.integers(needed_array(node, "faces"), static_cast<std::size_t>(end));
    }
    join_cells(std::move(types), offsets, connectivity, face_offsets, faces);
  }

  void join_cells(Integers types, const Integers& offsets, const Integers& connectivity,
                  const Integers& face_offsets, const Integers& faces) {
    struct Origin {
      const Integers* numbers;
      std::size_t begin;
    };
    VtkCells cells;
    std::vector<Origin> origins;
    std::size_t face_begin = 0;
    for (std::size_t c = 0; c < types.values.size(); ++c) {
      const bool polyhedron = types.values[c] == k_polyhedron;
      const Integers& source = polyhedron ? faces : connectivity;
      const std::size_t begin = polyhedron ? face_begin
                                : c == 0   ? 0
                                           : static_cast<std::size_t>(offsets.values[c - 1]);
      const auto end = static_cast<std::size_t>((polyhedron ? face_offsets : offsets).values[c]);
      if (polyhedron) face_begin = end;
      cells.connectivity.insert(cells.connectivity.end(),
                                source.values.begin() + static_cast<std::ptrdiff_t>(begin),
                                source.values.begin() + static_cast<std::ptrdiff_t>(end));
      cells.offsets.push_back(cells.connectivity.size());
      origins.push_back({&source, begin});
    }
    cells.types = std::move(types.values);
    cells.where_type = types.where;
    cells.where_number = [&](std::size_t i) {
      const auto next = std::upper_bound(cells.offsets.begin(), cells.offsets.end(), i) - cells.offsets.begin();
      const std::size_t cell = std::min(static_cast<std::size_t>(next), origins.size()) - 1;
      return origins[cell].numbers->where(origins[cell].begin + i - cells.offsets[cell]);
    };
    append_vtk_cells(cells, mesh_.cells);
    for (std::size_t c = 0; c < cells.types.size(); ++c) {
      if (mesh_.cells.kinds[c] == subdiv::CellKind::polyhedron) check_polyhedron(c, offsets, connectivity);
    }
  }

  // The connectivity of a polyhedron lists the vertices of its faces.
  void check_polyhedron(std::size_t cell, const Integers& offsets, const Integers& connectivity) const {
    const auto begin = cell == 0 ? 0 : offsets.values[cell - 1];
    std::vector<std::int64_t> listed(connectivity.values.begin() + begin,
                                     connectivity.values.begin() + offsets.values[cell]);
    std::vector<std::int64_t> used;
    for (std::size_t at = mesh_.cells.offsets[cell] + 1; at < mesh_.cells.offsets[cell + 1];) {
      const std::size_t corners = mesh_.cells.connectivity[at++];
      for (std::size_t i = 0; i < corners; ++i) used.push_back(mesh_.cells.connectivity[at++]);
    }
    for (auto* list : {&listed, &used}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    if (listed != used) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("polyhedron {}: its vertices in connectivity are not those of its faces", cell),
                  connectivity.where(static_cast<std::size_t>(begin)));
    }
  }

  void read_fields(xml_node piece, const char* name, std::size_t items, std::vector<NamedField>& fields) {
    if (!piece.child(name)) return;
    std::set<std::string> names;
    for (const xml_node array : document_.only_child(piece, name).children()) {
      if (std::string_view(array.name()) != "DataArray") {
        document_.fail(array,
                       fmt::format("the element {} is not held in {}; remove it or write it as a numeric DataArray",
                                   in_quotes(array.name()), name),
                       ErrorCode::unsupported);
      }
      NamedField field;
      field.name = array.attribute("Name").value();
      if (field.name.empty()) document_.fail(array, "expected a Name for the array, found none");
      if (!names.insert(field.name).second) {
        document_.fail(array, fmt::format("two arrays have the name {}; rename one", in_quotes(field.name)));
      }
      const std::size_t components = document_.components_of(array);
      field.components = static_cast<int>(components);
      field.values = document_.doubles(array, items, components);
      fields.push_back(std::move(field));
    }
  }

  VtuDocument document_;
  VolumeMesh mesh_;
};

}  // namespace

VolumeMesh read_vtu(std::string_view bytes, std::string_view name) {
  return Reader(bytes, name).read();
}

}  // namespace argil::io
