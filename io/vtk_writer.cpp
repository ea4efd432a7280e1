#include <fmt/format.h>

#include "io/text_cursor.h"
#include "io/vtk.h"
#include "io/vtk_cells.h"

namespace argil::io {
namespace {

// Names of arrays are words: everything else is written as %XX, as VTK does.
std::string encoded(std::string_view name) {
  std::string word;
  for (const char c : name) {
    if (c > ' ' && c <= '~' && c != '%' && c != '"') {
      word += c;
    } else {
      fmt::format_to(std::back_inserter(word), "%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return word;
}

void append_fields(std::string& text, std::string_view header, std::size_t items,
                   const std::vector<NamedField>& fields) {
  if (fields.empty()) return;
  fmt::format_to(std::back_inserter(text), "{} {}\nFIELD FieldData {}\n", header, items, fields.size());
  for (const NamedField& field : fields) {
    fmt::format_to(std::back_inserter(text), "{} {} {} double\n", encoded(field.name), field.components, items);
    const auto width = static_cast<std::size_t>(field.components);
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      append_number(text, field.values[i]);
      text += (i + 1) % width == 0 ? '\n' : ' ';
    }
  }
}

}  // namespace

std::string vtk_text(const VolumeMesh& mesh) {
  const auto& cells = mesh.cells;
  std::string text = "# vtk DataFile Version 4.2\nArgil\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  fmt::format_to(std::back_inserter(text), "POINTS {} double\n", cells.positions.cols());
  for (Eigen::Index v = 0; v < cells.positions.cols(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      append_number(text, cells.positions(axis, v));
      text += axis == 2 ? '\n' : ' ';
    }
  }
  fmt::format_to(std::back_inserter(text), "CELLS {} {}\n", cells.cell_count(),
                 cells.cell_count() + cells.connectivity.size());
  for (std::size_t c = 0; c < cells.cell_count(); ++c) {
    fmt::format_to(std::back_inserter(text), "{}", cells.offsets[c + 1] - cells.offsets[c]);
    for (std::size_t i = cells.offsets[c]; i < cells.offsets[c + 1]; ++i) {
      fmt::format_to(std::back_inserter(text), " {}", cells.connectivity[i]);
    }
    text += '\n';
  }
  fmt::format_to(std::back_inserter(text), "CELL_TYPES {}\n", cells.cell_count());
  for (const auto kind : cells.kinds) fmt::format_to(std::back_inserter(text), "{}\n", vtk_type(kind));
  append_fields(text, "POINT_DATA", static_cast<std::size_t>(cells.positions.cols()), mesh.point_fields);
  append_fields(text, "CELL_DATA", cells.cell_count(), mesh.cell_fields);
  return text;
}

}  // namespace argil::io
