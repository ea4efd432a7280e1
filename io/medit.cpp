#include "io/medit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "io/text_cursor.h"
#include "io/vtk_cells.h"
#include "subdiv/cell_kinds.h"

namespace argil::io {
namespace {

using subdiv::CellKind;

constexpr std::string_view k_reference = "reference";
constexpr std::int64_t k_largest_reference = std::int64_t{1} << 53;

constexpr std::array k_cell_sections{
    NamedCellKind{"Tetrahedra", CellKind::tetrahedron, {0, 1, 2, 3}},
    NamedCellKind{"Hexahedra", CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}},
    NamedCellKind{"Prisms", CellKind::wedge, {0, 2, 1, 3, 5, 4}},
    NamedCellKind{"Pyramids", CellKind::pyramid, {0, 1, 2, 3, 4}},
};

// Sections that say nothing about the solid cells: numbers a line.
struct OtherSection {
  std::string_view word;
  std::size_t numbers;
};
constexpr std::array k_passed_over{OtherSection{"Edges", 3},
                                   OtherSection{"Triangles", 4},
                                   OtherSection{"Quadrilaterals", 5},
                                   OtherSection{"Corners", 1},
                                   OtherSection{"Ridges", 1},
                                   OtherSection{"RequiredVertices", 1},
                                   OtherSection{"RequiredEdges", 1},
                                   OtherSection{"RequiredTriangles", 1},
                                   OtherSection{"RequiredQuadrilaterals", 1},
                                   OtherSection{"Normals", 3},
                                   OtherSection{"NormalAtVertices", 2},
                                   OtherSection{"NormalAtTriangleVertices", 3},
                                   OtherSection{"NormalAtQuadrilateralVertices", 3},
                                   OtherSection{"Tangents", 3},
                                   OtherSection{"TangentAtVertices", 2},
                                   OtherSection{"TangentAtEdges", 3},
                                   OtherSection{"SubDomainFromMesh", 4},
                                   OtherSection{"SubDomainFromGeom", 4}};
constexpr std::array<std::string_view, 10> k_curved{
    "EdgesP2",  "TrianglesP2", "QuadrilateralsQ2", "TetrahedraP2", "HexahedraQ2",
    "PrismsP2", "PyramidsP2",  "TetrahedraP3",     "HexahedraQ3",  "Polyhedra"};

class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : cursor_(text, name, '#') {}

  VolumeMesh read() {
    cursor_.keyword("MeshVersionFormatted");
    cursor_.integer("a MEDIT version", 1, 4);
    cursor_.keyword("Dimension");
    if (cursor_.integer("a dimension", 2, 3) == 2) {
      cursor_.fail("the mesh is flat (Dimension 2); expected a mesh in three dimensions", ErrorCode::unsupported);
    }
    while (read_section()) {
    }
    cursor_.finish();
    if (mesh_.cells.kinds.empty()) {
      cursor_.fail("the mesh has no solid cells; expected Tetrahedra, Hexahedra, Prisms or Pyramids");
    }
    keep_references(mesh_.point_fields, vertex_references_);
    keep_references(mesh_.cell_fields, cell_references_);
    return std::move(mesh_);
  }

 private:
  bool read_section() {
    const std::string_view keyword = cursor_.word("a section or End");
    if (keyword == "End") return false;
    if (!seen_.insert(keyword).second) cursor_.fail(fmt::format("the section {} stands twice; join them", keyword));
    if (keyword == "Vertices") {
      read_vertices();
    } else if (const auto* cells = find(k_cell_sections, keyword)) {
      read_cells(*cells);
    } else if (const auto* other = find(k_passed_over, keyword)) {
      pass_over(other->numbers, cursor_.count(fmt::format("a number of {}", keyword), 2 * other->numbers));
    } else if (keyword == "AngleOfCornerBound") {
      cursor_.number("an angle");
    } else if (std::find(k_curved.begin(), k_curved.end(), keyword) != k_curved.end()) {
      cursor_.fail(
          fmt::format("the section {} is not held; convert it to straight-sided tetrahedra, hexahedra, prisms "
                      "or pyramids",
                      keyword),
          ErrorCode::unsupported);
    } else {
      cursor_.mismatch("a MEDIT section (Vertices, Tetrahedra, Hexahedra, Prisms, Pyramids, Triangles …) or End");
    }
    return true;
  }

  template <class Table>
  static const typename Table::value_type* find(const Table& table, std::string_view keyword) {
    const auto at = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.word == keyword; });
    return at == table.end() ? nullptr : &*at;
  }

  void read_vertices() {
    const std::size_t count = cursor_.count("a number of vertices", 8);
    if (count > std::numeric_limits<std::uint32_t>::max()) {
      cursor_.fail("more vertices than 32 bits can number", ErrorCode::limit_exceeded);
    }
    mesh_.cells.positions.resize(3, static_cast<Eigen::Index>(count));
    vertex_references_.reserve(count);
    for (Eigen::Index v = 0; v < mesh_.cells.positions.cols(); ++v) {
      for (int axis = 0; axis < 3; ++axis) mesh_.cells.positions(axis, v) = cursor_.number("a coordinate");
      vertex_references_.push_back(reference());
    }
  }

  void read_cells(const NamedCellKind& section) {
    if (!seen_.contains("Vertices")) cursor_.fail("expected the section Vertices before the cells");
    const std::size_t corners = vertex_count(section.kind);
    const std::size_t count =
        cursor_.count(fmt::format("a number of {}", plural_name(section.kind)), 2 * corners + 2);
    auto& cells = mesh_.cells;
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t first = cells.connectivity.size();
      cells.connectivity.resize(first + corners);
      for (std::size_t i = 0; i < corners; ++i) {
        const auto vertex = cursor_.integer("a vertex", 1, cells.positions.cols());
        cells.connectivity[first + section.vtk_from_file[i]] = static_cast<std::uint32_t>(vertex - 1);
      }
      cells.kinds.push_back(section.kind);
      cells.offsets.push_back(cells.connectivity.size());
      cell_references_.push_back(reference());
    }
  }

  void pass_over(std::size_t numbers, std::size_t count) {
    for (std::size_t i = 0; i < numbers * count; ++i) cursor_.number("a number");
  }

  double reference() {
    return static_cast<double>(cursor_.integer("a reference", -k_largest_reference, k_largest_reference));
  }

  static void keep_references(std::vector<NamedField>& fields, std::vector<double>& references) {
    if (std::all_of(references.begin(), references.end(), [](double r) { return r == 0; })) return;
    fields.push_back({std::string(k_reference), 1, std::move(references)});
  }

  TextCursor cursor_;
  VolumeMesh mesh_;
  std::vector<double> vertex_references_, cell_references_;
  std::set<std::string_view> seen_;
};

// The values of the one field that MEDIT holds, or null; every other field is refused.
const std::vector<double>* references(const std::vector<NamedField>& fields, std::string_view items) {
  const std::vector<double>* found = nullptr;
  for (const NamedField& field : fields) {
    if (!is_medit_reference(field)) {
      throw Error(
          ErrorCode::unsupported,
          fmt::format("MEDIT cannot hold the field {} of the {}, only whole numbers named \"{}\"; write .vtu or "
                      ".vtk, or leave the field out",
                      in_quotes(field.name), items, k_reference));
    }
    found = &field.values;
  }
  return found;
}

void append_reference(std::string& text, const std::vector<double>* values, std::size_t item) {
  fmt::format_to(std::back_inserter(text), " {}\n", values ? static_cast<std::int64_t>((*values)[item]) : 0);
}

}  // namespace

VolumeMesh read_medit(std::string_view text, std::string_view name) {
  return Reader(text, name).read();
}

bool is_medit_reference(const NamedField& field) {
  return field.name == k_reference && field.components == 1 &&
         std::all_of(field.values.begin(), field.values.end(), [](double value) {
           return std::abs(value) <= static_cast<double>(k_largest_reference) && value == std::trunc(value);
         });
}

std::string medit_text(const VolumeMesh& mesh, const WriteOptions&) {
  const auto& cells = mesh.cells;
  for (std::size_t c = 0; c < cells.cell_count(); ++c) {
    if (cells.kinds[c] != CellKind::polyhedron) continue;
    throw Error(ErrorCode::unsupported, "MEDIT cannot hold polyhedra; write .vtu or .vtk",
                fmt::format("cell {}", c));
  }
  const auto* vertex_references = references(mesh.point_fields, "vertices");
  const auto* cell_references = references(mesh.cell_fields, "cells");

  std::string text = "MeshVersionFormatted 2\nDimension 3\n";
  fmt::format_to(std::back_inserter(text), "Vertices\n{}\n", cells.positions.cols());
  for (Eigen::Index v = 0; v < cells.positions.cols(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0) text += ' ';
      append_number(text, cells.positions(axis, v));
    }
    append_reference(text, vertex_references, static_cast<std::size_t>(v));
  }
  for (const NamedCellKind& section : k_cell_sections) {
    const auto count = std::count(cells.kinds.begin(), cells.kinds.end(), section.kind);
    if (count == 0) continue;
    fmt::format_to(std::back_inserter(text), "{}\n{}\n", section.word, count);
    for (std::size_t c = 0; c < cells.cell_count(); ++c) {
      if (cells.kinds[c] != section.kind) continue;
      for (std::size_t i = 0; i < vertex_count(section.kind); ++i) {
        const auto vertex = cells.connectivity[cells.offsets[c] + section.vtk_from_file[i]];
        fmt::format_to(std::back_inserter(text), "{}{}", i > 0 ? " " : "", std::uint64_t{vertex} + 1);
      }
      append_reference(text, cell_references, c);
    }
  }
  return text + "End\n";
}

}  // namespace argil::io
